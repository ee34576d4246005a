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
#include <memory>
#include <random>

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

/// Moves of a flat end mill back and forth along X from `from` to `to`, at each Y of the range.
void clear(WrittenProgram& writer, const Vec3& from, const Vec3& to, double pitch) {
    writer.go(BlockKind::rapid, {{'X', from.x()}, {'Y', from.y()}, {'Z', 5.0}})
        .go(BlockKind::feed, {{'Z', from.z()}});
    bool forth = true;
    for (double y = from.y(); y <= to.y(); y += pitch) {
        writer.go(BlockKind::feed, {{'Y', y}}).go(BlockKind::feed, {{'X', forth ? to.x() : from.x()}});
        forth = !forth;
    }
}

toolpath::Profile compared_flat(double diameter) {
    return *toolpath::body_of({.kind = toolpath::CutterKind::flat, .diameter = diameter, .length = 50.0});
}

TEST(Comparison, WhereAllMaterialIsGoneThePartIsGouged) {
    WrittenProgram writer(compared_router());
    writer.add(BlockKind::spindle_on);
    clear(writer, {-10.0, -10.0, -12.0}, {70.0, 50.0, -12.0}, 2.5);
    const SimulationInput input{.program = writer.program(),
                                .machine = compared_router(),
                                .tools = {{0, 1, compared_flat(6.0)}},
                                .stock = BoxStock{{0.0, 0.0, -10.0}, {60.0, 40.0, 0.0}},
                                .resolution = 1.0};
    const Simulation found = simulate(input, Progress());
    ASSERT_NEAR(found.left_volume, 0.0, 1e-9);
    const std::vector<PartPoint> points{{Vec3(30.0, 20.0, -2.0), Vec3::UnitZ(), 1.0},
                                        {Vec3(30.0, 20.0, -10.0), -Vec3::UnitZ(), 1.0},
                                        {Vec3(0.0, 20.0, -6.0), -Vec3::UnitX(), 1.0},
                                        {Vec3(60.0, 40.0, -6.0), Vec3::UnitY(), 1.0},
                                        {Vec3(30.0, 20.0, 0.05), Vec3::UnitZ(), 1.0}};
    const std::vector<Deviation> deviation = deviations(input, found, points, Progress());
    for (std::size_t n = 0; n < points.size(); ++n) {
        EXPECT_TRUE(deviation[n].at_least) << n;
    }
    EXPECT_NEAR(deviation[0].height, -8.0, 1e-9);
    EXPECT_NEAR(deviation[1].height, -10.0, 1e-9);
    EXPECT_NEAR(deviation[2].height, -60.0, 1e-9);
    EXPECT_NEAR(deviation[3].height, -40.0, 1e-9);
    const ComparisonSummary summary = summary_of(points, deviation, 100.0);
    EXPECT_DOUBLE_EQ(summary.gouged, 1.0); // whatever the tolerance
}

// The last pass along the walls makes all ends of the lines that pass through the middle.
TEST(Comparison, InTheMiddleOfAPocketThatWasFinishedAlongItsWallsThePartIsGouged) {
    WrittenProgram writer(compared_router());
    writer.add(BlockKind::spindle_on);
    clear(writer, {11.0, 11.0, -12.0}, {49.0, 31.0, -12.0}, 1.5);
    writer.go(BlockKind::feed, {{'X', 10.0}, {'Y', 32.0}})
        .go(BlockKind::feed, {{'Y', 10.0}})
        .go(BlockKind::feed, {{'X', 50.0}})
        .go(BlockKind::feed, {{'Y', 32.0}})
        .go(BlockKind::feed, {{'X', 10.0}});
    const SimulationInput input{.program = writer.program(),
                                .machine = compared_router(),
                                .tools = {{0, 1, compared_flat(6.0)}},
                                .stock = BoxStock{{0.0, 0.0, -10.0}, {60.0, 42.0, 0.0}},
                                .resolution = 1.0};
    const Simulation found = simulate(input, Progress());
    const std::vector<PartPoint> points{{Vec3(30.0, 21.0, -2.0), Vec3::UnitZ(), 1.0},
                                        {Vec3(20.0, 21.0, -5.0), -Vec3::UnitX(), 1.0},
                                        {Vec3(0.0, 21.0, -5.0), -Vec3::UnitX(), 1.0},
                                        {Vec3(30.0, 3.0, 0.0), Vec3::UnitZ(), 1.0}};
    const std::vector<Deviation> deviation = deviations(input, found, points, Progress());
    EXPECT_NEAR(deviation[0].height, -8.0, 1e-9);
    EXPECT_LT(deviation[1].height, -12.0); // to the nearest wall, 13 mm
    EXPECT_GT(deviation[1].height, -34.0);
    EXPECT_NEAR(deviation[2].height, 0.0, 1e-9); // untouched faces of the stock
    EXPECT_NEAR(deviation[3].height, 0.0, 1e-9);
}

