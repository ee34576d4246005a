#include "core/simulation/internal/tile_sweep.h"

#include "core/base/units.h"
#include "core/simulation/removal.h"
#include "core/toolpath/cutter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace millwright::simulation {
namespace {

using geometry::ToolPose;
using toolpath::CutterKind;
using toolpath::CutterShape;

std::vector<CutterShape> swept_shapes() {
    return {{CutterKind::ball, 6.0, 0.0, 0.0, 20.0},
            {CutterKind::flat, 6.0, 0.0, 0.0, 20.0},
            {CutterKind::bull_nose, 8.0, 1.0, 0.0, 20.0},
            {CutterKind::cone, 6.0, 0.5, from_degrees(10.0), 30.0},
            {CutterKind::cone, 6.0, 0.0, from_degrees(30.0), 20.0},
            {CutterKind::cone, 5.0, 0.0, from_degrees(59.0), 20.0}};
}

/// Steps of up to 1.5 mm and the largest turn; of every four one goes straight up and down, one turns about
/// its tip alone.
class RandomSteps {
public:
    explicit RandomSteps(unsigned seed) : engine_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    Vec3 direction() {
        Vec3 found;
        do {
            found = {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)};
        } while (found.norm() > 1.0 || found.norm() < 0.1);
        return found.normalized();
    }
    std::pair<ToolPose, ToolPose> step(const Vec3& around, int n) {
        const ToolPose from{around + 2.0 * direction(), n % 4 == 0 ? Vec3::UnitZ() : direction()};
        const Vec3 way = n % 4 == 1 ? Vec3::Zero() : Vec3(between(0.05, 1.5) * direction());
        const Vec3 about = from.axis.cross(direction()).normalized();
        const double turn = n % 4 == 0 ? 0.0 : between(0.0, largest_turn);
        return {from, {from.tip + way, Vec3(Eigen::AngleAxisd(turn, about) * from.axis).normalized()}};
    }

private:
    std::mt19937 engine_;
};

template <class Value> bool same_bytes(const Value& a, const Value& b) {
    return std::memcmp(&a, &b, sizeof(Value)) == 0;
}

TEST(TileSweep, GivesTheSameBytesInRegistersOfEveryWidth) {
    const auto kinds = tile_sweeps();
    ASSERT_FALSE(kinds.empty());
    RandomSteps random(4);
    int reached = 0;
    for (const CutterShape& shape : swept_shapes()) {
        const BodyRay body(toolpath::body_of(shape)->shape());
        for (int n = 0; n < 60; ++n) {
            const auto [from, to] = random.step(Vec3::Zero(), n);
            const SweptCutter cutter(body, from, to);
            const TileMotion motion(body.zones(), cutter.motion(), n % 3);
            TileLines lines;
            LaneTries tries;
            std::array<LaneSearch, Tile::side> searches;
            for (int i = 0; i < Tile::side; ++i) {
                tries.u[i] = lines.u[i] = 0.9 * (i - 3.4) + motion.tip[0];
                tries.v[i] = lines.v[i] = 0.8 * (i - 3.6) + motion.tip[1];
            }
            std::fill_n(lines.from, Tile::lines, -100.0);
            std::fill_n(lines.to, Tile::lines, 100.0);
            TileLines covered = lines;
            kinds.front().outline(motion, covered);
            TileLines seen = lines;
            kinds.front().look(motion, seen);
            EXPECT_NE(covered.reached, 0U) << "step " << n;
            LaneTries tried = tries;
            kinds.front().attempt(motion, 0.4, tried);
            for (std::size_t i = 0; i < searches.size(); ++i) {
                LaneSearch& search = searches[i];
                search = {.u = tries.u[i], .v = tries.v[i], .enough = -missed};
                search.far_end = i % 2 == 0 ? 0.0 : 1.0;
                search.left_value = tried.value[i % 2][i];
                search.left_rate = -1.0;
            }
            std::array<LaneSearch, Tile::side> found = searches;
            kinds.front().search(motion, found.data());
            reached += seen.reached != 0 ? 1 : 0;
            for (const TileSweep& kind : kinds.subspan(1)) {
                TileLines covered_too = lines;
                kind.outline(motion, covered_too);
                EXPECT_EQ(covered.reached, covered_too.reached) << kind.lanes_in_register << " step " << n;
                TileLines seen_too = lines;
                kind.look(motion, seen_too);
                EXPECT_TRUE(same_bytes(seen, seen_too)) << kind.lanes_in_register << " step " << n;
                LaneTries tried_too = tries;
                kind.attempt(motion, 0.4, tried_too);
                EXPECT_TRUE(same_bytes(tried, tried_too)) << kind.lanes_in_register << " step " << n;
                std::array<LaneSearch, Tile::side> found_too = searches;
                kind.search(motion, found_too.data());
                EXPECT_TRUE(same_bytes(found, found_too)) << kind.lanes_in_register << " step " << n;
            }
        }
    }
    EXPECT_GT(reached, 200);
}

