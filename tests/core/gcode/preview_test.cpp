// The preview against the interpreter's own canonical moves, and against what is kept naively.
#include "core/gcode/preview.h"

#include "core/base/units.h"
#include "core/gcode/interpreter.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/machine_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace millwright::gcode {
namespace {

struct Read {
    PreviewPath path;
    Execution execution;
    std::vector<std::int32_t> lines; ///< of each step
    std::vector<ModalState> states;  ///< after each step
    double seconds = 0.0, length = 0.0;
};

Read read_preview(const std::string& text,
                  std::shared_ptr<const kinematics::MachineModel> machine = nullptr) {
    Read result;
    ReaderSettings settings;
    settings.any_tool = true;
    PreviewBuilder builder({.machine = std::move(machine)}, [&](std::shared_ptr<const PathChunk> chunk) {
        result.path.chunks.push_back(std::move(chunk));
    });
    Interpreter program(text, "test.ngc", settings, builder);
    bool more = true;
    while (more) {
        builder.begin_step(result.execution.count());
        more = program.step();
        result.lines.push_back(program.place().line);
        result.states.push_back(program.state());
        result.execution.add(program.place().line, program.state());
    }
    builder.finish();
    result.execution.shrink();
    result.seconds = builder.seconds();
    result.length = builder.length();
    EXPECT_TRUE(program.errors().empty()) << to_text(program.errors().front());
    return result;
}

/// Moves in three axes, seeded.
std::string random_moves(int count) {
    std::mt19937 random(274);
    std::uniform_real_distribution<double> place(-100.0, 100.0);
    std::string text = "G21 G90 F1000\n";
    for (int n = 0; n < count; ++n) {
        const double x = place(random), y = place(random), z = place(random);
        fmt::format_to(std::back_inserter(text),
                       "G{} X{:.3f} Y{:.3f} Z{:.3f}{}\n",
                       n % 5 == 0 ? 0 : 1,
                       x,
                       y,
                       z,
                       n % 3 == 0 ? fmt::format(" F{}", 100 + n % 700) : "");
    }
    return text + "M2\n";
}

TEST(Preview, KeepsEachMoveWithItsPlaceKindAndLine) {
    constexpr int moves = 70'000; // more than a chunk
    const Read got = read_preview(random_moves(moves));
    ASSERT_EQ(got.path.point_count(), moves + 1);
    ASSERT_EQ(got.path.chunks.size(), 2U);
    std::mt19937 random(274);
    std::uniform_real_distribution<double> place(-100.0, 100.0);
    for (int n = 0; n < moves; ++n) {
        const double x = place(random), y = place(random), z = place(random);
        const PreviewPoint& point = got.path.point(n + 1);
        ASSERT_LT((point.position() - Vec3(x, y, z)).norm(), 1e-3);
        ASSERT_EQ(point.kind(), n % 5 == 0 ? PathKind::rapid : PathKind::feed);
        ASSERT_EQ(got.execution.line_of(point.step()), n + 2);
    }
}

TEST(Preview, TakesAtMost32BytesAMoveWithItsCopyForTheGraphics) {
    constexpr int moves = 200'000;
    const Read got = read_preview(random_moves(moves));
    constexpr std::size_t on_graphics = 8; // ui/render/path_drawer.h
    const std::size_t bytes = got.path.bytes() + got.execution.bytes() + on_graphics * moves;
    EXPECT_LE(static_cast<double>(bytes) / moves, 32.0);
}

TEST(Preview, SaysWhatIsInForceAfterAnyStep) {
    const Read got =
        read_preview("G21 F100\nG1 X1\nM3 S500\nG20 G91\no100 repeat [3]\nF[#<_feed> + 1]\nX1\nG0 Z1\n"
                     "o100 endrepeat\nG10 L2 P2 X1 Y2\nG55 G92 X3\nG54 T4 M6\nM8\nG43.1 Z2\nG18\nM5\nM2\n");
    ASSERT_EQ(got.execution.count(), got.lines.size());
    for (Step step = 0; step < got.execution.count(); ++step) {
        const ModalState& is = got.states[step];
        const ModalView seen = got.execution.state_after(step);
        const double unit = is.unit == LengthUnit::inch ? mm_per_inch : 1.0;
        EXPECT_EQ(got.execution.line_of(step), got.lines[step]);
        EXPECT_EQ(seen.motion, is.motion) << step;
        EXPECT_EQ(seen.unit, is.unit);
        EXPECT_EQ(seen.incremental, is.distance == DistanceMode::incremental);
        EXPECT_EQ(seen.plane, is.plane);
        EXPECT_EQ(seen.coordinate_system, is.coordinate_system);
        EXPECT_EQ(seen.spindle, is.spindle);
        EXPECT_EQ(seen.flood, is.flood);
        EXPECT_EQ(seen.tool, is.spindle_tool.number);
        EXPECT_NEAR(seen.feed, is.feed_rate, 1e-4);
        EXPECT_NEAR(seen.spindle_speed, is.spindle_speed, 1e-4);
        EXPECT_NEAR(seen.g5x_offset[Axis::x], is.g5x_offset[Axis::x] * unit, 1e-9);
        EXPECT_NEAR(seen.g92_offset[Axis::x], is.g92_offset[Axis::x] * unit, 1e-9);
        EXPECT_NEAR(seen.tool_offset[Axis::z], is.tool_offset[Axis::z] * unit, 1e-9);
    }
}

TEST(Preview, FindsTheFirstExecutionOfALine) {
    const Read got = read_preview("F100\no100 repeat [5]\nG1 X1\nX0\no100 endrepeat\n(behind)\nM2\n");
    for (std::int32_t line = 1; line <= 7; ++line) {
        const auto first = std::ranges::find(got.lines, line);
        const auto step = got.execution.step_of(line, line);
        ASSERT_EQ(step.has_value(), first != got.lines.end()) << line;
        if (step) {
            EXPECT_EQ(*step, static_cast<Step>(first - got.lines.begin()));
            EXPECT_EQ(got.execution.step_at_or_after(line), *step);
        }
    }
}

TEST(Preview, FollowsArcsWithinTheTolerance) {
    const Read got = read_preview("G21 G90 F100\nG0 X10 Y0\nG3 X10 Y0 I-10 J0 Z5\nM2\n");
    const auto [first, end] = got.path.points_of(2);
    ASSERT_GT(end - first, 40);
    double length = 0.0;
    for (auto n = first; n < end; ++n) {
        EXPECT_NEAR(got.path.point(n).position().head<2>().norm(), 10.0, 1e-4);
        length += (got.path.point(n).position() - got.path.point(n - 1).position()).norm();
    }
    EXPECT_NEAR(length, std::hypot(2.0 * pi * 10.0, 5.0), 0.1);
}

TEST(Preview, DrawsTheTipOnAFiveAxisMachine) {
    const auto machine = std::make_shared<const kinematics::MachineModel>(
        kinematics::read_machine("assets/machines/ac-table.json"));
    const Read got = read_preview("G21 G90 F100\nG1 X10 Y5 Z-3 A20 C-40\nM2\n", machine);
    kinematics::AxisPositions axes = kinematics::AxisPositions::Zero(machine->axis_count());
    const auto set = [&](char letter, double value) { axes[machine->axis_index(letter)] = value; };
    set('X', 10.0);
    set('Y', 5.0);
    set('Z', -3.0);
    set('A', from_degrees(20.0));
    set('C', from_degrees(-40.0));
    const Vec3 end = got.path.point(got.path.point_count() - 1).position();
    EXPECT_LT((end - kinematics::forward(*machine, axes).tip).norm(), 1e-4);
    EXPECT_GE(got.path.point_count(), 14); // 40 degrees in pieces of 3
}

TEST(Preview, TakesToolLengthOffsetsOutOfTheTip) {
    const Read got = read_preview("G21 G90 F100\nG43.1 Z50\nG1 X1 Z2\nM2\n");
    EXPECT_LT((got.path.point(got.path.point_count() - 1).position() - Vec3(1.0, 0.0, 2.0)).norm(), 1e-5);
}

TEST(Preview, CoarseLevelsAreOffByNoMoreThanTheySay) {
    const Read got = read_preview(random_moves(3000));
    const auto distance = [](const Vec3& p, const Vec3& a, const Vec3& b) {
        const double length = (b - a).squaredNorm();
        const double t = length > 0.0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
        return (p - a - t * (b - a)).norm();
    };
    for (const auto& chunk : got.path.chunks) {
        for (const PathBlock& block : chunk->blocks) {
            for (const PathBlock::Level& level : block.levels) {
                double worst = 0.0;
                for (std::uint32_t k = 1; k < level.count; ++k) {
                    const auto from = chunk->indices[level.first + k - 1];
                    const auto to = chunk->indices[level.first + k];
                    for (auto n = from; n <= to; ++n) {
                        worst = std::max(worst,
                                         distance(chunk->points[n].position(),
                                                  chunk->points[from].position(),
                                                  chunk->points[to].position()));
                    }
                }
                EXPECT_NEAR(worst, level.error, 1e-3);
                EXPECT_EQ(chunk->indices[level.first], block.first);
                EXPECT_EQ(chunk->indices[level.first + level.count - 1], block.first + block.count - 1);
            }
        }
    }
}

TEST(Preview, TimeAndPlaceUndoEachOther) {
    const Read got = read_preview(random_moves(70'000));
    double sum = 0.0;
    for (const auto& chunk : got.path.chunks) {
        EXPECT_NEAR(chunk->start_time, sum, 1e-6 * got.seconds);
        sum = chunk->end_time;
    }
    EXPECT_NEAR(sum, got.seconds, 1e-6 * got.seconds);
    double before = 0.0;
    for (int n = 0; n <= 500; ++n) {
        const double time = got.seconds * n / 500.0;
        const PathPlace place = got.path.place_at(time);
        EXPECT_NEAR(got.path.time_of(place), time, 1e-6 * got.seconds);
        const double along = static_cast<double>(place.point) + place.fraction;
        EXPECT_GE(along, before);
        before = along;
    }
    EXPECT_EQ(got.path.place_at(got.seconds).point, got.path.point_count() - 1);
}

} // namespace
} // namespace millwright::gcode
