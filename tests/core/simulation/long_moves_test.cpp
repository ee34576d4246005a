// Long straight moves of a cutter towards, along and away from a box. The judge is the distance of an upright
// cylinder to an upright box, in closed form, at many moments. Lengths mm.
#include "core/kinematics/machine_file.h"
#include "core/simulation/collision.h"
#include "core/simulation/collision_mesh.h"
#include "core/toolpath/cutter.h"
#include "tests/core/simulation/written_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>

namespace millwright::simulation {
namespace {

const kinematics::MachineModel& long_router() {
    static const kinematics::MachineModel machine =
        kinematics::read_machine("assets/machines/router-xyz.json");
    return machine;
}

constexpr double tool_radius = 5.0, tool_length = 50.0;

toolpath::Profile upright_tool() {
    return toolpath::Profile({.flat = tool_radius, .radius = tool_radius, .bottom = 0.0, .top = tool_length});
}

struct LongMove {
    Box3 box;
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    double clearance = 1.0;
};

/// Below 0 where they overlap.
double distance_at(const LongMove& move, double t) {
    const Vec3 tip = move.from + t * (move.to - move.from);
    const Vec3 off = (move.box.min() - tip).cwiseMax(tip - move.box.max());
    const double beside = std::hypot(std::max(off.x(), 0.0), std::max(off.y(), 0.0)) - tool_radius;
    const double along = std::max(tip.z() - move.box.max().z(), move.box.min().z() - tip.z() - tool_length);
    return beside > 0.0 && along > 0.0 ? std::hypot(beside, along) : std::max(beside, along);
}

CollisionReport checked(const LongMove& move) {
    const kinematics::MachineModel& machine = long_router();
    WrittenProgram writer(machine);
    const auto go = [&](program::BlockKind kind, const Vec3& to) {
        writer.go(kind, {{'X', to.x()}, {'Y', to.y()}, {'Z', to.z()}});
    };
    go(program::BlockKind::rapid, move.from);
    go(program::BlockKind::feed, move.to);
    return check_collisions(
        {.program = writer.program(),
         .machine = machine,
         .tools = {{.cutter = upright_tool()}},
         .bodies = {collision_body(machine,
                                   "fixture",
                                   BodyRole::fixture,
                                   surface_of(Stock(BoxStock{move.box.min(), move.box.max()})),
                                   true)},
         .first_block = 1,
         .clearance = move.clearance},
        Progress());
}

TEST(LongMoves, EndInAFixtureThatIsFound) {
    const LongMove move{Box3(Vec3(150.0, 47.0, -20.0), Vec3(175.0, 117.0, 31.0)),
                        Vec3(46.0, 83.0, 1.0),
                        Vec3(148.0, 83.0, 1.0)};
    const CollisionReport found = checked(move);
    ASSERT_EQ(found.collisions.size(), 1U);
    EXPECT_NEAR(found.collisions.front().time * 102.0, 99.0, 0.01);
    EXPECT_NEAR(found.collisions.front().depth, 3.0, 0.01);
}

TEST(LongMoves, AgreeWithTheirDistancesAtManyMoments) {
    std::mt19937 engine(77);
    const auto between = [&](double low, double high) {
        return low + (high - low) * (static_cast<double>(engine()) / 4294967296.0);
    };
    constexpr int moves = 300, moments = 20'000;
    int met = 0, near = 0, apart = 0;
    for (int n = 0; n < moves; ++n) {
        const Vec3 size(between(10.0, 120.0), between(10.0, 120.0), between(10.0, 120.0));
        LongMove move{Box3(Vec3(0.0, -0.5 * size.y(), -0.5 * size.z()),
                           Vec3(size.x(), 0.5 * size.y(), 0.5 * size.z()))};
        move.clearance = between(0.02, 2.0);
        const double depth = between(-2.0 * move.clearance, 4.0);
        const double length = between(20.0, 300.0), angle = between(-0.3, 0.3);
        const Vec3 near_box(-tool_radius + depth,
                            between(-0.5 * size.y(), 0.5 * size.y()),
                            between(-0.5 * size.z() - 40.0, 0.5 * size.z() - 10.0));
        const Vec3 inwards(std::cos(angle), std::sin(angle), between(-0.1, 0.1));
        move.from = near_box - length * inwards;
        move.to = near_box;
        if (n % 3 == 1) { // along the side
            move.from = near_box - Vec3(0.0, between(0.2, 0.8) * length, 0.0);
            move.to = move.from + Vec3(0.0, length, 0.0);
        } else if (n % 3 == 2) {
            std::swap(move.from, move.to);
        }
        double least = std::numeric_limits<double>::infinity(), first = -1.0;
        for (int k = 0; k <= moments; ++k) {
            const double distance = distance_at(move, static_cast<double>(k) / moments);
            least = std::min(least, distance);
            if (distance < -touch_depth && first < 0.0) {
                first = static_cast<double>(k) / moments;
            }
        }
        const CollisionReport found = checked(move);
        constexpr double unsure = 0.01; // mm
        if (least < -touch_depth - unsure) {
            ++met;
            ASSERT_EQ(found.collisions.size(), 1U) << n << ": " << least;
            EXPECT_NEAR(found.collisions.front().time * length, first * length, 0.05) << n;
            continue;
        }
        if (least > unsure) {
            EXPECT_TRUE(found.collisions.empty()) << n << ": " << least;
        }
        if (least > unsure && least < 0.7 * move.clearance) {
            ++near;
            ASSERT_EQ(found.near_misses.size(), 1U) << n << ": " << least << " of " << move.clearance;
            EXPECT_GT(found.near_misses.front().depth, least - unsure) << n;
            EXPECT_LT(found.near_misses.front().depth, 1.4 * least + unsure) << n;
        } else if (least > move.clearance + unsure) {
            ++apart;
            EXPECT_TRUE(found.near_misses.empty()) << n;
        }
    }
    EXPECT_GT(met, 100);
    EXPECT_GT(near, 20);
    EXPECT_GT(apart, 20);
}

// What lies beyond the wanted distance says nothing of what is within it.
TEST(CollisionMesh, FindsWhatIsBelowTheWantedDistance) {
    std::mt19937 engine(5);
    const auto between = [&](double low, double high) {
        return low + (high - low) * (static_cast<double>(engine()) / 4294967296.0);
    };
    for (int n = 0; n < 300; ++n) {
        LongMove move{Box3(Vec3(0.0, -between(5.0, 60.0), -between(5.0, 60.0)),
                           Vec3(between(5.0, 60.0), between(5.0, 60.0), between(5.0, 60.0)))};
        move.from = move.to = Vec3(-between(10.0, 150.0), between(-60.0, 60.0), between(-60.0, 20.0));
        const double exact = distance_at(move, 0.0);
        const CollisionMesh mesh(surface_of(Stock(BoxStock{move.box.min(), move.box.max()})));
        const geometry::ToolPose pose{move.from, Vec3::UnitZ()};
        const double below = exact + between(0.002, 0.1) * exact;
        const auto found = mesh.nearest(upright_tool(), pose, {.below = below});
        ASSERT_TRUE(found.has_value()) << n << ": " << exact << " below " << below;
        EXPECT_GT(found->distance, exact - 1e-6) << n;
        EXPECT_LT(found->distance, below) << n;
    }
}

} // namespace
} // namespace millwright::simulation
