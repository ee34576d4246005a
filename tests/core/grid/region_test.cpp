#include "core/grid/region.h"

#include "core/base/error.h"
#include "core/geometry/presets.h"
#include "core/grid/elliptic_adaptation.h"
#include "core/grid/weight.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace millwright::grid {
namespace {

/// 100 mm wide along u and v, so that 0.01 of a parameter is a millimetre.
geometry::BezierPatch plane() {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            net.point(i, j) = {100.0 * i, 100.0 * j, 0.0};
        }
    }
    return geometry::BezierPatch(net);
}

const Region square{{{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}}, 10.0};

// T20.
TEST(Region, CountsInsideOfItsOutlineAndFadesOverItsBorderInMillimetres) {
    const Field share = share_of(square, plane());
    EXPECT_EQ(share.at({0.5, 0.5}), 1.0);
    EXPECT_EQ(share.at({0.26, 0.74}), 1.0);
    EXPECT_NEAR(share.at({0.5, 0.80}), 0.5, 0.02) << "5 mm outside of 10";
    EXPECT_EQ(share.at({0.5, 0.86}), 0.0);
    EXPECT_EQ(share.at({0.0, 0.0}), 0.0);
    EXPECT_GT(share.at({0.80, 0.78}), 0.2) << "round about the corners";
    EXPECT_EQ(share.at({0.83, 0.83}), 0.0) << "11.3 mm from the corner";
}

TEST(Region, FollowsTheEvenOddRuleWhereTheOutlineCrossesItself) {
    const Region bow{{{0.2, 0.2}, {0.8, 0.8}, {0.8, 0.2}, {0.2, 0.8}}, 1.0};
    const Field share = share_of(bow, plane());
    EXPECT_EQ(share.at({0.7, 0.5}), 1.0);
    EXPECT_EQ(share.at({0.3, 0.5}), 1.0);
    EXPECT_EQ(share.at({0.5, 0.7}), 0.0);
}

TEST(Region, WithoutABorderItEndsAtItsOutline) {
    Region sharp = square;
    sharp.border_mm = 0.0;
    const Field share = share_of(sharp, plane());
    EXPECT_EQ(share.at({0.74, 0.5}), 1.0);
    EXPECT_EQ(share.at({0.77, 0.5}), 0.0);
}

TEST(Region, HasAllOfItsOutline) {
    Region whole{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}, 0.0};
    for (const bool reversed : {false, true}) {
        const Field share = share_of(whole, plane());
        EXPECT_EQ(std::ranges::min(share.values), 1.0) << reversed;
        std::ranges::reverse(whole.outline);
    }
    Region inner = square;
    inner.border_mm = 0.0;
    const Field share = share_of(inner, plane());
    for (const Vec2& on :
         {Vec2(0.25, 0.5), Vec2(0.75, 0.5), Vec2(0.5, 0.25), Vec2(0.5, 0.75), Vec2(0.75, 0.75)}) {
        EXPECT_EQ(share.at(on), 1.0) << on.transpose();
    }
}

TEST(Region, TwoCornersEncloseNothing) {
    EXPECT_THROW((void)share_of({{{0.0, 0.0}, {1.0, 1.0}}, 1.0}, plane()), Defect);
}

TEST(Region, AWeightWithinHasTheSlopeOfItsValues) {
    constexpr int nodes = 21;
    const WeightPtr weight =
        within(ring_weight({}), field_weight(share_of(square, plane()), nodes, nodes), 0.5);
    constexpr double h = 1e-5;
    for (const Vec2& at : {Vec2(3.3, 10.2), Vec2(10.1, 9.7), Vec2(16.2, 12.4), Vec2(4.4, 4.6)}) {
        const std::array<Vec2, 4> around{
            Vec2(at + Vec2(h, 0)), Vec2(at - Vec2(h, 0)), Vec2(at + Vec2(0, h)), Vec2(at - Vec2(0, h))};
        std::array<double, 4> w{};
        weight->values(around, w);
        std::array<Vec2, 1> slope{};
        weight->gradients({&at, 1}, slope);
        EXPECT_NEAR(slope[0].x(), (w[0] - w[1]) / (2.0 * h), 1e-5) << at.transpose();
        EXPECT_NEAR(slope[0].y(), (w[2] - w[3]) / (2.0 * h), 1e-5) << at.transpose();
    }
    std::array<double, 1> far{};
    const Vec2 corner(1.0, 1.0);
    weight->values({&corner, 1}, far);
    EXPECT_NEAR(far[0], 0.5, 1e-12);
}