TEST(Comparison, WithoutAnyCutTheStockItselfCounts) {
    WrittenProgram writer(compared_router());
    writer.add(BlockKind::spindle_on).go(BlockKind::rapid, {{'X', 0.0}, {'Y', 0.0}, {'Z', 50.0}});
    const auto compare = [&](const Stock& stock, const std::vector<PartPoint>& points) {
        const SimulationInput input{.program = writer.program(),
                                    .machine = compared_router(),
                                    .tools = {{0, 1, compared_flat(6.0)}},
                                    .stock = stock,
                                    .resolution = 0.5};
        return deviations(input, simulate(input, Progress()), points, Progress());
    };
    const Vec3 diagonal = Vec3(1.0, 1.0, 0.0).normalized();
    const std::vector<PartPoint> points{{9.5 * Vec3(1.0, 1.0, 0.0) - 5.0 * Vec3::UnitZ(), diagonal, 1.0},
                                        {6.0 * diagonal - 5.0 * Vec3::UnitZ(), diagonal, 1.0},
                                        {1.0 * diagonal - 5.0 * Vec3::UnitZ(), diagonal, 1.0},
                                        {6.0 * diagonal - 4.0 * Vec3::UnitZ(), Vec3::UnitZ(), 1.0},
                                        {6.0 * diagonal - 4.0 * Vec3::UnitZ(), -diagonal, 1.0}};
    const std::vector<Deviation> tube =
        compare(CylinderStock{Vec3(0.0, 0.0, -10.0), 2, 20.0, 8.0, 10.0}, points);
    EXPECT_NEAR(tube[0].height, -(9.5 * std::sqrt(2.0) - 10.0), 1e-9);
    EXPECT_NEAR(tube[1].height, 4.0, 1e-9);
    EXPECT_NEAR(tube[2].height, -3.0, 1e-9); // in the bore
    EXPECT_NEAR(tube[3].height, 4.0, 1e-9);
    EXPECT_NEAR(tube[4].height, 2.0, 1e-9);
    // A mesh in place of it: a pyramid with its top at Z 0; to a cell.
    auto mesh = std::make_shared<MeshStock>();
    mesh->points = {{-10, -10, -10}, {10, -10, -10}, {10, 10, -10}, {-10, 10, -10}, {0, 0, 0}};
    mesh->triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    const std::vector<Deviation> pyramid = compare(std::shared_ptr<const MeshStock>(mesh),
                                                   {{Vec3(6.0, 6.0, -1.0), Vec3::UnitZ(), 1.0},
                                                    {Vec3(5.0, 0.0, -7.0), Vec3::UnitZ(), 1.0},
                                                    {Vec3(5.0, 0.0, -5.2), Vec3::UnitZ(), 1.0}});
    EXPECT_NEAR(pyramid[0].height, -5.0, 0.5);
    EXPECT_NEAR(pyramid[1].height, 2.0, 0.5);
    EXPECT_NEAR(pyramid[2].height, 0.2, 0.5);
}

TEST(Comparison, LooksAtAllOfLongMovesAndOfSeveralTurns) {
    WrittenProgram along(compared_router());
    along.add(BlockKind::spindle_on)
        .go(BlockKind::rapid, {{'X', -1.0}, {'Y', 0.5}, {'Z', 5.0}})
        .go(BlockKind::feed, {{'Z', -0.08}})
        .go(BlockKind::feed, {{'X', 2501.0}});
    const SimulationInput straight{.program = along.program(),
                                   .machine = compared_router(),
                                   .tools = {{0, 1, compared_flat(0.1)}},
                                   .stock = BoxStock{{1200.0, 0.0, -1.0}, {1202.0, 1.0, 0.0}},
                                   .resolution = 0.02};
    const Simulation cut = simulate(straight, Progress());
    std::vector<PartPoint> points;
    for (double x = 1200.1; x < 1201.9; x += 0.0173) {
        points.push_back({Vec3(x, 0.5, 0.0), Vec3::UnitZ(), 1.0});
    }
    for (const Deviation& deviation : deviations(straight, cut, points, Progress())) {
        EXPECT_NEAR(deviation.height, -0.08, 1e-6);
    }

    const kinematics::MachineModel machine = kinematics::read_machine("assets/machines/ac-table.json");
    WrittenProgram around(machine);
    around.add(BlockKind::spindle_on)
        .go(BlockKind::rapid, {{'X', 20.0}, {'Y', 0.0}, {'Z', 10.0}, {'A', 0.0}, {'C', 0.0}})
        .go(BlockKind::feed, {{'Z', 0.0}});
    const geometry::ToolPose start =
        kinematics::forward(machine, around.program().blocks.back().target); // on the part's coordinates
    around.go(BlockKind::feed, {{'C', 16.0 * pi}});
    const geometry::ToolPose quarter = [&] {
        kinematics::AxisPositions turned = around.program().blocks.back().target;
        turned[machine.axis_index('C')] = 0.5 * pi;
        return kinematics::forward(machine, turned);
    }();
    // The middle of the circle: equally far from two places a right angle apart, on the side of the axis.
    const kinematics::AxisPositions half = [&] {
        kinematics::AxisPositions turned = around.program().blocks.back().target;
        turned[machine.axis_index('C')] = pi;
        return turned;
    }();
    const Vec3 middle = 0.5 * (start.tip + kinematics::forward(machine, half).tip);
    ASSERT_NEAR((quarter.tip - middle).norm(), (start.tip - middle).norm(), 1e-6);
    const double radius = (start.tip - middle).norm();
    const SimulationInput turning{.program = around.program(),
                                  .machine = machine,
                                  .tools = {{0, 1, compared_flat(4.0)}},
                                  .stock = BoxStock{middle - Vec3(radius + 5.0, radius + 5.0, 5.0),
                                                    middle + Vec3(radius + 5.0, radius + 5.0, 1.0)},
                                  .resolution = 1.0};
    const Simulation ring = simulate(turning, Progress());
    points.clear();
    for (double angle = 0.1; angle < 6.2; angle += 0.37) {
        points.push_back({middle + radius * Vec3(std::cos(angle), std::sin(angle), 0.0) + 0.5 * Vec3::UnitZ(),
                          Vec3::UnitZ(),
                          1.0});
    }
    for (const Deviation& deviation : deviations(turning, ring, points, Progress())) {
        EXPECT_NEAR(deviation.height, -0.5, 1e-6);
    }
}

