#include "core/toolpath/fewest_points.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/grid/fewest_nodes.h"
#include "core/toolpath/internal/contact_point.h"
#include "core/toolpath/kinematic_error.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::toolpath {

namespace {

std::vector<grid::Track> tracks_of(const Covering& of) {
    const int count = of.grid.track_count(of.direction);
    std::vector<grid::Track> tracks;
    for (int n = 0; n < count; ++n) {
        tracks.push_back({of.direction, static_cast<double>(n) / (count - 1)});
    }
    return tracks;
}

/// On a lattice, and where that is too coarse on one four times as fine, `finer` times.
std::optional<grid::PlacedTrack> placed(const KinematicError& model,
                                        const grid::Track& track,
                                        double tolerance,
                                        int finer,
                                        const Progress& progress) {
    grid::FewestNodesSettings settings;
    settings.lattice = 800;
    for (int n = 0; n <= finer; ++n) {
        if (auto found = grid::fewest_nodes(model, track, 0.0, 1.0, {.tip = tolerance}, settings, progress)) {
            return found;
        }
        settings.lattice *= 4;
    }
    return std::nullopt;
}

/// How moves are judged: as those of the tool, and where no number of points helps, as the cutter does not
/// fit, as those of its tip.
struct Models {
    KinematicError tool, tip;
    bool has_cutter;

    [[nodiscard]] std::optional<grid::PlacedTrack>
    placed(const grid::Track& track, double tolerance, const Progress& progress) const {
        constexpr int finer = 2;
        if (has_cutter) {
            if (auto found = toolpath::placed(tool, track, tolerance, 0, progress)) {
                return found;
            }
        }
        return toolpath::placed(tip, track, tolerance, finer, progress);
    }
};

void add(Toolpath& path, const Covering& of, const grid::PlacedTrack& placed, int track) {
    const auto count = static_cast<int>(placed.places.size());
    const bool backwards = track % 2 == 1;
    for (int k = 0; k < count; ++k) {
        const auto place = static_cast<std::size_t>(backwards ? count - 1 - k : k);
        PathPoint point = contact_point(of.patch, placed.track.at(placed.places[place]), of.flipped);
        point.origin = origin_at(of.direction, track, k, point.origin.uv);
        point.reached_by = k > 0 ? MoveKind::track : track > 0 ? MoveKind::cross : MoveKind::start;
        path.points.push_back(point);
    }
}

} // namespace

FewestPoints::FewestPoints(double tolerance) : tolerance_(tolerance) {
    expects(tolerance > 0.0 && std::isfinite(tolerance), "a tolerance is above 0");
}

Toolpath FewestPoints::contacts(const Covering& of, const Progress& progress) const {
    const Models models{{of.patch, of.machine, of.flipped, of.tool},
                        {of.patch, of.machine, of.flipped, Tool{.lean = of.tool.lean}},
                        of.tool.cutter.has_value()};
    const std::vector<grid::Track> tracks = tracks_of(of);
    std::vector<std::optional<grid::PlacedTrack>> found(tracks.size());
    std::atomic<int> done = 0;
    const Progress unreported = progress.part(0.0, 0.0);
    parallel_for(std::ssize(tracks), 1, [&](std::ptrdiff_t job) {
        const auto n = static_cast<std::size_t>(job);
        found[n] = models.placed(tracks[n], tolerance_, unreported);
        progress.report(static_cast<double>(++done) / static_cast<double>(tracks.size()));
    });
    Toolpath path;
    path.direction = of.direction;
    for (std::size_t n = 0; n < tracks.size(); ++n) {
        if (!found[n]) {
            throw Error(
                fmt::format("no points keep the track at {} = {:.6g} within {:.6g} mm",
                            of.direction == grid::TrackDirection::along_v ? "u" : "v",
                            tracks[n].across,
                            tolerance_),
                {},
                "it leads through a singular point of the machine, or out of its reach: allow more, or "
                "put the part elsewhere");
        }
        add(path, of, *found[n], static_cast<int>(n));
    }
    return path;
}

} // namespace millwright::toolpath
