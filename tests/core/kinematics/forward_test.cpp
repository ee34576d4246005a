#include "core/kinematics/forward.h"

#include "core/base/units.h"
#include "core/kinematics/inverse.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

namespace millwright::kinematics {
namespace {

MachineModel head_head_machine() {
    MachineDescription machine;
    machine.name = "fork head";
    const auto axis = [](char letter, AxisKind kind, const Vec3& direction, const Vec3& point) {
        MachineAxis result;
        result.letter = letter;
        result.kind = kind;
        result.direction = direction.normalized();
        result.point = point;
        result.max_velocity = 1.0;
        result.max_acceleration = 1.0;
        return result;
    };
    machine.table = {axis('Y', AxisKind::linear, Vec3::UnitY(), Vec3::Zero())};
    machine.head = {axis('X', AxisKind::linear, Vec3::UnitX(), Vec3::Zero()),
                    axis('Z', AxisKind::linear, Vec3::UnitZ(), Vec3::Zero()),
                    axis('C', AxisKind::rotary, Vec3::UnitZ(), {10, 0, 0}),
                    axis('B', AxisKind::rotary, {0, 1, 0.2}, {12, 0, 150})};
    machine.tool_tip = {12, 0, 0};
    machine.workpiece_offset = {5, 6, 7};
    return MachineModel(machine);
}

/// The same by multiplying frames.
geometry::ToolPose by_frames(const MachineModel& machine, const AxisPositions& q) {
    const Frame w_T_m = m_T_w(machine, q).inverse();
    const char last = machine.axis(machine.head_chain().back()).letter;
    const Frame head = carrier_motion(machine, q, last);
    return {w_T_m * (head * machine.description().tool_tip),
            w_T_m.linear() * (head.linear() * machine.description().tool_axis)};
}

AxisPositions random_positions(const MachineModel& machine, std::mt19937& random) {
    std::uniform_real_distribution<double> mm(-200.0, 200.0);
    std::uniform_real_distribution<double> rad(-pi, pi);
    AxisPositions q(machine.axis_count());
    for (int n = 0; n < machine.axis_count(); ++n) {
        q[n] = machine.axis(n).kind == AxisKind::linear ? mm(random) : rad(random);
    }
    return q;
}

std::vector<MachineModel> machines() {
    return {test::machine("rotary-tilt-listing"),
            test::machine("ac-table"),
            test::machine("bc-table-head"),
            test::machine("ca-head"),
            test::machine("tilted-c-table"),
            head_head_machine()};
}

TEST(Forward, EqualsTheProductOfFrames) {
    std::mt19937 random(3);
    for (const MachineModel& machine : machines()) {
        for (int n = 0; n < 200; ++n) {
            const AxisPositions q = random_positions(machine, random);
            const auto pose = forward(machine, q);
            const auto frames = by_frames(machine, q);
            EXPECT_LT((pose.tip - frames.tip).norm(), round_trip_mm) << machine.name();
            EXPECT_LT((pose.axis - frames.axis).norm(), 1e-13) << machine.name();
        }
    }
}

TEST(StraightForward, IsTheForwardOfEveryPointOnTheWay) {
    std::mt19937 random(9);
    for (const MachineModel& machine : machines()) {
        for (int trial = 0; trial < 20; ++trial) {
            const AxisPositions from = random_positions(machine, random);
            const AxisPositions to = random_positions(machine, random);
            const StraightForward way(machine, from, to);
            for (const double t : {0.0, 0.3, 0.5, 1.0}) {
                const geometry::ToolPose pose = way.at(t);
                const geometry::ToolPose expected = forward(machine, from + t * (to - from));
                EXPECT_LT((pose.tip - expected.tip).norm(), 1e-11) << machine.name() << " at " << t;
                EXPECT_LT((pose.axis - expected.axis).norm(), 1e-14) << machine.name() << " at " << t;
            }
        }
    }
}

/// By second differences, whose error is that of the fourth derivative.
TEST(StraightForward, BendsNoMoreThanItSays) {
    std::mt19937 random(10);
    constexpr double h = 1e-3;
    for (const MachineModel& machine : machines()) {
        for (int trial = 0; trial < 20; ++trial) {
            const AxisPositions from = random_positions(machine, random);
            const StraightForward way(machine, from, from + 0.3 * (random_positions(machine, random) - from));
            const Bend bend = way.bend();
            Bend found;
            for (const double t : {0.01, 0.2, 0.5, 0.8, 0.99}) {
                const auto a = way.at(t - h), b = way.at(t), c = way.at(t + h);
                found.tip = std::max(found.tip, (a.tip - 2.0 * b.tip + c.tip).norm() / (h * h));
                found.axis = std::max(found.axis, (a.axis - 2.0 * b.axis + c.axis).norm() / (h * h));
            }
            EXPECT_LE(found.tip, bend.tip * (1.0 + 1e-4) + 1e-4) << machine.name();
            EXPECT_LE(found.axis, bend.axis * (1.0 + 1e-4) + 1e-6) << machine.name();
            EXPECT_LE(bend.tip, 50.0 * found.tip + 1e-3) << machine.name(); // it says something
        }
    }
}

TEST(Forward, OfTheLinearAxesAloneIsTheLinearMap) {
    std::mt19937 random(5);
    for (const MachineModel& machine : machines()) {
        for (int n = 0; n < 50; ++n) {
            const AxisPositions q = random_positions(machine, random);
            const LinearMap map = linear_map(machine, q);
            Vec3 tip = map.tip_at_zero;
            for (int k = 0; k < 3; ++k) {
                tip += q[machine.linear_axes()[static_cast<std::size_t>(k)]] * map.columns.col(k);
            }
            EXPECT_LT((forward(machine, q).tip - tip).norm(), round_trip_mm) << machine.name();
        }
    }
}

TEST(MachineJacobian, EqualsCentralDifferences) {
    std::mt19937 random(4);
    constexpr double h = 1e-6;
    for (const MachineModel& machine : machines()) {
        for (int n = 0; n < 50; ++n) {
            const AxisPositions q = random_positions(machine, random);
            const Jacobian J = jacobian(machine, q);
            for (int k = 0; k < machine.axis_count(); ++k) {
                AxisPositions up = q, down = q;
                up[k] += h;
                down[k] -= h;
                const auto a = forward(machine, up);
                const auto b = forward(machine, down);
                EXPECT_LT((J.col(k).head<3>() - (a.tip - b.tip) / (2 * h)).norm(), 1e-6);
                EXPECT_LT((J.col(k).tail<3>() - (a.axis - b.axis) / (2 * h)).norm(), 1e-8);
            }
        }
    }
}

TEST(CarrierMotion, OfTheBaseIsNoMotion) {
    const MachineModel machine = test::machine("ac-table");
    EXPECT_TRUE(carrier_motion(machine, AxisPositions::Ones(5), '\0').isApprox(Frame::Identity()));
}

} // namespace
} // namespace millwright::kinematics
