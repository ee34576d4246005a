// The planner, given the settings of a Grbl, against the time that the emulated Grbl takes: two programs that
// share nothing but the settings.
#include "core/base/units.h"
#include "core/emulators/grbl/grbl_emulator.h"
#include "core/hpgl/reader.h"
#include "core/motion/planner.h"
#include "core/plot/plot_program.h"
#include "core/plot/stroke_plan.h"
#include "tests/support/programs.h"
#include "tests/support/samples.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace millwright::emulators {
namespace {

constexpr double nobody_waits_longer = 36000.0; // s
constexpr int look_ahead_of_grbl = 15;

/// Streams a program and returns the time that it takes; negative if Grbl refuses a line.
double measured_time(const std::string& text) {
    GrblEmulator grbl({.keep_truth = false});
    (void)grbl.take_output();
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        grbl.receive(line + "\n");
        for (std::string answer; answer.find("ok") == std::string::npos;) {
            answer += grbl.take_output();
            if (answer.find("error") != std::string::npos || grbl.time() > nobody_waits_longer) {
                return -1.0;
            }
            if (answer.find("ok") == std::string::npos) {
                grbl.advance(0.001);
            }
        }
    }
    while (grbl.moving()) {
        grbl.advance(0.001);
    }
    return grbl.time();
}

kinematics::MachineModel emulated_machine() {
    kinematics::MachineDescription machine = test::machine("router-xyz").description();
    for (kinematics::MachineAxis& axis : machine.head) {
        axis.min = -1e4;
        axis.max = 1e4;
        axis.max_velocity = 50.0; // the emulator's defaults
        axis.max_acceleration = 200.0;
    }
    return kinematics::MachineModel(std::move(machine));
}

motion::PlannerSettings as_grbl(int look_ahead) {
    motion::PlannerSettings settings;
    settings.corner_rule = motion::CornerRule::junction_deviation;
    settings.junction_deviation = 0.01;
    settings.look_ahead = look_ahead;
    return settings;
}

/// The moves and dwells of a program in Grbl's words.
std::string grbl_text(const program::Program& program) {
    std::string text = "G21G90G94\n";
    for (const program::Block& block : program.blocks) {
        const auto& q = block.target;
        const int before = static_cast<int>(&block - program.blocks.data());
        const double way = (q - program::position_before(program, before)).norm();
        const std::string place = fmt::format("X{:.4f}Y{:.4f}Z{:.4f}", q[0], q[1], q[2]);
        if (block.kind == program::BlockKind::dwell) {
            text += fmt::format("G4P{:.3f}\n", block.duration);
        } else if (block.kind == program::BlockKind::rapid) {
            text += "G0" + place + "\n";
        } else if (block.kind == program::BlockKind::feed && way > 0.0) {
            text += fmt::format("G1{}F{:.3f}\n", place, 60.0 * way / block.duration);
        }
    }
    return text;
}

/// A flower of 4000 chords of about 0.5 mm, at 3000 mm/min.
program::Program dense_program() {
    const kinematics::MachineModel machine = emulated_machine();
    program::Program program = test::empty_program(machine);
    for (int n = 1; n <= 4000; ++n) {
        const double angle = n * 2.0 * pi / 800.0;
        const double radius = 60.0 + 12.0 * std::sin(7.0 * angle);
        kinematics::AxisPositions q = kinematics::AxisPositions::Zero(3);
        q << radius * std::cos(angle), radius * std::sin(angle), -0.001 * n;
        const double way = (q - program::position_before(program, program.block_count())).norm();
        test::add_move(program, q, way / 50.0);
    }
    return program;
}

/// Estimate and measurement of one program.
void expect_same_time(const program::Program& program, const std::string& name) {
    const double measured = measured_time(grbl_text(program));
    ASSERT_GT(measured, 0.0) << name;
    const double estimated =
        motion::plan(program, emulated_machine(), as_grbl(look_ahead_of_grbl), {}).duration();
    const double whole = motion::plan(program, emulated_machine(), as_grbl(0), {}).duration();
    EXPECT_NEAR(estimated, measured, 0.02 * measured) << name;
    EXPECT_LE(whole, estimated * (1.0 + 1e-12)) << name;
}

TEST(TimeEstimate, IsWhatTheEmulatedGrblTakesForEverySample) {
    std::vector<test::SampleProgram> samples = test::sample_programs(emulated_machine());
    EXPECT_GE(samples.size(), 20U);
    for (test::SampleProgram& sample : samples) {
        for (program::Block& block : sample.program.blocks) {
            block.path.reset(); // Grbl knows no path modes
        }
        expect_same_time(sample.program, sample.name);
    }
}

TEST(TimeEstimate, IsWhatTheEmulatedGrblTakesForManyShortBlocks) {
    expect_same_time(dense_program(), "flower");
}

TEST(TimeEstimate, OfAPlotIsWhatTheEmulatedGrblTakesForItLinkedOrNot) {
    const plot::Strokes drawn = hpgl::read_hpgl_file("assets/samples/plot/hatched-sign.plt").strokes;
    double as_drawn = 0.0;
    for (const double link : {0.0, 3.0}) {
        const plot::Strokes strokes = plot::planned(drawn, {.link = link}).strokes;
        const plot::CutPath path = plot::cut_path(strokes, {.levels = plot::levels_for(strokes)});
        const program::Program program = plot::plot_program(path, {.machine = emulated_machine().name()});
        expect_same_time(program, fmt::format("sign, links of {} mm", link));
        const double seconds = motion::plan(program, emulated_machine(), {}, {}).duration();
        EXPECT_TRUE(!(link > 0.0) || seconds < 0.95 * as_drawn);
        as_drawn = seconds;
    }
}

} // namespace
} // namespace millwright::emulators
