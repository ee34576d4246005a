// A grid as the project's program runs over it: along the branches that its sequencing chooses, with the
// points that this adds. Neither decides which grid is taken. Where each grid gets as many points as its own
// moves need, its figures say little of its nodes, and a goal can take a poor way over good ones.
#include "core/base/sentences.h"
#include "core/plan/internal/best_grid.h"

#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::plan {

namespace {

using toolpath::SequencingGoal;

std::string_view goal_name(SequencingGoal goal) {
    return goal == SequencingGoal::error ? "the branches with the least error" : "the nearest branches";
}

/// The way of the project's goal, and those that are tried instead.
std::vector<SequencingGoal> ways_for(SequencingGoal goal) {
    std::vector<SequencingGoal> ways{goal};
    for (const SequencingGoal other : {SequencingGoal::nearest, SequencingGoal::error}) {
        if (goal != SequencingGoal::nearest && other != goal) {
            ways.push_back(other);
        }
    }
    return ways;
}

std::string added_points_sentence(const Evaluation& found) {
    const grid::Grid& grid = found.outcome.grid;
    const auto added = std::ssize(found.toolpath.points) - static_cast<std::ptrdiff_t>(grid.nu()) * grid.nv();
    return added <= 0
               ? std::string()
               : fmt::format("Its nodes were placed for moves without the {} {} that the sequencing added.",
                             added,
                             added == 1 ? "point" : "points");
}

/// `outcome` along the first way that is not worse than `uniform`, else along that of least error.
Evaluation run_over(const GridMaking& by,
                    const GridOutcome& outcome,
                    const Evaluation& uniform,
                    const Progress& progress) {
    const std::vector<SequencingGoal> ways = ways_for(by.cutting_setup.sequencing.goal);
    const auto share = [&](std::size_t n) {
        return static_cast<double>(n) / static_cast<double>(ways.size());
    };
    CuttingSetup cutting_setup = by.cutting_setup;
    std::optional<Evaluation> best;
    for (std::size_t n = 0; n < ways.size(); ++n) {
        cutting_setup.sequencing.goal = ways[n];
        Evaluation found =
            evaluate(cutting_setup, outcome, sampling_of(by.effort), progress.part(share(n), share(n + 1)));
        const bool good = !is_worse(found, uniform, cutting_setup.machine);
        if (good || !best || score(found) < score(*best)) {
            best = std::move(found);
        }
        if (good) {
            break;
        }
    }
    return *std::move(best);
}

/// What there is to say of the way that `found` takes.
std::string
with_the_way(std::string note, const Evaluation& found, const Evaluation& uniform, SequencingGoal wanted) {
    if (found.goal != wanted) {
        note = with_sentence(std::move(note),
                             fmt::format("With the chosen sequencing goal its path would be worse than over "
                                         "the uniform grid, so it follows {}.",
                                         goal_name(found.goal)));
    }
    if (const std::string added = added_points_sentence(found); !added.empty()) {
        note = with_sentence(std::move(note), added);
    }
    if (score(uniform) < score(found)) {
        note = with_sentence(
            std::move(note),
            fmt::format("The uniform grid with its {} points has less error: max. {:.3f} mm, mean {:.3f} mm.",
                        uniform.toolpath.points.size(),
                        uniform.closest.max,
                        uniform.closest.mean));
    }
    return note;
}

} // namespace

Evaluation improved_evaluation(const GridMaking& by, const Evaluation& uniform, const Progress& progress) {
    const toolpath::SequencingSettings& wanted = by.cutting_setup.sequencing;
    const bool plain = by.cutting_setup.angle_mode != kinematics::AngleMode::consistent ||
                       (wanted.goal == SequencingGoal::nearest && !(wanted.largest_step > 0.0));
    if (plain) {
        return best_grid(by, uniform, progress);
    }
    CuttingSetup nearest = by.cutting_setup;
    nearest.sequencing = {};
    const Evaluation start =
        evaluate(nearest, uniform.outcome, sampling_of(by.effort), progress.part(0.0, 0.05));
    const Evaluation made =
        best_grid({by.method, by.input, nearest, by.effort}, start, progress.part(0.05, 0.85));
    if (keeps_grid(made, start)) {
        Evaluation kept = uniform;
        kept.outcome = made.outcome;
        return kept;
    }
    Evaluation found = run_over(by, made.outcome, uniform, progress.part(0.85, 1.0));
    found.outcome.note = with_the_way(std::move(found.outcome.note), found, uniform, wanted.goal);
    return found;
}

} // namespace millwright::plan
