#include "core/geometry/bspline_surface.h"

#include "core/base/error.h"
#include "core/geometry/closest_point.h"
#include "core/geometry/net_editing.h"
#include "core/geometry/patch_refinement.h"
#include "core/geometry/presets.h"
#include "core/geometry/surface_bounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace millwright::geometry {
namespace {

using testing::HasSubstr;

std::vector<double> clamped_knots(int degree, const std::vector<double>& inner) {
    std::vector<double> knots(static_cast<std::size_t>(degree) + 1, 0.0);
    knots.insert(knots.end(), inner.begin(), inner.end());
    knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, 1.0);
    return knots;
}

BsplineNet net_of(int degree_u,
                  int degree_v,
                  const std::vector<double>& inner_u,
                  const std::vector<double>& inner_v,
                  bool rational,
                  unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> height(-20.0, 20.0), weight(0.3, 3.0);
    BsplineNet net;
    net.degree_u = degree_u;
    net.degree_v = degree_v;
    net.knots_u = clamped_knots(degree_u, inner_u);
    net.knots_v = clamped_knots(degree_v, inner_v);
    net.rows = static_cast<int>(inner_u.size()) + degree_u + 1;
    net.columns = static_cast<int>(inner_v.size()) + degree_v + 1;
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            net.points.emplace_back(15.0 * i, 14.0 * j, height(random));
            net.weights.push_back(rational ? weight(random) : 1.0);
        }
    }
    return net;
}

/// The definition: Cox, de Boor and Mansfield's recursion, with the last span closed.
double basis(const std::vector<double>& knots, int i, int degree, double t) {
    const auto knot = [&](int n) { return knots[static_cast<std::size_t>(n)]; };
    if (degree == 0) {
        const bool last = t >= 1.0 && knot(i) < 1.0 && knot(i + 1) >= 1.0;
        return (knot(i) <= t && t < knot(i + 1)) || last ? 1.0 : 0.0;
    }
    double value = 0.0;
    if (knot(i + degree) > knot(i)) {
        value += (t - knot(i)) / (knot(i + degree) - knot(i)) * basis(knots, i, degree - 1, t);
    }
    if (knot(i + degree + 1) > knot(i + 1)) {
        value += (knot(i + degree + 1) - t) / (knot(i + degree + 1) - knot(i + 1)) *
                 basis(knots, i + 1, degree - 1, t);
    }
    return value;
}

Vec3 by_definition(const BsplineNet& net, double u, double v) {
    Vec3 sum = Vec3::Zero();
    double weights = 0.0;
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            const std::size_t n = net.index(i, j);
            const double w = net.weights[n] * basis(net.knots_u, i, net.degree_u, u) *
                             basis(net.knots_v, j, net.degree_v, v);
            sum += w * net.points[n];
            weights += w;
        }
    }
    return sum / weights;
}

std::vector<BsplineNet> samples() {
    return {net_of(3, 2, {0.2, 0.21, 0.7}, {0.4, 0.6}, false, 1),
            net_of(2, 3, {0.5, 0.5}, {0.1, 0.3, 0.3, 0.3, 0.9}, true, 2),
            net_of(1, 1, {0.25, 0.5}, {}, true, 3),
            net_of(1, 5, {}, {0.35}, false, 4),
            net_of(3, 3, {}, {}, true, 5)};
}

void for_places(const std::function<void(double u, double v)>& look) {
    for (const double u : {0.0, 0.05, 0.2, 0.205, 0.33, 0.5, 0.61, 0.7, 0.93, 1.0}) {
        for (const double v : {0.0, 0.1, 0.22, 0.3, 0.4, 0.55, 0.6, 0.81, 0.9, 1.0}) {
            look(u, v);
        }
    }
}

TEST(BsplineSurface, IsTheSumOfItsDefinition) {
    for (const BsplineNet& net : samples()) {
        const BsplineSurface surface(net);
        for_places([&](double u, double v) {
            EXPECT_LT((surface.position(u, v) - by_definition(net, u, v)).norm(), 1e-11) << u << ' ' << v;
        });
    }
}

TEST(BsplineSurface, HasTheDerivativesOfDifferencesWithinItsSpans) {
    for (const BsplineNet& net : samples()) {
        const BsplineSurface surface(net);
        constexpr double h = 1e-5;
        for (const double u : {0.1, 0.203, 0.44, 0.62, 0.88}) {
            for (const double v : {0.05, 0.2, 0.45, 0.77, 0.95}) {
                const SurfaceDerivatives at = surface.derivatives(u, v);
                const auto p = [&](double du, double dv) { return surface.position(u + du, v + dv); };
                EXPECT_LT((at.position - p(0, 0)).norm(), 1e-12);
                EXPECT_LT((at.du - (p(h, 0) - p(-h, 0)) / (2 * h)).norm(), 1e-4);
                EXPECT_LT((at.dv - (p(0, h) - p(0, -h)) / (2 * h)).norm(), 1e-4);
                const auto d = [&](double du, double dv) { return surface.derivatives(u + du, v + dv); };
                EXPECT_LT((at.duu - (d(h, 0).du - d(-h, 0).du) / (2 * h)).norm(), 2e-2);
                EXPECT_LT((at.duv - (d(0, h).du - d(0, -h).du) / (2 * h)).norm(), 2e-2);
                EXPECT_LT((at.dvv - (d(0, h).dv - d(0, -h).dv) / (2 * h)).norm(), 2e-2);
            }
        }
    }
}

