#include "ui/viewport/machine_bodies.h"

#include "core/kinematics/forward.h"
#include "core/kinematics/machine_solids.h"
#include "tests/ui/viewport/scenes.h"
#include "tests/ui/viewport/views.h"

#include <gtest/gtest.h>

namespace millwright::viewport {
namespace {

using kinematics::AxisPositions;
using kinematics::MachineBody;
using kinematics::MachineModel;
using test::exact_mm;

AxisPositions some_positions(const MachineModel& machine) {
    AxisPositions positions(machine.axis_count());
    for (int k = 0; k < machine.axis_count(); ++k) {
        positions[k] = machine.axis(k).kind == kinematics::AxisKind::linear ? 20.0 + 7.0 * k : 0.3 + 0.1 * k;
    }
    return positions;
}

TEST(BodyPoses, CarryEachBodysCentreWithItsAxis) {
    for (const char* name :
         {"rotary-tilt-listing", "ac-table", "bc-table-head", "ca-head", "tilted-c-table"}) {
        const MachineModel machine = test::machine(name);
        const AxisPositions positions = some_positions(machine);
        const std::vector<Frame> poses = body_poses(machine, positions);
        const auto& bodies = machine.description().bodies;
        ASSERT_EQ(poses.size(), bodies.size());
        for (std::size_t k = 0; k < bodies.size(); ++k) {
            const Frame carrier = kinematics::carrier_motion(machine, positions, bodies[k].carried_by);
            EXPECT_LT((poses[k].translation() - carrier * bodies[k].center).norm(), exact_mm) << name << k;
        }
    }
}

TEST(BodyPoses, TurnACylindersHeightWithItsAxis) {
    for (const char* name :
         {"rotary-tilt-listing", "ac-table", "bc-table-head", "ca-head", "tilted-c-table"}) {
        const MachineModel machine = test::machine(name);
        const AxisPositions positions = some_positions(machine);
        const std::vector<Frame> poses = body_poses(machine, positions);
        for (std::size_t k = 0; k < poses.size(); ++k) {
            const MachineBody& body = machine.description().bodies[k];
            if (body.shape == MachineBody::Shape::cylinder) {
                const Frame carrier = kinematics::carrier_motion(machine, positions, body.carried_by);
                const Vec3 height = poses[k].linear() * Vec3::UnitZ();
                EXPECT_LT((height - carrier.linear() * body.direction).norm(), exact_mm) << name << k;
            }
        }
    }
}

TEST(BodyPoses, PutTheTableUnderTheWorkpieceWhateverTheAxes) {
    const MachineModel machine = test::machine("ac-table");
    const AxisPositions positions = some_positions(machine);
    const MachineBody& table = machine.description().bodies.front();
    const Vec3 top_b(0.0, 0.0, 0.5 * table.size.z());
    const Vec3 origin_w(0.0, 0.0, -50.0); // the workpiece stands 50 mm above the table
    const Vec3 expected = kinematics::m_T_w(machine, positions) * origin_w;
    EXPECT_LT((body_poses(machine, positions).front() * top_b - expected).norm(), exact_mm);
}

TEST(Cutter, IsOneBodyWithItsEndAtTheToolsTip) {
    for (const char* name :
         {"rotary-tilt-listing", "ac-table", "bc-table-head", "ca-head", "tilted-c-table"}) {
        const MachineModel machine = test::machine(name);
        int cutters = 0;
        for (const MachineBody& body : machine.description().bodies) {
            if (is_cutter(machine, body)) {
                ++cutters;
                EXPECT_LT((body.center - machine.description().tool_tip).norm(), body.size.z());
            }
        }
        EXPECT_EQ(cutters, 1) << name;
    }
}

} // namespace
} // namespace millwright::viewport