// A difference in the last bit took another road: 863 iterations where 840 led to the same grid.
TEST(Region, OfTheWholeSurfaceLeavesTheWeightToTheLastBit) {
    constexpr int nodes = 21;
    const Region whole{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}, 0.0};
    const WeightPtr all = ring_weight({});
    const WeightPtr weight = within(all, field_weight(share_of(whole, plane()), nodes, nodes), 0.3);
    std::mt19937 random(20);
    std::uniform_real_distribution<double> place(0.0, nodes - 1.0);
    std::vector<Vec2> at(2000);
    std::ranges::generate(at, [&] { return Vec2(place(random), place(random)); });
    std::vector<double> w(at.size()), should(at.size());
    weight->values(at, w);
    all->values(at, should);
    EXPECT_EQ(w, should);
    std::vector<Vec2> slopes(at.size()), slopes_should(at.size());
    weight->gradients(at, slopes);
    all->gradients(at, slopes_should);
    EXPECT_EQ(slopes, slopes_should);
}

/// Largest way of a node whose start lies in [low, high]^2.
double largest_way(const Grid& moved, const Grid& start, double low, double high) {
    double largest = 0.0;
    for (int i = 0; i < start.nu(); ++i) {
        for (int j = 0; j < start.nv(); ++j) {
            const Vec2& uv = start.node(i, j);
            if (uv.minCoeff() >= low && uv.maxCoeff() <= high) {
                largest = std::max(largest, (moved.node(i, j) - uv).norm());
            }
        }
    }
    return largest;
}

/// Two equal bumps of the weight; the region holds the one at a quarter.
class TwoBumps final : public Weight {
public:
    void values(std::span<const Vec2> at, std::span<double> w) const override {
        for (std::size_t k = 0; k < at.size(); ++k) {
            w[k] = 0.05 + bump(at[k], first) + bump(at[k], second);
        }
    }
    void gradients(std::span<const Vec2> at, std::span<Vec2> gradient) const override {
        for (std::size_t k = 0; k < at.size(); ++k) {
            gradient[k] =
                Vec2(-2.0 / wide *
                     (bump(at[k], first) * (at[k] - first) + bump(at[k], second) * (at[k] - second)));
        }
    }
    inline static const Vec2 first{6.0, 6.0};
    inline static const Vec2 second{18.0, 18.0};

private:
    static constexpr double wide = 6.0;
    static double bump(const Vec2& at, const Vec2& middle) {
        return std::exp(-(at - middle).squaredNorm() / wide);
    }
};

// T20.
TEST(EllipticAdaptation, ActsInTheRegionOnly) {
    constexpr int nodes = 25;
    const Grid start = Grid::uniform(nodes, nodes);
    const SpikeErrorModel model{SpikeErrorModel::Shape{}};
    const Region region{{{0.05, 0.05}, {0.45, 0.05}, {0.45, 0.45}, {0.05, 0.45}}, 3.0};
    const auto made = [&](WeightPtr share) {
        EllipticAdaptationSettings settings;
        settings.functional.adaptation = 10.0;
        settings.max_rounds = 1;
        settings.region = std::move(share);
        EllipticAdaptation adaptation(model, start, settings, std::make_shared<TwoBumps>());
        while (adaptation.state().round == 0 && adaptation.advance(Progress())) {
        }
        return Grid(adaptation.state().current);
    };
    const Grid everywhere = made(nullptr);
    const Grid in_region = made(field_weight(share_of(region, plane()), nodes, nodes));
    // the same pull in both halves without it, and with it in the first alone
    const auto cell = [](const Grid& grid, int n) {
        return (grid.node(n + 1, n + 1) - grid.node(n - 1, n - 1)).norm();
    };
    EXPECT_NEAR(cell(everywhere, 6) / cell(everywhere, 18), 1.0, 0.02);
    EXPECT_LT(cell(in_region, 6), 0.8 * cell(start, 6)) << "cells gather in the region";
    EXPECT_GT(cell(in_region, 18), 1.0 * cell(start, 18)) << "and at no bump outside of it";
    EXPECT_GT(largest_way(in_region, start, 0.05, 0.45), 2.0 * largest_way(in_region, start, 0.6, 1.0));
}

} // namespace
} // namespace millwright::grid
