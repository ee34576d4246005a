// What every solver of the elliptic grid functional has in common: it moves nodes, one iteration at a time,
// and says honestly how it ended. JacobiNewton (jacobi_newton.h) is the reference iteration of the thesis,
// Multigrid (multigrid.h) the fast one, DiscreteMinimiser (discrete_minimiser.h) the robust one that cannot
// fold a cell.
#pragma once

#include "core/grid/elliptic_equations.h"
#include "core/grid/node_array.h"
#include "core/grid/weight.h"

#include <memory>

namespace millwright::grid {

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