TEST(BsplineSurface, HasOnePointAndNormalHoweverItIsAsked) {
    for (const BsplineNet& net : samples()) {
        const BsplineSurface surface(net);
        for_places([&](double u, double v) {
            const SurfaceDerivatives at = surface.derivatives(u, v);
            EXPECT_EQ(surface.point(u, v).position, at.position);
            EXPECT_EQ(surface.position(u, v), at.position);
            EXPECT_EQ(surface.point(u, v).normal, surface.unit_normal(at));
        });
    }
}

TEST(BsplineSurface, WithoutInnerKnotsIsABezierPatch) {
    const BsplineNet net = samples().back();
    ControlNet bezier = ControlNet::sized(net.rows, net.columns);
    bezier.points = net.points;
    bezier.weights = net.weights;
    const BsplineSurface surface(net);
    const BezierPatch patch(bezier);
    for_places([&](double u, double v) {
        const SurfaceDerivatives a = surface.derivatives(u, v), b = patch.derivatives(u, v);
        EXPECT_LT((a.position - b.position).norm(), 1e-12);
        EXPECT_LT((a.du - b.du).norm(), 1e-10);
        EXPECT_LT((a.duv - b.duv).norm(), 1e-9);
        EXPECT_LT((a.dvv - b.dvv).norm(), 1e-9);
    });
}

TEST(BsplineSurface, ConsistsOfItsPieces) {
    for (const BsplineNet& net : samples()) {
        const BsplineSurface surface(net);
        const std::vector<SurfacePiece> pieces = surface.pieces();
        const auto [u_spans, v_spans] = surface.spans();
        ASSERT_EQ(std::ssize(pieces), u_spans * v_spans);
        for (const SurfacePiece& piece : pieces) {
            for (const double u : {0.0, 0.3, 1.0}) {
                for (const double v : {0.0, 0.6, 1.0}) {
                    const Vec2 uv = piece.low + Vec2(u, v).cwiseProduct(piece.high - piece.low);
                    const Vec3 position = surface.position(uv.x(), uv.y());
                    EXPECT_LT((piece.patch.position(u, v) - position).norm(), 1e-11);
                }
            }
        }
    }
    EXPECT_EQ(BsplineSurface(samples()[1]).spans(), std::pair(2, 4));
}

// A raster of 1,500 x 1,500 places is the judge.
TEST(BsplineSurface, ItsClosestPointIsNoFartherThanAnyOfARaster) {
    const BsplineSurface surface(samples().front());
    const ClosestPointSearch search(surface);
    std::vector<Vec3> raster;
    constexpr int side = 300;
    for (int i = 0; i <= side; ++i) {
        for (int j = 0; j <= side; ++j) {
            raster.push_back(surface.position(double(i) / side, double(j) / side));
        }
    }
    std::mt19937 random(11);
    std::uniform_real_distribution<double> x(-20.0, 110.0), y(-20.0, 80.0), z(-60.0, 60.0);
    for (int n = 0; n < 100; ++n) {
        const double px = x(random), py = y(random);
        const Vec3 point(px, py, z(random));
        double least = std::numeric_limits<double>::infinity();
        for (const Vec3& at : raster) {
            least = std::min(least, (at - point).norm());
        }
        const ClosestPoint found = search.closest(point);
        EXPECT_LE(found.distance, least + 1e-9) << point.transpose();
        const DistanceBounds bounds = distance_bounds(surface, point, found.distance, 1e-4);
        EXPECT_LE(bounds.at_least, found.distance);
        EXPECT_GT(bounds.at_least, found.distance - 2e-4);
    }
}

TEST(BsplineSurface, TurnedOverHasTheOppositeNormal) {
    const BsplineNet net = samples()[1];
    const BsplineSurface surface(net), over(turned_over(net));
    for_places([&](double u, double v) {
        EXPECT_LT((surface.position(u, v) - over.position(v, u)).norm(), 1e-12);
        EXPECT_LT((*surface.unit_normal(u, v) + *over.unit_normal(v, u)).norm(), 1e-10);
    });
    EXPECT_EQ(turned_over(turned_over(net)), net);
}

