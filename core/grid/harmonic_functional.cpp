#include "core/grid/harmonic_functional.h"

#include "core/grid/internal/corner_sums.h"

namespace millwright::grid {

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
