#include "core/grid/discrete_functional.h"

#include "core/grid/internal/corner_sums.h"

namespace millwright::grid {

using internal::CornerEdges;
using internal::CornerTerm;

DiscreteFunctional
discrete_functional(const NodeArray& nodes, const Weight& weight, const FunctionalWeights& lambda) {
    return internal::sum_over_corners(nodes, weight, [&lambda](const CornerEdges& at, double w) {
        const Vec2 J_xi(at.eta.y(), -at.eta.x()); // dJ / d(xi edge)
        const Vec2 J_eta(-at.xi.y(), at.xi.x());
        const double J = at.J;
        const double V = 2.0 * lambda.adaptation * w;
        const double O = lambda.orthogonality;
        const double smoothness = (at.xi.squaredNorm() + at.eta.squaredNorm()) / J;
        const double product = at.xi.dot(at.eta);
        const double by_J = -smoothness / J + 2.0 * V * J;
        return CornerTerm{smoothness + V * J * J + O * product * product,
                          by_J * J_xi + 2.0 * (at.xi / J + O * product * at.eta),
                          by_J * J_eta + 2.0 * (at.eta / J + O * product * at.xi),
                          2.0 * lambda.adaptation * J * J};
    });
}

} // namespace millwright::grid
