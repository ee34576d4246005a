// The oracle is the definition: the Euler-Lagrange expression of each functional's density, by differences of
// the density itself in long double. The mappings are quadratic and the weight is linear, so the central
// differences under test have no error of their own.
#include "core/grid/elliptic_equations.h"

#include "core/base/error.h"
#include "tests/support/grid_arrays.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace millwright::grid {
namespace {

using Real = long double;

/// x and y as quadratic polynomials of (xi, eta): 1, xi, eta, xi^2, xi eta, eta^2; w = w0 + wx x + wy y.
struct QuadraticCase {
    std::array<Real, 6> x{}, y{};
    std::array<Real, 3> w{};
};

/// x, y and their first derivatives, the arguments of a density.
struct State {
    Real x, y, x_xi, x_eta, y_xi, y_eta;
};

using Density = std::function<Real(const State&, Real w)>;

QuadraticCase random_case(std::mt19937& random) {
    std::uniform_real_distribution<double> small(-0.15, 0.15);
    QuadraticCase c;
    for (std::size_t k = 0; k < 6; ++k) {
        c.x[k] = small(random);
        c.y[k] = small(random);
    }
    c.x[1] += 1.0L;
    c.y[2] += 1.0L;
    c.w = {1.5L, small(random), small(random)};
    return c;
}

State state(const QuadraticCase& c, Real xi, Real eta) {
    const auto value = [&](const std::array<Real, 6>& p) {
        return p[0] + p[1] * xi + p[2] * eta + p[3] * xi * xi + p[4] * xi * eta + p[5] * eta * eta;
    };
    const auto along_xi = [&](const std::array<Real, 6>& p) { return p[1] + 2 * p[3] * xi + p[4] * eta; };
    const auto along_eta = [&](const std::array<Real, 6>& p) { return p[2] + p[4] * xi + 2 * p[5] * eta; };
    return {value(c.x), value(c.y), along_xi(c.x), along_eta(c.x), along_xi(c.y), along_eta(c.y)};
}

/// dL/d(member) at (xi, eta).
Real partial(const QuadraticCase& c, const Density& L, Real State::*member, Real xi, Real eta) {
    constexpr Real h = 1e-4L;
    const auto at = [&](Real step) {
        State s = state(c, xi, eta);
        s.*member += step;
        return L(s, c.w[0] + c.w[1] * s.x + c.w[2] * s.y);
    };
    return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
}

/// dL/dx - d/dxi dL/dx_xi - d/deta dL/dx_eta at (0, 0).
Real euler_lagrange(
    const QuadraticCase& c, const Density& L, Real State::*f, Real State::*f_xi, Real State::*f_eta) {
    constexpr Real h = 1e-4L;
    const auto d_xi = [&](Real step) { return partial(c, L, f_xi, step, 0) - partial(c, L, f_xi, -step, 0); };
    const auto d_eta = [&](Real step) {
        return partial(c, L, f_eta, 0, step) - partial(c, L, f_eta, 0, -step);
    };
    return partial(c, L, f, 0, 0) - (8 * d_xi(h) - d_xi(2 * h)) / (12 * h) -
           (8 * d_eta(h) - d_eta(2 * h)) / (12 * h);
}

/// The equations of the middle of the 3 x 3 nodes that the mapping makes of xi, eta = -1, 0, 1.
NodeEquations coded(const QuadraticCase& c, const FunctionalWeights& lambda) {
    NodeArray nodes(3, 3);
    std::vector<double> w;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const State s = state(c, i - 1, j - 1);
            nodes.at(i, j) = Vec2(static_cast<double>(s.x), static_cast<double>(s.y));
            w.push_back(static_cast<double>(c.w[0] + c.w[1] * s.x + c.w[2] * s.y));
        }
    }
    return node_equations(nodes, w, {.functional = lambda}, 1, 1);
}

Real jacobian(const State& s) {
    return s.x_xi * s.y_eta - s.x_eta * s.y_xi;
}

Real smoothness(const State& s, Real) {
    return (s.x_xi * s.x_xi + s.x_eta * s.x_eta + s.y_xi * s.y_xi + s.y_eta * s.y_eta) / jacobian(s);
}

Real volume(const State& s, Real w) {
    return w * jacobian(s) * jacobian(s);
}

Real orthogonality(const State& s, Real) {
    const Real product = s.x_xi * s.x_eta + s.y_xi * s.y_eta;
    return product * product;
}

void expect_is(Real factor, const Density& L, const QuadraticCase& c, double R_X, double R_Y) {
    const Real in_x = euler_lagrange(c, L, &State::x, &State::x_xi, &State::x_eta);
    const Real in_y = euler_lagrange(c, L, &State::y, &State::y_xi, &State::y_eta);
    const double scale = 1.0 + std::abs(static_cast<double>(in_x)) + std::abs(static_cast<double>(in_y));
    EXPECT_NEAR(static_cast<double>(in_x / factor), R_X, 1e-6 * scale);
    EXPECT_NEAR(static_cast<double>(in_y / factor), R_Y, 1e-6 * scale);
}

