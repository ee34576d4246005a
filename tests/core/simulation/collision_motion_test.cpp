#include "core/simulation/collision_motion.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/machine_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace millwright::simulation {
namespace {

std::vector<kinematics::MachineModel> shipped_machines() {
    std::vector<kinematics::MachineModel> machines;
    for (const char* name : {"ac-table", "bc-table-head", "ca-head", "tilted-c-table", "router-xyz"}) {
        machines.push_back(kinematics::read_machine(std::string("assets/machines/") + name + ".json"));
    }
    return machines;
}

class MotionDice {
public:
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
    }
    kinematics::AxisPositions positions(const kinematics::MachineModel& machine, double mm, double rad) {
        kinematics::AxisPositions positions(machine.axis_count());
        for (int n = 0; n < machine.axis_count(); ++n) {
            const bool linear = machine.axis(n).kind == kinematics::AxisKind::linear;
            positions[n] = between(-1.0, 1.0) * (linear ? mm : rad);
        }
        return positions;
    }
    Vec3 point(double reach) {
        return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
    }

private:
    std::mt19937 engine_{std::uint32_t{5}};
};

TEST(RelativeMotion, IsThatOfTheCarriers) {
    MotionDice dice;
    for (const kinematics::MachineModel& machine : shipped_machines()) {
        const auto from = dice.positions(machine, 100.0, 2.0), to = dice.positions(machine, 100.0, 2.0);
        std::string letters(1, '\0');
        for (const kinematics::MachineAxis& axis : machine.axes()) {
            letters += axis.letter;
        }
        for (const char moving : letters) {
            for (const char still : letters) {
                const RelativeMotion motion(machine, from, to, moving, still);
                const double t = dice.between(0.0, 1.0);
                const kinematics::AxisPositions now = from + t * (to - from);
                const Frame expected = kinematics::carrier_motion(machine, now, still).inverse() *
                                       kinematics::carrier_motion(machine, now, moving);
                EXPECT_TRUE(motion.at(t).isApprox(expected, 1e-12)) << machine.name() << moving << still;
            }
        }
    }
}

TEST(RelativeMotion, NoPointGoesFartherThanItsReach) {
    MotionDice dice;
    double closest = 0.0;
    for (const kinematics::MachineModel& machine : shipped_machines()) {
        for (int n = 0; n < 200; ++n) {
            const auto from = dice.positions(machine, 200.0, 1.5);
            const double share = std::pow(10.0, -dice.between(0.0, 4.0)); // of long and of short moves
            const kinematics::AxisPositions to = from + share * dice.positions(machine, 200.0, 3.0);
            const RelativeMotion motion(machine, from, to, tool_carrier(machine), work_carrier(machine));
            BodyBall ball{dice.point(50.0), dice.between(1.0, 100.0)};
            const double half = dice.between(0.1, 0.5) / motion.parts();
            const double t = dice.between(half, 1.0 - half);
            const double reach = motion.reach(t, half, ball);
            for (int k = 0; k < 40; ++k) {
                const Vec3 point = ball.center + ball.radius * dice.point(1.0).normalized();
                const double at = t + dice.between(-half, half);
                const double moved = (motion.at(at) * point - motion.at(t) * point).norm();
                EXPECT_LE(moved, reach * (1.0 + 1e-12) + 1e-10) << machine.name();
                closest = std::max(closest, moved / std::max(reach, 1e-12));
            }
        }
    }
    EXPECT_GT(closest, 0.9);
}

TEST(RelativeMotion, ATurnAboutTheToolMovesNothingOfIt) {
    const kinematics::MachineModel machine = kinematics::read_machine("assets/machines/ac-table.json");
    const kinematics::AxisPositions from = kinematics::AxisPositions::Zero(machine.axis_count());
    kinematics::AxisPositions to = from;
    to[machine.axis_index('C')] = 0.4;
    const RelativeMotion motion(machine, from, to, tool_carrier(machine), work_carrier(machine));
    const BodyBall ball{Vec3(0.0, 0.0, 20.0), 20.0};
    const BodyBall turned{ball.center, ball.radius, Vec3::UnitZ()};
    EXPECT_GT(motion.reach(0.5, 0.5, ball), 4.0);
    EXPECT_LT(motion.reach(0.5, 0.5, turned), 0.5 * motion.reach(0.5, 0.5, ball));
}

TEST(RelativeMotion, RestsWhereOnlyOthersMove) {
    const kinematics::MachineModel machine = kinematics::read_machine("assets/machines/ac-table.json");
    const kinematics::AxisPositions from = kinematics::AxisPositions::Zero(machine.axis_count());
    kinematics::AxisPositions to = from;
    to[machine.axis_index('A')] = 0.4;
    EXPECT_TRUE(RelativeMotion(machine, from, to, 'Z', '\0').rests());
    EXPECT_TRUE(RelativeMotion(machine, from, to, 'C', 'A').rests());
    EXPECT_FALSE(RelativeMotion(machine, from, to, 'C', '\0').rests());
    EXPECT_THROW(RelativeMotion(machine, from, to, 'U', '\0'), Defect);
}

} // namespace
} // namespace millwright::simulation
