// The Euler equations of the grid functional I_s + 2 LV I_v + LO I_o (smoothness, volume, orthogonality) in
// central differences, spacing 1: residuals R_X, R_Y and the 2 x 2 system of one node with its neighbours
// frozen. Source: Brackbill and Saltzman 1982; (Parasilmongkol 1997, KMITL) ch. 4 eqs 8 to 24 with corrected
// signs and coefficients. The Euler-Lagrange expression of the functional is -2 R (times 1: I_v stands with
// its factor 2).
#pragma once

#include "core/grid/node_array.h"

#include <span>
#include <vector>

namespace millwright::grid {

enum class WeightDerivatives {
    chain_rule, ///< w_x = (w_xi y_eta - w_eta y_xi) / J and its partner
    listed,     ///< as in the thesis's listing, with its wrong index and denominator. For regression only.
};

/// What multiplies the terms of the functional.
struct FunctionalWeights {
    double adaptation = 1.0;    ///< LV; the text's lambda_v is twice this
    double orthogonality = 0.0; ///< LO

    friend bool operator==(const FunctionalWeights&, const FunctionalWeights&) = default;
};

/// One node: residuals, the matrix of its own displacement, the Jacobian of the mapping there.
struct NodeEquations {
    double R_X = 0.0, R_Y = 0.0;
    double R_XX = 0.0, R_XY = 0.0, R_YY = 0.0;
    double J = 1.0;
};

/// What stands on the right of the equations at one node.
struct EquationRules {
    FunctionalWeights functional;
    WeightDerivatives derivatives = WeightDerivatives::chain_rule;
};

/// The equations of node (i, j), which has all eight neighbours; `w` is the weight at every node. A Jacobian
/// of zero makes alpha, beta, gamma and the derivatives of w zero: whoever calls looks at J.
[[nodiscard]] NodeEquations
node_equations(const NodeArray& nodes, std::span<const double> w, const EquationRules& rules, int i, int j);

/// The equations of all nodes that have eight neighbours, [rows x columns]; the others keep zeros and J = 1.
/// Parallel over rows. `reused`: what an earlier call for an array of this size gave, whose memory is taken.
[[nodiscard]] std::vector<NodeEquations> all_equations(const NodeArray& nodes,
                                                       std::span<const double> w,
                                                       const EquationRules& rules,
                                                       std::vector<NodeEquations> reused = {});

/// max (|R_X| + |R_Y|) / 2; not finite if one of them is not.
[[nodiscard]] double residual_norm(std::span<const NodeEquations> equations);

/// (R_X, R_Y) at every node.
[[nodiscard]] NodeArray residuals(std::span<const NodeEquations> equations, int rows, int columns);

} // namespace millwright::grid
