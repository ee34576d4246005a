// The emulated Grbl and the reader of Grbl's dialect against the answers of the firmware itself.
#include "tests/core/emulators/grbl/grbl_answers.h"

#include "core/emulators/grbl/grbl_emulator.h"
#include "core/gcode/interpreter.h"
#include "tests/core/emulators/grbl/last_target.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace millwright::emulators {
namespace {

using test::grbl_answers;
using test::GrblAnswer;

std::string answer_of(GrblEmulator& grbl, std::string_view line) {
    grbl.receive(std::string(line) + "\n");
    std::string text;
    bool resumed = false;
    constexpr int patience = 20'000; // ms
    for (int time = 0; time < patience; ++time) {
        grbl.advance(0.001);
        text += grbl.take_output();
        if (text.ends_with("ok\r\n") || text.find("error:") != std::string::npos) {
            break;
        }
        if (time > 100 && !grbl.moving() && !std::exchange(resumed, true)) {
            grbl.receive("~"); // after M0
        }
    }
    return text;
}

void come_to_rest(GrblEmulator& grbl) {
    while (grbl.moving() || grbl.planned_blocks() > 0) {
        grbl.advance(0.01);
    }
}

std::string modes_of(GrblEmulator& grbl) {
    const std::string text = answer_of(grbl, "$G");
    const std::size_t begin = text.find("[GC:");
    return begin == std::string::npos ? text : text.substr(begin + 4, text.find(']', begin) - begin - 4);
}

TEST(GrblAnswers, TheEmulatedControllerAnswersAsTheFirmware) {
    for (const GrblAnswer& known : grbl_answers) {
        SCOPED_TRACE(known.line);
        GrblEmulator grbl;
        (void)grbl.take_output();
        const std::string answer = answer_of(grbl, known.line);
        if (known.error != 0) {
            EXPECT_EQ(answer, fmt::format("error:{}\r\n", known.error));
        } else {
            EXPECT_TRUE(answer.ends_with("ok\r\n")) << answer;
        }
        if (known.was_under_way) { // hours away
            grbl.advance(0.1);
            EXPECT_TRUE(grbl.moving());
            EXPECT_EQ(modes_of(grbl), known.modes);
            continue;
        }
        come_to_rest(grbl);
        EXPECT_EQ(modes_of(grbl), known.modes);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(grbl.position()[axis], known.position[axis], 0.0005);
        }
    }
}

/// As $G says it.
std::string modes_text(const gcode::ModalState& state) {
    using gcode::SpindleTurning;
    const std::string motion = state.motion % 10 == 0
                                   ? fmt::format("G{}", state.motion / 10)
                                   : fmt::format("G{}.{}", state.motion / 10, state.motion % 10);
    return fmt::format("{} G{} G{} G{} G{} G{} M{} {} T{} F{:.0f} S{:.0f}",
                       motion,
                       53 + state.coordinate_system,
                       17 + static_cast<int>(state.plane),
                       state.unit == gcode::LengthUnit::mm ? 21 : 20,
                       state.distance == gcode::DistanceMode::incremental ? 91 : 90,
                       state.feed_mode == gcode::FeedMode::inverse_time ? 93 : 94,
                       state.spindle == SpindleTurning::stopped     ? 5
                       : state.spindle == SpindleTurning::clockwise ? 3
                                                                    : 4,
                       state.flood ? "M8" : "M9",
                       state.selected_tool,
                       state.feed_rate,
                       std::floor(state.spindle_speed + 0.5));
}

/// A program of one line; what a sender leaves out, or takes for a command, is for no program to say.
TEST(GrblAnswers, TheReaderTakesAndRefusesTheSameLines) {
    for (const GrblAnswer& known : grbl_answers) {
        if (known.line == "%" || known.line == "$" || known.line == ";only" || known.line == "N1") {
            continue;
        }
        SCOPED_TRACE(known.line);
        gcode::ReaderSettings settings;
        settings.dialect = gcode::Dialect::grbl;
        test::LastTarget ends;
        gcode::Interpreter reader(known.line, "line.nc", settings, ends);
        reader.run();
        ASSERT_EQ(reader.errors().empty(), known.error == 0)
            << (reader.errors().empty() ? "" : to_text(reader.errors().front()));
        if (known.error != 0) {
            const std::string message = reader.errors().front().message;
            if (message.find("(error ") != std::string::npos) {
                EXPECT_NE(message.find(fmt::format("(error {})", known.error)), std::string::npos) << message;
            }
            continue;
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(ends.at[axis], known.position[axis], 0.0005);
        }
        const std::string modes = modes_text(reader.state());
        const bool inverse =
            reader.state().feed_mode == gcode::FeedMode::inverse_time; // F is of one line there
        EXPECT_TRUE(modes == known.modes || inverse) << modes << " and not " << known.modes;
    }
}

} // namespace
} // namespace millwright::emulators
