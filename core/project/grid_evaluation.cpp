// A grid made by a method and measured as its path will be run, never worse than the uniform one.
#include "core/base/sentences.h"
#include "core/project/grids.h"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

namespace millwright::project {

namespace {

/// Where the sequencing has put points between the nodes: no improver knows of them.
std::string added_points_sentence(const Evaluation& found) {
    const grid::Grid& grid = found.outcome.grid;
    const auto added = std::ssize(found.toolpath.points) - static_cast<std::ptrdiff_t>(grid.nu()) * grid.nv();
    return added <= 0 ? std::string()
                      : fmt::format("Its nodes were placed for moves without the {} {} that the "
                                    "sequencing added between them.",
                                    added,
                                    added == 1 ? "point" : "points");
}

int samples_of(const GridMaking& by) {
    return by.effort == Effort::live ? live_samples : report_samples;
}

Evaluation made(const GridMaking& by, const Progress& progress) {
    const toolpath::KinematicError error = by.workpiece.error_model();
    const auto improver = make_improver(by.method, by.input, error, by.effort);
    constexpr double measuring = 0.9; // share of the improvement
    GridOutcome outcome = improved_outcome(*improver, progress.part(0.0, measuring));
    return evaluate(by.workpiece, std::move(outcome), samples_of(by), progress.part(measuring, 1.0));
}

struct OtherWay {
    toolpath::SequencingGoal goal;
    const char* name;
};
constexpr std::array other_ways{OtherWay{toolpath::SequencingGoal::nearest, "the nearest branches"},
                                OtherWay{toolpath::SequencingGoal::error, "the branches of least error"}};

/// The same grid along another way than that of the project's goal, where one is not worse than `uniform`.
std::optional<Evaluation> along_another_way(const GridMaking& by,
                                            const GridOutcome& outcome,
                                            const Evaluation& uniform,
                                            const Progress& progress) {
    Workpiece workpiece = by.workpiece;
    if (workpiece.angle_mode != kinematics::AngleMode::consistent ||
        workpiece.sequencing.goal == toolpath::SequencingGoal::nearest) {
        return std::nullopt;
    }
    for (std::size_t n = 0; n < other_ways.size(); ++n) {
        const auto share = [](std::size_t k) { return static_cast<double>(k) / other_ways.size(); };
        workpiece.sequencing.goal = other_ways[n].goal;
        Evaluation found =
            evaluate(workpiece, outcome, samples_of(by), progress.part(share(n), share(n + 1)));
        if (!is_worse(found, uniform, workpiece.machine)) {
            found.outcome.note = with_sentence(
                found.outcome.note,
                fmt::format("By the goal of the sequencing its path would be worse than that over the "
                            "uniform grid; it follows {}.",
                            other_ways[n].name));
            return found;
        }
    }
    return std::nullopt;
}

} // namespace

Evaluation evaluation_by(const GridMaking& by, const Evaluation& uniform, const Progress& progress) {
    constexpr double first = 0.9; // share of the work
    Evaluation found = made(by, progress.part(0.0, first));
    const auto worse = [&](const Evaluation& than) { return is_worse(than, uniform, by.workpiece.machine); };
    if (worse(found)) {
        if (auto other = along_another_way(by, found.outcome, uniform, progress.part(first, 1.0))) {
            found = *std::move(other);
        }
    }
    if (!worse(found)) {
        if (found.outcome.status != grid::ImproverStatus::no_gain) {
            const std::string added = added_points_sentence(found);
            found.outcome.note =
                added.empty() ? found.outcome.note : with_sentence(found.outcome.note, added);
        }
        return found;
    }
    Evaluation kept = uniform;
    kept.outcome = {uniform.outcome.grid,
                    grid::ImproverStatus::no_gain,
                    found.outcome.rounds,
                    found.outcome.iterations,
                    found.outcome.norm,
                    found.outcome.start_by_curve,
                    found.outcome.start_by_curve,
                    "Nothing better than the uniform grid was found on the whole path; it is kept.",
                    found.outcome.warning};
    return kept;
}

bool keeps_grid(const Evaluation& found, const Evaluation& start) {
    return found.outcome.grid == start.outcome.grid;
}

bool is_worse(const Evaluation& found, const Evaluation& start, const kinematics::MachineModel& machine) {
    constexpr double rounding = 1e-9; // of figures that are sums over many moves
    const bool turns = !machine.rotary_axes().empty();
    return !(found.closest.mean <= start.closest.mean * (1.0 + rounding)) ||
           !(found.closest.max <= start.closest.max * (1.0 + rounding)) ||
           (turns && !(found.closest.axis_max <= start.closest.axis_max * (1.0 + rounding)));
}

} // namespace millwright::project