// Whether a point is still material is known in closed form here: the moves are level and the cutter is flat.
TEST(Comparison, FindsEveryPointThatAnyMoveHasTaken) {
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 32>(random);
    };
    constexpr double radius = 3.0;
    int taken = 0, left = 0;
    for (int round = 0; round < 12; ++round) {
        WrittenProgram writer(compared_router());
        writer.add(BlockKind::spindle_on).go(BlockKind::rapid, {{'X', 0.0}, {'Y', 0.0}, {'Z', 5.0}});
        struct Cut {
            Vec2 from, to;
            double z;
        };
        std::vector<Cut> cuts;
        for (int n = 0; n < 8 + 4 * round; ++n) {
            const Vec2 from(between(-5.0, 45.0), between(-5.0, 45.0));
            const Vec2 to(between(-5.0, 45.0), between(-5.0, 45.0));
            const double z = n % 3 == 0 ? -12.0 : between(-9.0, -1.0);
            writer.go(BlockKind::rapid, {{'X', from.x()}, {'Y', from.y()}, {'Z', 5.0}})
                .go(BlockKind::feed, {{'Z', z}})
                .go(BlockKind::feed, {{'X', to.x()}, {'Y', to.y()}})
                .go(BlockKind::rapid, {{'Z', 5.0}});
            cuts.push_back({from, to, z});
        }
        const SimulationInput input{.program = writer.program(),
                                    .machine = compared_router(),
                                    .tools = {{0, 1, compared_flat(2.0 * radius)}},
                                    .stock = BoxStock{{0.0, 0.0, -10.0}, {40.0, 40.0, 0.0}},
                                    .resolution = 1.0};
        const Simulation found = simulate(input, Progress());
        std::vector<PartPoint> points;
        std::vector<double> depths; // in the deepest tool; below 0: outside of all
        for (int n = 0; n < 400; ++n) {
            const Vec3 at(between(0.2, 39.8), between(0.2, 39.8), between(-9.8, -0.2));
            Vec3 normal = Vec3::Unit(n % 3);
            if (n % 2 == 0) {
                normal = Vec3(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)).normalized();
            }
            double depth = -1e9;
            for (const Cut& cut : cuts) {
                const Vec2 way = cut.to - cut.from;
                const Vec2 away = at.head<2>() - cut.from;
                const double f = std::clamp(away.dot(way) / way.squaredNorm(), 0.0, 1.0);
                depth = std::max(depth, std::min(radius - (away - f * way).norm(), at.z() - cut.z));
            }
            points.push_back({at, normal, 1.0});
            depths.push_back(depth);
        }
        const std::vector<Deviation> deviation = deviations(input, found, points, Progress());
        constexpr double margin = 0.02;
        for (std::size_t n = 0; n < points.size(); ++n) {
            if (depths[n] > margin) {
                ++taken;
                EXPECT_LT(deviation[n].height, -0.999 * depths[n]) << points[n].point.transpose();
            } else if (depths[n] < -margin) {
                ++left;
                EXPECT_GT(deviation[n].height, 0.0) << points[n].point.transpose();
            }
        }
    }
    EXPECT_GT(taken, 1000);
    EXPECT_GT(left, 400);
}

} // namespace
} // namespace millwright::simulation