constexpr int cases = 50;

// T12.
TEST(EllipticEquations, SmoothnessResidualIsMinusHalfOfItsEulerLagrangeExpression) {
    std::mt19937 random(1997);
    for (int n = 0; n < cases; ++n) {
        const QuadraticCase c = random_case(random);
        const NodeEquations e = coded(c, {.adaptation = 0.0, .orthogonality = 0.0});
        expect_is(-2, smoothness, c, e.R_X, e.R_Y);
    }
}

TEST(EllipticEquations, VolumeResidualIsMinusItsEulerLagrangeExpression) {
    std::mt19937 random(1998);
    for (int n = 0; n < cases; ++n) {
        const QuadraticCase c = random_case(random);
        const NodeEquations with = coded(c, {.adaptation = 1.0, .orthogonality = 0.0});
        const NodeEquations without = coded(c, {.adaptation = 0.0, .orthogonality = 0.0});
        expect_is(-1, volume, c, with.R_X - without.R_X, with.R_Y - without.R_Y);
    }
}

TEST(EllipticEquations, OrthogonalityResidualIsMinusHalfOfItsEulerLagrangeExpression) {
    std::mt19937 random(1999);
    for (int n = 0; n < cases; ++n) {
        const QuadraticCase c = random_case(random);
        const NodeEquations with = coded(c, {.adaptation = 0.0, .orthogonality = 1.0});
        const NodeEquations without = coded(c, {.adaptation = 0.0, .orthogonality = 0.0});
        expect_is(-2, orthogonality, c, with.R_X - without.R_X, with.R_Y - without.R_Y);
    }
}

TEST(EllipticEquations, OfTheWholeAreThoseOfTheFunctionalWithTwiceLV) {
    std::mt19937 random(2000);
    constexpr double LV = 7.0;
    constexpr double LO = 0.6;
    const Density whole = [](const State& s, Real w) {
        return smoothness(s, w) + 2 * static_cast<Real>(LV) * volume(s, w) +
               static_cast<Real>(LO) * orthogonality(s, w);
    };
    for (int n = 0; n < cases; ++n) {
        const QuadraticCase c = random_case(random);
        const NodeEquations e = coded(c, {.adaptation = LV, .orthogonality = LO});
        expect_is(-2, whole, c, e.R_X, e.R_Y);
    }
}

TEST(EllipticEquations, MatrixIsWhatANodeItselfAddsToItsSecondDifferences) {
    const NodeArray nodes = displaced_square_grid(9, 0.3);
    const std::vector<double> w(nodes.nodes.size(), 0.7);
    const EquationRules rules{.functional = {.adaptation = 3.0, .orthogonality = 0.5}};
    const NodeEquations before = node_equations(nodes, w, rules, 4, 3);
    NodeArray moved = nodes; // first differences do not know the node, so the residual is linear in it
    moved.at(4, 3) += Vec2(0.01, 0.02);
    const NodeEquations after = node_equations(moved, w, rules, 4, 3);
    EXPECT_NEAR(after.R_X - before.R_X, before.R_XX * 0.01 + before.R_XY * 0.02, 1e-12);
    EXPECT_NEAR(after.R_Y - before.R_Y, before.R_XY * 0.01 + before.R_YY * 0.02, 1e-12);
}

TEST(EllipticEquations, OfACollapsedNodeAreFiniteAndSayThatJIsZero) {
    NodeArray nodes = unit_spaced(3, 3);
    for (Vec2& p : nodes.nodes) {
        p.y() = p.x();
    }
    const std::vector<double> w(9, 1.0);
    const NodeEquations e = node_equations(nodes, w, {}, 1, 1);
    EXPECT_EQ(e.J, 0.0);
    EXPECT_TRUE(std::isfinite(e.R_X) && std::isfinite(e.R_Y));
}

TEST(AllEquations, LeaveTheOutlineAloneAndNeedAWeightForEachNode) {
    const NodeArray nodes = displaced_square_grid(9, 0.3);
    const auto equations = all_equations(nodes, std::vector<double>(81, 1.0), {});
    EXPECT_EQ(equations[nodes.index(0, 4)].R_X, 0.0);
    EXPECT_EQ(equations[nodes.index(8, 4)].R_Y, 0.0);
    EXPECT_NE(equations[nodes.index(3, 4)].R_X, 0.0);
    EXPECT_EQ(residuals(equations, 9, 9).at(3, 4).x(), equations[nodes.index(3, 4)].R_X);
    EXPECT_THROW((void)all_equations(nodes, std::vector<double>(80, 1.0), {}), Defect);
}

TEST(ResidualNorm, IsHalfTheLargestSumAndKeepsWhatIsNotFinite) {
    std::vector<NodeEquations> equations(3);
    equations[0].R_X = -3.0;
    equations[0].R_Y = 1.0;
    equations[2].R_Y = 2.0;
    EXPECT_DOUBLE_EQ(residual_norm(equations), 2.0);
    equations[1].R_X = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(residual_norm(equations)));
}

} // namespace
} // namespace millwright::grid
