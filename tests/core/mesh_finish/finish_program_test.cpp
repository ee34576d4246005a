#include "core/mesh_finish/finish_program.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"
#include "core/mesh_finish/mesh_inspection.h"
#include "core/toolpath/cutter.h"
#include "tests/core/mesh_finish/made_meshes.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace millwright::mesh_finish {
namespace {

using program::Block;
using program::BlockKind;
using program::MoveRole;

FinishPath path_of(const Vec3& axis, const Vec3& shift, std::optional<double> allowance = std::nullopt) {
    exchange::TriangleMesh mesh = test::graph_mesh(
        {0, 20, 0, 10}, 20, 10, [](double x, double y) { return std::sin(0.5 * x) * std::cos(0.4 * y); });
    for (Vec3& point : mesh.points) {
        point += shift;
    }
    const DropTree tree = drop_tree(mesh, inspect(mesh, Progress()).open, pass_frame(axis, 0.0), Progress());
    const toolpath::CutterShape ball{.kind = toolpath::CutterKind::ball, .diameter = 4.0};
    return finish(tree,
                  CutterOutline(*toolpath::body_of(ball)),
                  {.axis = axis, .step_over = 1.0, .allowance = allowance},
                  Progress());
}

const Vec3 on_table(50.0, 50.0, -20.0);

TEST(FinishProgram, PutsTheTipWhereThePathHasIt) {
    const kinematics::MachineModel router = test::machine("router-xyz");
    const FinishPath path = path_of(Vec3::UnitZ(), on_table);
    const program::Program made = finish_program(router, path, {}, {"relief"}, Progress());
    std::size_t plunges = 0;
    std::size_t point = 0;
    for (const Block& block : made.blocks) {
        const Vec3 tip = kinematics::forward(router, block.target).tip;
        if (block.role == MoveRole::plunge) {
            EXPECT_LT((tip - path.passes[plunges].tips.front()).norm(), 1e-4);
            ++plunges;
            point = 0;
        } else if (block.role == MoveRole::cut) {
            EXPECT_LT((tip - path.passes[plunges - 1].tips[++point]).norm(), 1e-4);
            EXPECT_NEAR(block.feed, program::ProgramSettings().cutting_feed, 0.1);
        }
    }
    EXPECT_EQ(plunges, path.passes.size());
    EXPECT_EQ(made.blocks.front().text, "relief");
    EXPECT_EQ(made.blocks.back().kind, BlockKind::end);
}

TEST(FinishProgram, IsFastBelowTheTopOfTheMeshWhereTheMaterialIsKnownAlone) {
    const kinematics::MachineModel router = test::machine("router-xyz");
    const FinishPath path = path_of(Vec3::UnitZ(), on_table);
    const program::Program made = finish_program(router, path, {}, {}, Progress());
    Vec3 last = kinematics::forward(router, made.start).tip;
    int slow = 0;
    for (const Block& block : made.blocks) {
        const Vec3 tip = kinematics::forward(router, block.target).tip;
        const bool straight_up = (tip - last).head<2>().norm() < 1e-9 && tip.z() > last.z();
        if (block.kind == BlockKind::rapid && !straight_up) {
            EXPECT_GE(tip.z(), path.safe_level - 1e-3);
        }
        slow += block.kind == BlockKind::feed && block.role == MoveRole::link ? 1 : 0;
        last = tip;
    }
    EXPECT_GT(slow, 0);
}

TEST(FinishProgram, TravelsAcrossAboveTheMeshAlone) {
    const kinematics::MachineModel router = test::machine("router-xyz");
    const FinishPath path = path_of(Vec3::UnitZ(), on_table, 0.3);
    const program::Program made = finish_program(router, path, {}, {}, Progress());
    Vec3 last = kinematics::forward(router, made.start).tip;
    int across = 0;
    for (const Block& block : made.blocks) {
        const Vec3 tip = kinematics::forward(router, block.target).tip;
        if (block.kind == BlockKind::rapid && (tip - last).head<2>().norm() > 1e-9) {
            EXPECT_NEAR(tip.z(), last.z(), 1e-9);
            EXPECT_GT(tip.z(), on_table.z() + 0.8);
            ++across;
        }
        last = tip;
    }
    EXPECT_EQ(across, static_cast<int>(path.passes.size()));
}

TEST(FinishProgram, ComesDownFastToTheMaterialWhoseThicknessIsKnown) {
    const kinematics::MachineModel router = test::machine("router-xyz");
    const auto plunged = [&](std::optional<double> allowance) {
        const FinishPath path = path_of(Vec3::UnitZ(), on_table, allowance);
        const program::Program made = finish_program(router, path, {}, {}, Progress());
        double longest = 0.0;
        Vec3 last = kinematics::forward(router, made.start).tip;
        for (const Block& block : made.blocks) {
            const Vec3 tip = kinematics::forward(router, block.target).tip;
            longest = block.role == MoveRole::plunge ? std::max(longest, (tip - last).norm()) : longest;
            last = tip;
        }
        return longest;
    };
    EXPECT_GE(plunged(0.3), 2.3 - 1e-3); // with link_clearance
    EXPECT_LE(plunged(0.3), 2.4);        // slopes have more of the material above them
    EXPECT_GT(plunged(std::nullopt), 2.5);
}

TEST(FinishProgram, HoldsATiltedToolOnAFiveAxisMachine) {
    const kinematics::MachineModel head = test::machine("ca-head");
    const Vec3 axis = Vec3(0.3, 0.2, 1.0).normalized();
    const FinishPath path = path_of(axis, Vec3::Zero());
    const program::Program made = finish_program(head, path, {}, {}, Progress());
    std::size_t plunges = 0;
    for (const Block& block : made.blocks) {
        if (block.role == MoveRole::plunge) {
            const geometry::ToolPose pose = kinematics::forward(head, block.target);
            EXPECT_LT((pose.axis - axis).norm(), 1e-5);
            EXPECT_LT((pose.tip - path.passes[plunges++].tips.front()).norm(), 1e-2);
        }
    }
    EXPECT_EQ(plunges, path.passes.size());
}

TEST(FinishProgram, RefusesWhatTheMachineCannotDo) {
    const kinematics::MachineModel router = test::machine("router-xyz");
    const Vec3 tilted = Vec3(0.3, 0.2, 1.0).normalized();
    try {
        (void)finish_program(router, path_of(tilted, on_table), {}, {}, Progress());
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(error.diagnostic().message.find("it has no rotary axes"), std::string::npos);
    }
    EXPECT_THROW((void)finish_program(router, path_of(Vec3::UnitZ(), {5000, 0, 0}), {}, {}, Progress()),
                 Error);
}

} // namespace
} // namespace millwright::mesh_finish
