// Programs that cut plots, read back by our own interpreter.
#include "core/plot/plot_program.h"

#include "core/base/error.h"
#include "core/gcode/interpreter.h"
#include "core/kinematics/machine_file.h"
#include "core/posts/writer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::plot {
namespace {

CutPath square_and_hole() {
    const Strokes strokes = {
        {.pen = 1, .points = {{10.0, 10.0}, {110.0, 10.0}, {110.0, 110.0}, {10.0, 110.0}, {10.0, 10.0}}},
        {.pen = 2, .points = {{60.0, 60.0}}}};
    CutSettings settings;
    settings.levels = levels_for(strokes, {.depth = 3.0, .passes = 2});
    settings.levels[1].tool = 2;
    return cut_path(strokes, settings);
}

class Collector final : public gcode::CanonSink {
public:
    void move(const gcode::Move& move, const gcode::SourceLine&) override { moves.push_back(move); }
    void curve(const gcode::Curve&, const gcode::SourceLine&) override {}
    void command(const gcode::Command&, const gcode::SourceLine&) override {}
    std::vector<gcode::Move> moves;
};

TEST(PlotProgram, IsReadBackMoveByMove) {
    const CutPath path = square_and_hole();
    const program::Listing listing = posts::write_gcode(plot_program(path), {});
    Collector collector;
    gcode::Interpreter interpreter(listing.text, "plot.ngc", {}, collector);
    interpreter.run();
    ASSERT_TRUE(interpreter.errors().empty()) << to_text(interpreter.errors().front());
    double cut = 0.0;
    Vec3 at = Vec3::Zero();
    for (const gcode::Move& move : collector.moves) {
        const Vec3 to(move.target[gcode::Axis::x], move.target[gcode::Axis::y], move.target[gcode::Axis::z]);
        if (to.z() < 0.0 && at.z() < 0.0) {
            cut += (to - at).norm();
        }
        if ((to - at).head<2>().norm() > 0.0 && at.z() >= 0.0 && to.z() >= 0.0) {
            EXPECT_GE(to.z(), 5.0);
        }
        at = to;
    }
    EXPECT_NEAR(cut, 2 * 400.0, 1e-6);
    EXPECT_NE(listing.text.find("change to tool 2"), std::string::npos);
    EXPECT_NE(listing.text.find("M2"), std::string::npos);
}

// From zero, where a program begins, to its end: the two figures that are reported to a person.
TEST(PlotProgram, GoesAsFarAsItsPathSays) {
    const CutPath path = square_and_hole();
    const PathLengths told = lengths(path);
    const program::Program program = plot_program(path);
    double way = 0.0;
    kinematics::AxisPositions at = program.start;
    for (const program::Block& block : program.blocks) {
        way += (block.target - at).norm();
        at = block.target;
    }
    EXPECT_NEAR(told.cut + told.travel, way, 1e-3);
}

TEST(PlotProgram, TellsTheFirstToolBeforeTheSpindleTurns) {
    const auto text_of = [](const CutPath& path) { return posts::write_gcode(plot_program(path), {}).text; };
    const std::string two = text_of(square_and_hole());
    const std::size_t told = two.find("put in tool 1");
    ASSERT_NE(told, std::string::npos) << two;
    EXPECT_LT(two.find("M0", told), two.find("M3"));
    const Strokes line = {{.pen = 4, .points = {{0.0, 0.0}, {10.0, 10.0}}}};
    const std::string one = text_of(cut_path(line, {.levels = {{.pen = 4, .tool = 7}}}));
    EXPECT_LT(one.find("tool 7"), one.find("M3")) << one;
    EXPECT_EQ(one.find("M0"), std::string::npos) << one; // no pause
}

TEST(PlotProgram, SaysWhichOriginKeepsItOnTheTable) {
    const kinematics::MachineModel table = kinematics::read_machine("assets/machines/forming-table.json");
    const auto path_over = [](double low, double high) {
        return CutPath{{.at = {low, 10.0, 5.0}}, {.at = {high, 20.0, -1.0}}};
    };
    const auto fault_of = [&](const CutPath& path, const Vec2& origin) {
        try {
            expect_on_table(path, table, origin);
        } catch (const Error& error) {
            return error.diagnostic().message + "; " + error.diagnostic().hint;
        }
        return std::string();
    };
    EXPECT_EQ(fault_of(path_over(0.0, 480.0), {0.0, 0.0}), "");
    EXPECT_EQ(fault_of(path_over(-1.5, 100.0), {0.0, 0.0}),
              "axis X would have to move to -1.500, outside 0.000 ... 480.000 mm; set the origin to 1.500, "
              "0.000: Origin X and Y in the window, --origin 1.500,0.000");
    EXPECT_EQ(fault_of(path_over(100.0, 500.0), {50.0, 5.0}),
              "axis X would have to move to 500.000, outside 0.000 ... 480.000 mm; set the origin to 30.000, "
              "5.000: Origin X and Y in the window, --origin 30.000,5.000");
    EXPECT_NE(fault_of(path_over(-100.0, 500.0), {0.0, 0.0}).find("use a larger machine"), std::string::npos);
    EXPECT_EQ(fault_of({}, {0.0, 0.0}), "");
}

TEST(PlotProgram, MovesUpBeforeAcross) {
    const program::Program program = plot_program(square_and_hole());
    for (const program::Block& block : program.blocks) {
        if (block.moves()) {
            EXPECT_TRUE(block.named == program::AxisSet::only(2));
            EXPECT_DOUBLE_EQ(block.target[2], 5.0);
            return;
        }
    }
    FAIL() << "no move";
}

// The spindle's position is unknown: a stroke that begins at 0 0 is approached like any other.
TEST(PlotProgram, TellsEachAxisBeforeItPlungesAlsoAtZero) {
    const Strokes strokes = {{.pen = 1, .points = {{0.0, 0.0}, {10.0, 10.0}}}};
    CutSettings settings;
    settings.levels = levels_for(strokes, {.depth = 1.0, .passes = 1});
    const std::string text = posts::write_gcode(plot_program(cut_path(strokes, settings)), {}).text;
    const std::size_t up = text.find("G0 Z5"), across = text.find("X0.0000 Y0.0000"), down = text.find("Z-1");
    ASSERT_NE(across, std::string::npos) << text;
    EXPECT_LT(up, across);
    EXPECT_LT(across, down) << text;
    EXPECT_EQ(text.find('Z', across), down) << text; // across alone
}

TEST(PlotProgram, OfNothingMovesNothing) {
    for (const program::Block& block : plot_program({}).blocks) {
        EXPECT_FALSE(block.moves());
    }
}

TEST(PlotProgram, OfMorePointsThanMemoryIsKeptForIsRefused) {
    const CutPath path(most_program_points + 1);
    try {
        static_cast<void>(plot_program(path));
        FAIL() << "nothing was refused";
    } catch (const Error& error) {
        EXPECT_NE(error.diagnostic().message.find("more than 4 million would need too much memory"),
                  std::string::npos);
    }
}

TEST(SpeedsNotReached, TellTheFirstAndHowManyThereAre) {
    const auto machine = kinematics::read_machine("assets/machines/forming-table.json"); // 10 mm/s in X and Y
    CutPath path = square_and_hole();
    EXPECT_FALSE(speeds_not_reached(path, machine));
    for (CutPoint& point : path) {
        point.speed *= point.move == CutMove::cut ? 2.4 : 1.0;
    }
    const auto found = speeds_not_reached(path, machine);
    ASSERT_TRUE(found);
    EXPECT_EQ(
        found->message,
        "1440 mm/min exceeds the maximum speed of forming table: its axis X is limited to 600 mm/min; the "
        "same applies to 7 moves more");
    // Along the diagonal each axis takes its part of 14 mm/s.
    EXPECT_FALSE(speeds_not_reached({{.at = {0, 0, 0}}, {.at = {5, 5, 0}, .speed = 14.0}}, machine));
    EXPECT_TRUE(speeds_not_reached({{.at = {0, 0, 0}}, {.at = {5, 5, 0}, .speed = 14.2}}, machine));
}

} // namespace
} // namespace millwright::plot
