// The last link of the whole chain. It judges moves by the surface curve between their ends; on the finished
// part, where the nearest point of the surface counts, another method may have found more.
#include "core/project/grids.h"
#include "core/project/settings.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace millwright::project {

namespace {

constexpr std::array others{
    GridMethod::tracks, GridMethod::redistribution, GridMethod::harmonic, GridMethod::elliptic};

double score(const Evaluation& of) {
    return of.closest.max * of.closest.mean;
}

/// Not worse than `uniform` also in the mean over the length, and its tracks not much farther apart.
bool keeps_promise(const Evaluation& found,
                   const Evaluation& uniform,
                   const Workpiece& workpiece,
                   double gap) {
    return !is_worse(found, uniform, workpiece.machine) && found.closest.lmean <= uniform.closest.lmean &&
           found.track_gap.value_or(0.0) <= gap * uniform.track_gap.value_or(0.0);
}

/// One that cannot be made is none.
std::optional<Evaluation> made(GridMethod method,
                               const GridInput& input,
                               const Workpiece& workpiece,
                               const Evaluation& uniform,
                               const Progress& progress) {
    try {
        return evaluation_by(method, input, workpiece, uniform, Effort::full, progress);
    } catch (const Error&) {
        return std::nullopt;
    }
}

} // namespace

Evaluation improved_evaluation(GridMethod method,
                               const GridInput& input,
                               const Workpiece& workpiece,
                               const Evaluation& uniform,
                               Effort effort,
                               const Progress& progress) {
    if (method != GridMethod::chain || effort == Effort::live) {
        return evaluation_by(method, input, workpiece, uniform, effort, progress);
    }
    constexpr double chain = 0.9; // share of the work
    Evaluation best = evaluation_by(method, input, workpiece, uniform, effort, progress.part(0.0, chain));
    const double gap = 1.0 + input.chain.gap_percent / 100.0;
    GridInput standard; // so that the chain depends on its own settings alone
    standard.nu = input.nu;
    standard.nv = input.nv;
    standard.direction = input.direction;
    standard.tracks = input.tracks;
    bool kept = keeps_promise(best, uniform, workpiece, gap);
    double from = chain;
    for (const GridMethod other : others) {
        const double to = from + (1.0 - chain) / static_cast<double>(others.size());
        auto found = made(other, standard, workpiece, uniform, progress.part(from, to));
        from = to;
        if (!found || keeps_grid(*found, uniform) || !keeps_promise(*found, uniform, workpiece, gap) ||
            (kept && score(*found) >= score(best))) {
            continue;
        }
        best = *std::move(found);
        best.outcome.note =
            fmt::format("On the finished part no link of the chain is better than \"{}\": its grid "
                        "is taken.",
                        row_of(grid_methods(), other).label);
        kept = true;
    }
    return best;
}

} // namespace millwright::project
