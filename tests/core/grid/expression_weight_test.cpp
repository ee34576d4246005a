#include "core/grid/expression_weight.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/geometry/presets.h"
#include "core/geometry/surface_point.h"
#include "tests/support/lens_face.h"
#include "tests/support/test_weights.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

namespace millwright::grid {
namespace {

constexpr int expression_nu = 21;
constexpr int expression_nv = 11;

double expression_at(const std::string& text, const Vec2& p) {
    double w = 0.0;
    expression_weight(text, expression_nu, expression_nv)->values({&p, 1}, {&w, 1});
    return w;
}

Diagnostic fault_of(const std::string& text) {
    try {
        (void)expression_weight(text, expression_nu, expression_nv);
    } catch (const Error& error) {
        return error.diagnostic();
    }
    return {};
}

// T16.
TEST(ExpressionWeight, KnowsParametersNodesAndPi) {
    const Vec2 p(5.0, 2.0); // u = 0.25, v = 0.2
    EXPECT_DOUBLE_EQ(expression_at("u", p), 0.25);
    EXPECT_DOUBLE_EQ(expression_at("v", p), 0.2);
    EXPECT_DOUBLE_EQ(expression_at("10*i + j", p), 52.0);
    EXPECT_DOUBLE_EQ(expression_at("1 + sin(2*pi*u)^2 + exp(-v)", p), 2.0 + std::exp(-0.2));
    EXPECT_DOUBLE_EQ(expression_at("u < 0.5 ? 3 : 1", p), 3.0);
    EXPECT_DOUBLE_EQ(expression_at("(u == 0.25) + (v >= 0.2) + (v != 1)", p), 3.0);
}

std::shared_ptr<const geometry::BezierPatch> shared_dome_patch() {
    return std::make_shared<const geometry::BezierPatch>(
        geometry::surface_preset("dome").make().patch(geometry::PatchId{0}));
}

TEST(ExpressionWeight, KnowsTheSurfaceWhereThereIsOne) {
    const auto patch = shared_dome_patch();
    const Vec2 p(5.0, 2.0);
    const geometry::SurfaceDerivatives at = patch->derivatives(0.25, 0.2);
    const Vec3 normal = patch->unit_normal(0.25, 0.2).value();
    const auto bent = geometry::principal_curvatures(at).value();
    const auto value_of = [&](const std::string& text) {
        double w = 0.0;
        expression_weight(text, expression_nu, expression_nv, {patch, nullptr})->values({&p, 1}, {&w, 1});
        return w;
    };
    EXPECT_DOUBLE_EQ(value_of("x"), at.position.x());
    EXPECT_DOUBLE_EQ(value_of("y"), at.position.y());
    EXPECT_DOUBLE_EQ(value_of("z + u"), at.position.z() + 0.25);
    EXPECT_DOUBLE_EQ(value_of("nx + 10*ny + 100*nz"), normal.dot(Vec3(1.0, 10.0, 100.0)));
    EXPECT_DOUBLE_EQ(value_of("k1 - k2"), bent.k1 - bent.k2);
    const Diagnostic fault = fault_of("1 + z");
    EXPECT_NE(fault.message.find("surface"), std::string::npos);
}

// It was no number, and the formula was refused.
TEST(ExpressionWeight, KnowsTheNormalWhereASideOfTheSurfaceIsAPoint) {
    const auto lens = std::make_shared<const geometry::BsplineSurface>(test::lens_net());
    double w = 0.0;
    const Vec2 tip(0.0, 2.0); // u = 0, v = 0.2
    expression_weight("nx + 10*ny + 100*nz", expression_nu, expression_nv, {lens, nullptr})
        ->values({&tip, 1}, {&w, 1});
    EXPECT_NEAR(w, lens->unit_normal(1e-7, 0.2)->dot(Vec3(1.0, 10.0, 100.0)), 1e-4);
}

TEST(ExpressionWeight, KnowsTheErrorWhereItWasMeasured) {
    const WeightPtr error = weight_from([](const Vec2& p) {
        return WeightAndSlope{p.x() + 100.0 * p.y(), Vec2(1.0, 100.0)};
    });
    const Vec2 p(5.0, 2.0);
    double w = 0.0;
    expression_weight("2*err", expression_nu, expression_nv, {nullptr, error})->values({&p, 1}, {&w, 1});
    EXPECT_DOUBLE_EQ(w, 410.0);
    EXPECT_NE(fault_of("err").message.find("error"), std::string::npos);
    EXPECT_TRUE(speaks_of_error("1 + err*u"));
    EXPECT_FALSE(speaks_of_error("1 + u"));
    EXPECT_FALSE(speaks_of_error("1 + "));
}

TEST(ExpressionWeight, ItsFaultsAreKnownWithoutAnyGrid) {
    EXPECT_FALSE(fault_of_expression("1 + z*k1 + err/nx").has_value());
    ASSERT_TRUE(fault_of_expression("1 + foo").has_value());
    EXPECT_EQ(fault_of_expression("1 + foo")->place.column, 5);
    EXPECT_TRUE(fault_of_expression("u = 1").has_value());
    EXPECT_TRUE(fault_of_expression("1, 2").has_value());
}

TEST(ExpressionWeight, HasTheGradientOfItsFormula) {
    const WeightPtr w = expression_weight("1 + sin(u)*i + j^2", expression_nu, expression_nv);
    const Vec2 p(7.3, 4.1);
    Vec2 found = Vec2::Zero();
    w->gradients({&p, 1}, {&found, 1});
    EXPECT_NEAR(found.x(), std::sin(7.3 / 20.0) + 7.3 * std::cos(7.3 / 20.0) / 20.0, 1e-8);
    EXPECT_NEAR(found.y(), 8.2, 1e-8);
}

TEST(ExpressionWeight, DoesNotAskForValuesBeyondTheSurface) {
    const WeightPtr w = expression_weight("1 + sqrt(1 - u) + sqrt(v)", expression_nu, expression_nv);
    const Vec2 corner(expression_nu - 1, 0.0);
    Vec2 found = Vec2::Zero();
    EXPECT_NO_THROW(w->gradients({&corner, 1}, {&found, 1}));
    EXPECT_TRUE(is_finite(found));
}

TEST(ExpressionWeight, SyntaxErrorsHaveTheirColumn) {
    EXPECT_EQ(fault_of("1 + foo*u").place.column, 5);
    EXPECT_EQ(fault_of("1 + * u").place.column, 5);
    EXPECT_EQ(fault_of("2 $ u").place.column, 3);
    EXPECT_GT(fault_of("(1 + u").place.column, 0);
    EXPECT_GT(fault_of("").place.column, 0);
    EXPECT_GT(fault_of("sin()").place.column, 0);
    EXPECT_GT(fault_of("u, v").place.column, 0);
    EXPECT_NE(fault_of("1 + foo*u").message.find("foo"), std::string::npos);
    EXPECT_EQ(fault_of("1 + foo*u").message.find("position"), std::string::npos);
}

TEST(ExpressionWeight, DoesNotAssign) {
    EXPECT_EQ(fault_of("1 + (u = 0.5)").place.column, 8);
    EXPECT_EQ(fault_of("u += 1").place.column, 4);
}

TEST(ExpressionWeight, AValueThatIsNotFiniteIsAnErrorThatSaysWhere) {
    const test::WithoutTraps muparser_folds_constants; // 0/0
    for (const char* text : {"1/(u - 0.5)", "log(v)", "sqrt(u - 0.1)", "exp(1000*u)", "0/0*u"}) {
        const Diagnostic fault = fault_of(text);
        EXPECT_EQ(fault.place.column, 1) << text;
        EXPECT_NE(fault.message.find("no finite value at u = "), std::string::npos) << text;
    }
    EXPECT_NE(fault_of("1/(u - 0.5)").message.find("u = 0.5"), std::string::npos);
}

TEST(ExpressionWeight, OffTheNodesOfTheUniformGridIsLookedAtWhenAsked) {
    const WeightPtr w = expression_weight("1/(i - 0.5)", expression_nu, expression_nv); // no node has i = 0.5
    const Vec2 p(0.5, 3.0);
    double value_there = 0.0;
    EXPECT_THROW(w->values({&p, 1}, {&value_there, 1}), Error);
}

} // namespace
} // namespace millwright::grid