/// How deep a point lies in the body at the deepest of many moments; above 0: outside.
double deepest(const toolpath::Profile& body, const SweptCutter& cutter, const Vec3& point) {
    double least = missed;
    for (int i = 0; i <= 400; ++i) {
        least = std::min(least, toolpath::distance(body, cutter.pose(i / 400.0), point));
    }
    return least;
}

/// Lines of which more or less was removed than the cutter sweeps, judged by the normal.
TEST(TileSweep, RemovesWhatEveryLineAloneMeets) {
    RandomSteps random(5);
    int compared = 0, searched = 0;
    for (const CutterShape& shape : swept_shapes()) {
        const toolpath::Profile profile = *toolpath::body_of(shape);
        const CuttingBody body(profile);
        for (int n = 0; n < 40; ++n) {
            const BoxStock stock{{0.0, 0.0, 0.0}, {12.0, 11.0, 10.0}};
            DexelField field(stock, 0.35, 100'000'000, Progress());
            const auto [from, to] = random.step({6.0, 5.5, 5.0}, n);
            const SweptCutter cutter(body.body, from, to);
            const std::vector<CutStep> steps{{&body, from, to, 0, false}};
            Removal removal(field);
            removal.remove(steps, Progress());
            for (int k = 0; k < 3; ++k) {
                const int u = (k + 1) % 3, v = (k + 2) % 3;
                for (int j = 0; j < field.count()[static_cast<std::size_t>(v)]; ++j) {
                    for (int i = 0; i < field.count()[static_cast<std::size_t>(u)]; ++i) {
                        Vec3 at = from.tip;
                        at[u] = field.middle(u, i);
                        at[v] = field.middle(v, j);
                        const auto expected = cutter.swept(at, k);
                        const double top = field.box().max()[k];
                        // What is left, as an interval that is missing in one piece.
                        Interval missing{top, 0.0};
                        double last = 0.0;
                        for (const Dexel& piece : field.line(k, i, j)) {
                            if (static_cast<double>(piece.from) > last) {
                                missing = {last, static_cast<double>(piece.from)};
                            }
                            last = static_cast<double>(piece.to);
                        }
                        if (last < top - 1e-4) {
                            missing = {last, top};
                        }
                        const Interval want = expected ? Interval{std::clamp(expected->from, 0.0, top),
                                                                  std::clamp(expected->to, 0.0, top)}
                                                       : Interval{top, 0.0};
                        const bool wanted = want.from < want.to, is_missing = missing.from < missing.to;
                        ++compared;
                        searched += wanted ? 1 : 0;
                        const auto expect_shallow = [&](double a, double b) {
                            if (std::abs(a - b) > 2e-3) {
                                at[k] = 0.5 * (a + b);
                                EXPECT_GT(deepest(profile, cutter, at), -2e-3)
                                    << "step " << n << " family " << k << " from " << a << " to " << b;
                            }
                        };
                        if (wanted && is_missing) {
                            expect_shallow(want.from, missing.from);
                            expect_shallow(want.to, missing.to);
                        } else if (wanted) {
                            expect_shallow(want.from, want.to);
                        } else if (is_missing) { // found between the moments that the other looks at
                            at[k] = 0.5 * (missing.from + missing.to);
                            EXPECT_LT(deepest(profile, cutter, at), 2e-3);
                        }
                    }
                }
            }
        }
    }
    EXPECT_GT(searched, 50'000);
    EXPECT_GT(compared, searched);
}

TEST(SweptOutline, HoldsAllPositionsOfTheBody) {
    RandomSteps random(6);
    for (const CutterShape& shape : swept_shapes()) {
        const toolpath::Profile profile = *toolpath::body_of(shape);
        const BodyRay body(profile.shape());
        for (int n = 0; n < 40; ++n) {
            const auto [from, to] = random.step(Vec3::Zero(), n);
            const SweptCutter cutter(body, from, to);
            const int k = n % 3;
            const TileMotion motion(body.zones(), cutter.motion(), k);
            for (std::size_t d = 0; d < SweptOutline::directions; ++d) {
                Vec3 normal = Vec3::Zero();
                normal[(k + 1) % 3] = SweptOutline::normals()[d][0];
                normal[(k + 2) % 3] = SweptOutline::normals()[d][1];
                double high = -missed;
                for (int i = 0; i <= 50; ++i) {
                    const ToolPose pose = cutter.pose(i / 50.0);
                    const double along = normal.dot(pose.axis);
                    const double across = std::sqrt(std::max(1.0 - along * along, 0.0));
                    const Vec2 farthest = profile.support({across, along});
                    high =
                        std::max(high, normal.dot(pose.tip) + across * farthest.x() + along * farthest.y());
                }
                EXPECT_GE(motion.outline.high[d], high);
                EXPECT_LT(motion.outline.high[d], high + shape.corner_radius + 3.0);
            }
        }
    }
}

} // namespace
} // namespace millwright::simulation
