// The last link of the whole chain. It judges moves by the surface curve between their ends; on the finished
// part, where the nearest point of the surface counts, another method may have found more.
#include "core/plan/internal/best_grid.h"

#include "core/project/grid_methods/grid_method_row.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace millwright::plan {

namespace {

constexpr std::array others{project::GridMethod::tracks,
                            project::GridMethod::redistribution,
                            project::GridMethod::harmonic,
                            project::GridMethod::elliptic};

/// Not worse than `uniform`, and its tracks not much farther apart.
bool keeps_promise(const Evaluation& found,
                   const Evaluation& uniform,
                   const CuttingSetup& cutting_setup,
                   double gap) {
    return !is_worse(found, uniform, cutting_setup.machine) &&
           found.track_gap.value_or(0.0) <= gap * uniform.track_gap.value_or(0.0);
}

/// One that cannot be made is none.
std::optional<Evaluation>
grid_if_possible(const GridMaking& by, const Evaluation& uniform, const Progress& progress) {
    try {
        return evaluation_by(by, uniform, progress);
    } catch (const Error&) {
        return std::nullopt;
    }
}

} // namespace

Evaluation best_grid(const GridMaking& by, const Evaluation& uniform, const Progress& progress) {
    if (by.method != project::GridMethod::chain || by.effort == Effort::live) {
        return evaluation_by(by, uniform, progress);
    }
    constexpr double chain = 0.9; // share of the work
    Evaluation best = evaluation_by(by, uniform, progress.part(0.0, chain));
    const double gap = 1.0 + by.input.chain.gap_percent / 100.0;
    project::GridInput standard; // so that the chain depends on its own settings alone
    standard.nu = by.input.nu;
    standard.nv = by.input.nv;
    standard.direction = by.input.direction;
    standard.tracks = by.input.tracks;
    bool kept = keeps_promise(best, uniform, by.cutting_setup, gap);
    double from = chain;
    for (const project::GridMethod other : others) {
        const double to = from + (1.0 - chain) / static_cast<double>(others.size());
        auto found = grid_if_possible({other, standard, by.cutting_setup}, uniform, progress.part(from, to));
        from = to;
        if (!found || keeps_grid(*found, uniform) || !keeps_promise(*found, uniform, by.cutting_setup, gap) ||
            (kept && score(*found) >= score(best))) {
            continue;
        }
        found->outcome.stages = std::move(best.outcome.stages); // what the chain did stays in the report
        best = *std::move(found);
        best.outcome.note = fmt::format(
            "On the finished part no stage of the chain is better than \"{}\", so its grid is used.",
            row_of(other).label);
        kept = true;
    }
    return best;
}

} // namespace millwright::plan
