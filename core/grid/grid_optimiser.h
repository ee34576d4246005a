// One interface for every way of making a grid better, advanced in steps so that it can be watched, paused,
// stepped, cancelled. Implementations: EllipticAdaptation (elliptic_adaptation.h), TrackOptimiser
// (track_optimiser.h).
#pragma once

#include "core/base/progress.h"
#include "core/grid/elliptic_equations.h"
#include "core/grid/error_model.h"
#include "core/grid/grid.h"
#include "core/grid/node_array.h"
#include "core/grid/weight.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::grid {

enum class OptimiserStatus {
    running,
    converged,       ///< the method's own stop criterion holds
    iteration_limit, ///< stopped by the cap that the user set
    no_gain,         ///< nothing better than the start was found; `best` is the start
    folded,          ///< a cell turned over; `best` is from before
    not_finite,      ///< a number left the finite range; `best` is from before
    singular,        ///< a node's 2 x 2 system had no solution; `best` is from before
};

/// What one stage of the whole chain brought.
struct ChainStage {
    std::string name;
    ErrorSummary reached; ///< of the nodes at its end
    ErrorSummary of_best; ///< of the best grid so far
    std::string
        refused; ///< why the nodes at its end were not taken, "tracks too far apart"; empty: they were
};

/// One iteration of a solver that works on a norm.
struct IterationNorm {
    int round = 1;           ///< of the outer loop, from 1
    double adaptation = 0.0; ///< LV that it ran with; not a number for the harmonic map, which has none
    double norm = 0.0;       ///< after it; not finite where the solver has none

    friend bool operator==(const IterationNorm&, const IterationNorm&) = default;
};

/// What a person watches. `best` is never worse than the start in the mean error.
struct OptimiserState {
    OptimiserStatus status = OptimiserStatus::running;
    int round = 0;          ///< outer loops (elliptic) or stages and sweeps (tracks) done
    int iteration = 0;      ///< inner iterations done in all rounds
    double norm = 0.0;      ///< residual norm (elliptic) or largest node step of the last sweep (tracks)
    NodeArray current{};    ///< as it stands now; may be between two grids
    NodeArray reached{};    ///< at the end: the nodes that the method itself ended with, kept or not
    Grid best;              ///< the best grid seen
    ErrorSummary start{};   ///< of the start grid
    ErrorSummary now{};     ///< of the last complete grid
    ErrorSummary of_best{}; ///< of `best`
    std::string note{};     ///< one sentence: what was just done, or why it ended
    std::string warning{};  ///< sentences: a senseless weight, settings not kept, no convergence
    std::vector<IterationNorm>
        norms{};                      ///< of every iteration; of the elliptic grid and the harmonic map only
    double done = 0.0;                ///< of the whole way, 0 to 1, never falling; 1 at the end only
    std::vector<ChainStage> stages{}; ///< that are done; of the whole chain only
};

class GridOptimiser {
public:
    virtual ~GridOptimiser() = default;

    /// Does one watchable step (some inner iterations, one stage, one sweep) and returns true while there is
    /// more to do. `progress` is of the whole way: a step tells it from state().done on. Throws Cancelled
    /// through it, leaving the state as it was before the step.
    virtual bool advance(const Progress& progress) = 0;

    [[nodiscard]] virtual const OptimiserState& state() const = 0;

    /// What the equations that the method solves leave at the nodes of state().current, in solver coordinates
    /// [nu x nv]; nothing where it solves none.
    [[nodiscard]] virtual std::optional<NodeArray> residuals() const { return std::nullopt; }
};

/// Advances to the end and returns the last state.
OptimiserState run(GridOptimiser& optimiser, const Progress& progress);

// What every solver of the elliptic grid functional has in common: it moves nodes, one iteration at a time,
// and says honestly how it ended. JacobiNewton (jacobi_newton.h) is the reference iteration of the thesis,
// Multigrid (multigrid.h) the fast one, DiscreteMinimiser (discrete_minimiser.h) the robust one that cannot
// fold a cell.

enum class Boundary {
    fixed,   ///< nodes of the outline do not move, to the bit
    sliding, ///< they move along their side, which is parallel to an axis; corners stay
};

enum class SolverStatus {
    running,
    converged,       ///< the norm is within the tolerance and the grid is sound
    iteration_limit, ///< stopped by the cap
    stalled,         ///< no step makes it better, and the norm is above the tolerance
    folded,          ///< a Jacobian, a cell or a corner of one is not positive
    not_finite,      ///< a number left the finite range
    singular,        ///< a node's 2 x 2 system has no solution; that node was kept where it was
};

/// Who moves the nodes.
enum class EllipticMethod {
    minimiser, ///< DiscreteMinimiser: never folds, converges with strong weights
    multigrid, ///< MultigridThenMinimiser: the fast one, for many nodes
    reference, ///< JacobiNewton: the thesis's iteration
    harmonic, ///< DiscreteMinimiser on the energy of a harmonic map, whose metric the weight is: no LV, no LO
};

struct EllipticSettings {
    FunctionalWeights functional;
    double relaxation = 0.81; ///< WW: new = WW old + (1 - WW) solution. JacobiNewton only
    double tolerance = 1e-3;  ///< of the norm
    int max_iterations = 220;
    Boundary boundary = Boundary::fixed;
    WeightDerivatives derivatives = WeightDerivatives::chain_rule; ///< JacobiNewton only

    friend bool operator==(const EllipticSettings&, const EllipticSettings&) = default;
};

class EllipticSolver {
public:
    virtual ~EllipticSolver() = default;

    /// One iteration; true while there is more to do. Throws Error if the weight does.
    virtual bool iterate() = 0;

    [[nodiscard]] virtual SolverStatus status() const = 0;
    [[nodiscard]] virtual int iterations() const = 0;
    /// max (|R_X| + |R_Y|) / 2 of the last iteration, or its equivalent in a discrete gradient; 1e7 at the
    /// start.
    [[nodiscard]] virtual double norm() const = 0;
    /// As they stand after the last iteration, folded or not.
    [[nodiscard]] virtual const NodeArray& nodes() const = 0;
    /// An equal solver that goes its own way from here.
    [[nodiscard]] virtual std::unique_ptr<EllipticSolver> clone() const = 0;
};

/// Iterates to the end.
SolverStatus solve(EllipticSolver& solver);

/// The norm that a solver has before its first iteration.
inline constexpr double norm_at_start = 1e7;

} // namespace millwright::grid