// A lens: two sides are points, as the root of a blade has. The normals just inside are the judge.
TEST(BsplineSurface, HasANormalWhereASideIsAPoint) {
    BsplineNet net = net_of(2, 2, {0.4}, {}, false, 1);
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            const bool tip = i == 0 || i == net.rows - 1;
            net.points[net.index(i, j)] = {
                10.0 * i, tip ? 0.0 : 8.0 * (j - 1), tip ? 0.0 : 3.0 - 0.5 * j * j};
        }
    }
    for (const bool over : {false, true}) {
        const BsplineSurface surface(over ? turned_over(net) : net);
        for (const double end : {0.0, 1.0}) {
            for (const double along : {0.0, 0.3, 1.0}) {
                const double near = end > 0.5 ? 1.0 - 1e-7 : 1e-7;
                const auto at_tip = over ? surface.point(along, end) : surface.point(end, along);
                const auto beside = over ? surface.point(along, near) : surface.point(near, along);
                ASSERT_TRUE(at_tip.normal && beside.normal);
                EXPECT_LT((*at_tip.normal - *beside.normal).norm(), 1e-5) << end << ' ' << along;
            }
        }
    }
}

// Beside two knots that almost touch, the second derivatives must not drown in rounding.
TEST(BsplineSurface, BearsSpansOfATenMillionth) {
    BsplineNet net = net_of(3, 2, {0.5, 0.5 + 2e-8}, {}, false, 1);
    for (int i = 0; i < net.rows; ++i) { // Greville abscissae: x = 100 u, and z = x^2 / 100 nearly
        const double u = (net.knots_u[std::size_t(i) + 1] + net.knots_u[std::size_t(i) + 2] +
                          net.knots_u[std::size_t(i) + 3]) /
                         3.0;
        for (int j = 0; j < net.columns; ++j) {
            net.points[net.index(i, j)].x() = 100.0 * u;
        }
    }
    const BsplineSurface surface(net);
    for (const double u : {0.2, 0.49999, 0.5 + 1e-8, 0.50001, 0.9}) {
        const SurfaceDerivatives at = surface.derivatives(u, 0.4);
        EXPECT_NEAR(at.position.x(), 100.0 * u, 1e-12 * 100.0);
        EXPECT_NEAR(at.du.x(), 100.0, 1e-9);
        EXPECT_NEAR(at.duu.x(), 0.0, 1e-4);
    }
}

TEST(BsplineSurface, SaysWhatIsWrongWithItsNet) {
    const auto fault = [](const std::function<void(BsplineNet&)>& spoil) {
        BsplineNet net = samples().front();
        spoil(net);
        try {
            (void)BsplineSurface(net);
        } catch (const Error& error) {
            return error.diagnostic().message;
        }
        return std::string("nothing");
    };
    EXPECT_EQ(fault([](BsplineNet&) {}), "nothing");
    EXPECT_THAT(fault([](BsplineNet& net) { net.degree_u = 0; }), HasSubstr("degree 0 along u"));
    EXPECT_THAT(fault([](BsplineNet& net) { net.degree_v = 26; }), HasSubstr("degree 26 along v"));
    EXPECT_THAT(fault([](BsplineNet& net) { net.rows = 3; }), HasSubstr("too few for degree 3"));
    EXPECT_THAT(fault([](BsplineNet& net) { net.knots_u.pop_back(); }), HasSubstr("there must be 11"));
    EXPECT_THAT(fault([](BsplineNet& net) { net.knots_u[5] = std::nan(""); }), HasSubstr("not finite"));
    EXPECT_THAT(fault([](BsplineNet& net) { net.knots_u[5] = 0.1; }), HasSubstr("decrease"));
    EXPECT_THAT(fault([](BsplineNet& net) { net.knots_v.front() = -1.0; }), HasSubstr("must be 0"));
    EXPECT_THAT(fault([](BsplineNet& net) { net.knots_u[4] = 0.0; }), HasSubstr("repeated"));
    EXPECT_THAT(fault([](BsplineNet& net) { net.knots_v[3] = net.knots_v[4] = 1.0; }), HasSubstr("repeated"));
    EXPECT_THAT(fault([](BsplineNet& net) {
                    net = net_of(2, 2, {0.5, 0.5, 0.5}, {}, false, 1);
                }),
                HasSubstr("knot 0.5 along u is repeated more than 2 times"));
    EXPECT_THAT(fault([](BsplineNet& net) { net.points.pop_back(); }), HasSubstr("34 points"));
    EXPECT_THAT(fault([](BsplineNet& net) { net.points[6].x() = 1e7; }), HasSubstr("control point (1,1)"));
    EXPECT_THAT(fault([](BsplineNet& net) { net.weights[7] = 0.0; }), HasSubstr("weight (1,2) = 0"));
}

} // namespace
} // namespace millwright::geometry
