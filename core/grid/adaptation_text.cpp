#include "core/grid/internal/adaptation_text.h"

#include "core/base/counted.h"
#include "core/base/numbers.h"
#include "core/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::grid {

namespace {

constexpr int shown_decimals = 4; // of a mean error in mm

std::string counted_below(const std::vector<double>& means, double than, const std::string& why) {
    const auto count = std::ranges::count_if(means, [&](double mean) { return mean < than; });
    return count == 0 ? std::string() : std::to_string(count) + " " + why;
}

} // namespace

std::string failure_sentence(SolverStatus status) {
    switch (status) {
    case SolverStatus::folded:
        return "a cell folded";
    case SolverStatus::singular:
        return "the equations of a node have no solution";
    default:
        return "a value is not finite";
    }
}

std::string mean_sentence(const ErrorSummary& error) {
    return std::isfinite(error.mean) ? "mean error " + fixed(error.mean, shown_decimals) + " mm"
                                     : "some moves are out of reach";
}

std::string iteration_sentence(const OptimiserState& state) {
    return "Round " + std::to_string(state.round + 1) + ", iteration " + std::to_string(state.iteration) +
           ": " + mean_sentence(state.now);
}

std::string unsolved_sentence(const OptimiserState& state, int iterations, double tolerance) {
    return fmt::format("The solver did not converge: round {} ended after {} with a residual of {:.3g}; "
                       "the tolerance is {}.",
                       state.round,
                       counted(iterations, "iteration"),
                       state.norm,
                       shortest(tolerance));
}

std::string refusals(const std::vector<double>& too_wide,
                     const std::vector<double>& worse_elsewhere,
                     double taken,
                     double gap_allowance) {
    const std::string wide =
        counted_below(too_wide,
                      taken,
                      "because tracks are more than " + shortest(100.0 * gap_allowance) + " % farther apart");
    const std::string worse =
        counted_below(worse_elsewhere, taken, "because of a larger error or tool-axis deviation somewhere");
    if (wide.empty() && worse.empty()) {
        return {};
    }
    double least = infinity;
    for (const std::vector<double>* means : {&too_wide, &worse_elsewhere}) {
        for (const double mean : *means) {
            least = std::min(least, mean);
        }
    }
    return ". Grids with a smaller mean error, down to " + fixed(least, shown_decimals) +
           " mm, were refused: " + wide + (wide.empty() || worse.empty() ? "" : ", ") + worse;
}

} // namespace millwright::grid
