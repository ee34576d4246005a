#include "core/toolpath/fewest_points.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/grid/fewest_nodes.h"
#include "core/toolpath/internal/contact_point.h"
#include "core/toolpath/kinematic_error.h"

#include <fmt/format.h>

#include <algorithm>
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

/// A piece of a track, from one place to another: what is cut of it.
struct Piece {
    std::size_t track = 0;
    double from = 0.0, to = 1.0;
};

std::vector<Piece> pieces_of(const Covering& of, const std::vector<grid::Track>& tracks) {
    std::vector<Piece> pieces;
    for (std::size_t n = 0; n < tracks.size(); ++n) {
        if (of.outline == nullptr) {
            pieces.push_back({n, 0.0, 1.0});
            continue;
        }
        for (const auto& [from, to] : of.outline->parts_inside(tracks[n].at(0.0), tracks[n].at(1.0))) {
            pieces.push_back({n, from, to});
        }
    }
    return pieces;
}

/// On a lattice, and where that is too coarse on one four times as fine, `finer` times.
std::optional<grid::PlacedTrack> placed(const KinematicError& model,
                                        const grid::Track& track,
                                        const Piece& piece,
                                        double tolerance,
                                        int finer,
                                        const Progress& progress) {
    constexpr double of_a_track = 800.0;
    constexpr double fewest = 40.0;
    const double length = piece.to - piece.from;
    grid::FewestNodesSettings settings;
    settings.lattice = static_cast<int>(std::ceil(std::max(of_a_track * length, fewest)));
    for (int n = 0; n <= finer; ++n) {
        if (auto found = grid::fewest_nodes(
                model, track, piece.from, piece.to, {.tip = tolerance}, settings, progress)) {
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
    placed(const grid::Track& track, const Piece& piece, double tolerance, const Progress& progress) const {
        constexpr int finer = 2;
        if (has_cutter) {
            if (auto found = toolpath::placed(tool, track, piece, tolerance, 0, progress)) {
                return found;
            }
        }
        return toolpath::placed(tip, track, piece, tolerance, finer, progress);
    }
};

/// The pieces of one track, to or fro, numbered through. From track to track it goes along the surface where
/// both have their own ends there, else over it, as between pieces.
class PointWriter {
public:
    explicit PointWriter(const Covering& of) : of_(of) { path_.direction = of.direction; }

    void add(std::vector<grid::PlacedTrack> pieces, std::size_t track) {
        const bool backwards = track % 2 == 1;
        const double first = backwards ? 1.0 : 0.0, last = 1.0 - first;
        int number = 0;
        if (pieces.empty()) {
            at_end_of_track_ = false;
        }
        if (backwards) {
            std::ranges::reverse(pieces);
        }
        for (grid::PlacedTrack& piece : pieces) {
            if (backwards) {
                std::ranges::reverse(piece.places);
            }
            const bool links = at_end_of_track_ && exactly_equal(piece.places.front(), first);
            for (std::size_t k = 0; k < piece.places.size(); ++k) {
                PathPoint point = contact_point(of_.patch, piece.track.at(piece.places[k]), of_.flipped);
                point.origin = origin_at(of_.direction, static_cast<int>(track), number++, point.origin.uv);
                point.reached_by = path_.points.empty() ? MoveKind::start
                                   : k > 0              ? MoveKind::track
                                   : links              ? MoveKind::cross
                                                        : MoveKind::over;
                path_.points.push_back(point);
            }
            at_end_of_track_ = exactly_equal(piece.places.back(), last);
        }
    }
    [[nodiscard]] Toolpath take() && { return std::move(path_); }

private:
    const Covering& of_;
    Toolpath path_;
    bool at_end_of_track_ = false;
};

[[noreturn]] void refuse_tolerance(const grid::Track& track, double tolerance) {
    throw Error(fmt::format("no set of points keeps the track at {} = {:.6g} within {:.6g} mm",
                            track.direction == grid::TrackDirection::along_v ? "u" : "v",
                            track.across,
                            tolerance),
                {},
                "increase the tolerance or move the part: the track passes through a singular point of the "
                "machine, or out of its reach");
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
    const std::vector<Piece> pieces = pieces_of(of, tracks);
    std::vector<std::optional<grid::PlacedTrack>> found(pieces.size());
    std::atomic<int> done = 0;
    const Progress unreported = progress.part(0.0, 0.0);
    parallel_for(std::ssize(pieces), 1, [&](std::ptrdiff_t job) {
        const auto n = static_cast<std::size_t>(job);
        found[n] = models.placed(tracks[pieces[n].track], pieces[n], tolerance_, unreported);
        progress.report(static_cast<double>(++done) / static_cast<double>(pieces.size()));
    });
    PointWriter path(of);
    std::size_t next = 0;
    for (std::size_t track = 0; track < tracks.size(); ++track) {
        std::vector<grid::PlacedTrack> placed;
        for (; next < pieces.size() && pieces[next].track == track; ++next) {
            if (!found[next]) {
                refuse_tolerance(tracks[track], tolerance_);
            }
            placed.push_back(*std::move(found[next]));
        }
        path.add(std::move(placed), track);
    }
    return std::move(path).take();
}

} // namespace millwright::toolpath
