#include "core/simulation/comparison.h"

#include "core/base/units.h"
#include "core/geometry/bezier_patch.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/machine_file.h"
#include "core/toolpath/cutter.h"
#include "core/toolpath/swept_cut.h"
#include "tests/core/simulation/written_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace millwright::simulation {
namespace {

using program::BlockKind;

const kinematics::MachineModel& compared_router() {
    static const kinematics::MachineModel machine =
        kinematics::read_machine("assets/machines/router-xyz.json");
    return machine;
}

toolpath::Profile compared_ball(double diameter) {
    return *toolpath::body_of({.kind = toolpath::CutterKind::ball, .diameter = diameter, .length = 40.0});
}

/// Rows of a ball end along X, one every `pitch` mm of Y, at Z -2.
WrittenProgram rows(double pitch) {
    WrittenProgram writer(compared_router());
    writer.add(BlockKind::spindle_on).go(BlockKind::rapid, {{'X', -10.0}, {'Y', 0.0}, {'Z', 5.0}});
    for (double y = 2.0; y <= 18.0; y += pitch) {
        writer.go(BlockKind::rapid, {{'X', -10.0}, {'Y', y}, {'Z', 5.0}})
            .go(BlockKind::feed, {{'Z', -2.0}})
            .go(BlockKind::feed, {{'X', 40.0}})
            .go(BlockKind::rapid, {{'Z', 5.0}});
    }
    return writer;
}

// Over a plane at Z -2 the rows of a ball leave R - sqrt(R^2 - (pitch / 2)^2) between them and nothing in
// their middle; over a plane 0.3 mm higher that is 0.3 mm less.
TEST(Comparison, FindsScallopsAndGougesOfRowsInClosedForm) {
    constexpr double pitch = 2.0, radius = 3.0;
    const WrittenProgram writer = rows(pitch);
    const SimulationInput input{.program = writer.program(),
                                .machine = compared_router(),
                                .tools = {{0, 1, compared_ball(2.0 * radius)}},
                                .stock = BoxStock{{0.0, 0.0, -10.0}, {30.0, 20.0, 0.0}},
                                .resolution = 0.5};
    const Simulation found = simulate(input, Progress());
    for (const double plane : {-2.0, -1.7}) {
        std::vector<PartPoint> points;
        std::vector<double> expected;
        for (double y = 4.0; y <= 14.0; y += 0.37) {
            const double off = std::abs(std::remainder(y - 2.0, pitch));
            points.push_back({Vec3(15.1, y, plane), Vec3::UnitZ(), 1.0});
            expected.push_back(-2.0 + radius - std::sqrt(radius * radius - off * off) - plane);
        }
        const std::vector<Deviation> deviation = deviations(input, found, points, Progress());
        for (std::size_t n = 0; n < points.size(); ++n) {
            EXPECT_NEAR(deviation[n].height, expected[n], 1e-5) << n;
            EXPECT_EQ(input.program.blocks[static_cast<std::size_t>(deviation[n].block)].kind,
                      BlockKind::feed);
        }
        const ComparisonSummary summary = summary_of(points, deviation, 0.05);
        EXPECT_NEAR(summary.area, static_cast<double>(points.size()), 1e-9);
        EXPECT_NEAR(summary.within + summary.gouged + summary.in_excess, 1.0, 1e-12);
        const double deepest = *std::ranges::min_element(expected);
        if (plane > -2.0) {
            ASSERT_TRUE(summary.gouge.has_value());
            EXPECT_NEAR(summary.gouge->height, deepest, 1e-5);
            EXPECT_GT(summary.gouged, 0.9);
        }
    }
}

TEST(Comparison, WhereNothingWasCutTheStockIsTheExcess) {
    const WrittenProgram writer = rows(2.0);
    const SimulationInput input{.program = writer.program(),
                                .machine = compared_router(),
                                .tools = {{0, 1, compared_ball(6.0)}},
                                .stock = BoxStock{{0.0, -30.0, -10.0}, {30.0, 20.0, 0.0}},
                                .resolution = 0.5};
    const Simulation found = simulate(input, Progress());
    const std::vector<PartPoint> points{{Vec3(15.0, -25.0, -2.0), Vec3::UnitZ(), 1.0},
                                        {Vec3(15.0, -25.0, 1.5), Vec3::UnitZ(), 1.0}};
    const std::vector<Deviation> deviation = deviations(input, found, points, Progress());
    EXPECT_NEAR(deviation[0].height, 2.0, 1e-12);
    EXPECT_EQ(deviation[0].block, -1);
    EXPECT_NEAR(deviation[1].height, -1.5, 1e-12); // the part sticks out of the stock
}

// The sweep over a patch looks at every move at every point; here the field says which moves to look at.
TEST(Comparison, AgreesWithTheSweepOverThePatch) {
    const kinematics::MachineModel machine = kinematics::read_machine("assets/machines/ac-table.json");
    const toolpath::Profile ball = compared_ball(6.0);
    WrittenProgram writer(machine);
    writer.add(BlockKind::spindle_on);
    std::vector<toolpath::SweptMove> moves;
    bool first = true;
    for (int row = 0; row <= 12; ++row) {
        for (int n = 0; n <= 6; ++n) {
            const int along = row % 2 == 0 ? n : 6 - n;
            const double x = -12.0 + 4.0 * along, y = -9.0 + 1.5 * row;
            const auto go = [&](BlockKind kind) {
                writer.go(kind,
                          {{'X', x},
                           {'Y', y},
                           {'Z', 0.01 * x * x},
                           {'A', 0.06 * std::sin(0.4 * along)},
                           {'C', 0.05 * std::cos(0.9 * row)}});
            };
            go(first ? BlockKind::rapid : BlockKind::feed);
            first = false;
        }
    }
    const auto& program = writer.program();
    Box3 box;
    for (int n = 2; n < program.block_count(); ++n) {
        const auto& target = program.blocks[static_cast<std::size_t>(n)].target;
        box.extend(kinematics::forward(machine, target).tip);
        moves.push_back({program::position_before(program, n), target, true});
    }
    const double level = 0.5 * (box.min().z() + box.max().z());
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            net.point(i, j) = {i == 0 ? box.min().x() + 2.0 : box.max().x() - 2.0,
                               j == 0 ? box.min().y() + 2.0 : box.max().y() - 2.0,
                               level};
        }
    }
    const geometry::BezierPatch patch(net);
    toolpath::Tool tool;
    tool.cutter = ball;
    const toolpath::SweptCut cut =
        toolpath::swept_cut(patch,
                            false,
                            machine,
                            tool,
                            moves,
                            {.nu = 25, .nv = 25, .step = 0.05, .between_looks = true},
                            Progress());
    const SimulationInput input{
        .program = program,
        .machine = machine,
        .tools = {{0, 1, ball}},
        .stock = BoxStock{box.min() - Vec3::Constant(6.0), box.max() + Vec3::Constant(4.0)},
        .resolution = 0.4};
    const Simulation found = simulate(input, Progress());
    std::vector<PartPoint> points;
    std::vector<double> expected;
    for (int i = 0; i < cut.nu; ++i) {
        for (int j = 0; j < cut.nv; ++j) {
            if (std::abs(cut.height(i, j)) < 1.0) {
                points.push_back({patch.position(i / 24.0, j / 24.0), Vec3::UnitZ(), 1.0});
                expected.push_back(cut.height(i, j));
            }
        }
    }
    ASSERT_GT(points.size(), 200U);
    const std::vector<Deviation> deviation = deviations(input, found, points, Progress());
    for (std::size_t n = 0; n < points.size(); ++n) {
        EXPECT_NEAR(deviation[n].height, expected[n], 2e-3) << n;
    }
}

} // namespace
} // namespace millwright::simulation
