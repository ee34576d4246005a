#include "core/grid/corner_functionals.h"

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

using internal::CornerEdges;
using internal::CornerTerm;

DiscreteFunctional harmonic_functional(const NodeArray& nodes, const Weight& m, TrackDirection direction) {
    const Eigen::Index along = direction == TrackDirection::along_u ? 0 : 1;
    const Eigen::Index across = 1 - along;
    return internal::sum_over_corners(nodes, m, [along, across](const CornerEdges& at, double m_here) {
        const Vec2 J_xi(at.eta.y(), -at.eta.x()); // dJ / d(xi edge)
        const Vec2 J_eta(-at.xi.y(), at.xi.x());
        Vec2 scale; // M / sqrt(det M)
        scale[along] = m_here;
        scale[across] = 1.0 / m_here;
        const auto lengths = [&](Eigen::Index k) { return at.xi[k] * at.xi[k] + at.eta[k] * at.eta[k]; };
        const double energy = (scale[along] * lengths(along) + scale[across] * lengths(across)) / at.J;
        const double by_J = -energy / at.J;
        return CornerTerm{energy,
                          by_J * J_xi + 2.0 / at.J * scale.cwiseProduct(at.xi),
                          by_J * J_eta + 2.0 / at.J * scale.cwiseProduct(at.eta),
                          (lengths(along) - lengths(across) / (m_here * m_here)) / at.J};
    });
}

} // namespace millwright::grid
