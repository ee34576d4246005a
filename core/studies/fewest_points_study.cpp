#include "core/studies/fewest_points_study.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/grid/fewest_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <iterator>

namespace millwright::studies {

namespace {

using grid::Track;

plan::CuttingSetup cutting_setup_of_case(const FewestPointsCase& of, const plan::Folders& folders) {
    project::Project project = project::project_from_preset(of.surface);
    project.machine.file = of.machine;
    project.grid.direction = grid::TrackDirection::along_u;
    return cutting_setup_of(project, folders);
}

std::vector<Track> tracks_of(const FewestPointsCase& of) {
    constexpr double margin =
        0.02; // of the parameter: the border itself is a line of singular points on some
    std::vector<Track> tracks;
    for (int n = 0; n < of.tracks; ++n) {
        const double t = of.tracks > 1 ? static_cast<double>(n) / (of.tracks - 1) : 0.5;
        tracks.push_back({grid::TrackDirection::along_u, mix(margin, 1.0 - margin, t)});
    }
    return tracks;
}

/// Equal steps on one track, and which of them failed last: with a few more it is the first to fail again.
class EqualSteps {
public:
    EqualSteps(const grid::ErrorModel& model, const Track& track, double tolerance)
        : model_(model), track_(track), tolerance_(tolerance) {}

    [[nodiscard]] std::optional<int> fewest(const Progress& progress) {
        for (int nodes = 2; nodes <= most_uniform; ++nodes) {
            progress.check();
            if (hold(nodes, grid::coarse, far_beyond * tolerance_) && hold(nodes, grid::fine, tolerance_)) {
                return nodes;
            }
        }
        return std::nullopt;
    }

private:
    static constexpr double far_beyond = 1.5; // coarse chords see a little too much

    [[nodiscard]] bool hold(int nodes, grid::Sampling sampling, double limit) {
        const int moves = nodes - 1;
        const int first = static_cast<int>(failed_at_ * moves);
        for (int k = 0; k < moves; ++k) {
            const int n = (first + k) % moves;
            const double from = static_cast<double>(n) / moves;
            const double to = static_cast<double>(n + 1) / moves;
            if (!(model_.move(track_.at(from), track_.at(to), sampling).tip <= limit)) {
                failed_at_ = 0.5 * (from + to);
                return false;
            }
        }
        return true;
    }

    const grid::ErrorModel& model_;
    Track track_;
    double tolerance_;
    double failed_at_ = 0.0;
};

/// Of one track.
struct Found {
    std::optional<int> uniform, fewest;
    grid::MoveError largest;
};

/// Of tip and axis, each separately.
grid::MoveError largest_of(const grid::ErrorModel& model, const grid::PlacedTrack& placed) {
    grid::MoveError largest;
    for (std::size_t n = 1; n < placed.places.size(); ++n) {
        const Vec2 from = placed.track.at(placed.places[n - 1]);
        const grid::MoveError move = model.move(from, placed.track.at(placed.places[n]), grid::fine);
        largest.tip = std::max(largest.tip, move.tip);
        largest.axis = std::max(largest.axis, move.axis);
    }
    return largest;
}

Found on_track(const grid::ErrorModel& model,
               const Track& track,
               double tolerance,
               const Progress& progress) {
    Found found;
    found.uniform = EqualSteps(model, track, tolerance).fewest(progress);
    if (const auto placed = grid::fewest_nodes(model, track, 0.0, 1.0, {.tip = tolerance}, {}, progress)) {
        found.fewest = static_cast<int>(placed->places.size());
        found.largest = largest_of(model, *placed);
    }
    return found;
}

/// Nothing if a track has nothing.
void add(std::optional<int>& sum, const std::optional<int>& more) {
    sum = sum && more ? std::optional(*sum + *more) : std::nullopt;
}

std::string count_text(const std::optional<int>& count) {
    return count ? fmt::format("{}", *count) : std::string();
}

} // namespace

std::vector<FewestPointsRow> fewest_points(const FewestPointsCase& of,
                                           std::span<const double> tolerances,
                                           const plan::Folders& folders,
                                           const Progress& progress) {
    expects(of.tracks >= 1 && of.tracks <= 1000, "a study has 1 to 1000 tracks");
    expects(std::ranges::all_of(tolerances, [](double t) { return t > 0.0; }), "a tolerance is positive");
    const toolpath::KinematicError model = cutting_setup_of_case(of, folders).error_model();
    const std::vector<Track> tracks = tracks_of(of);
    const auto per_row = std::ssize(tracks);
    const auto jobs = std::ssize(tolerances) * per_row;
    std::vector<Found> found(static_cast<std::size_t>(jobs));
    std::atomic<int> done = 0;
    const Progress unreported = progress.part(0.0, 0.0);
    parallel_for(jobs, 1, [&](std::ptrdiff_t job) {
        const auto row = static_cast<std::size_t>(job / per_row);
        const auto track = static_cast<std::size_t>(job % per_row);
        found[static_cast<std::size_t>(job)] = on_track(model, tracks[track], tolerances[row], unreported);
        progress.report(static_cast<double>(++done) / static_cast<double>(jobs), "Counting points");
    });
    std::vector<FewestPointsRow> rows;
    for (std::size_t row = 0; row < tolerances.size(); ++row) {
        FewestPointsRow sum{.tolerance = tolerances[row], .uniform = 0, .fewest = 0};
        for (std::size_t track = 0; track < tracks.size(); ++track) {
            const Found& of_track = found[row * tracks.size() + track];
            add(sum.uniform, of_track.uniform);
            add(sum.fewest, of_track.fewest);
            sum.largest = std::max(sum.largest, of_track.largest.tip);
            sum.largest_axis = std::max(sum.largest_axis, of_track.largest.axis);
        }
        rows.push_back(sum);
    }
    return rows;
}

std::string fewest_points_csv(const FewestPointsCase& of, std::span<const FewestPointsRow> rows) {
    std::string text =
        "surface,machine,tracks,tolerance_mm,uniform_points,fewest_points,largest_mm,largest_axis_deg\n";
    for (const FewestPointsRow& row : rows) {
        text += fmt::format("{},{},{},{},{},{},{:.6f},{:.4f}\n",
                            of.surface,
                            of.machine,
                            of.tracks,
                            row.tolerance,
                            count_text(row.uniform),
                            count_text(row.fewest),
                            row.largest,
                            to_degrees(row.largest_axis));
    }
    return text;
}

} // namespace millwright::studies
