#include "core/gcode_programs/tool_calls.h"

#include "core/base/error.h"
#include "core/gcode/interpreter.h"
#include "core/kinematics/machine_file.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace millwright::gcode {
namespace {

std::vector<ToolCall> calls_of(const std::string& text) {
    const kinematics::MachineModel machine = kinematics::read_machine("assets/machines/router-xyz.json");
    MachineProgramBuilder builder(machine, "part.ngc");
    ToolCallRecorder recorder(builder);
    ReaderSettings settings;
    settings.any_tool = true;
    Interpreter program(text, "part.ngc", settings, recorder);
    while (program.step()) {
    }
    return recorder.calls("part.ngc");
}

TEST(ToolCalls, ChangeAtM6AndNotAtT) {
    const auto calls = calls_of("T1 M6\nG0 X0 Y0 Z0\nT2\nG0 X5\nM6\nG0 X6\nT0 M6\nM2\n");
    ASSERT_EQ(calls.size(), 3U);
    EXPECT_EQ(calls[0].number, 1);
    EXPECT_EQ(calls[0].line, 1);
    EXPECT_EQ(calls[1].number, 2);
    EXPECT_EQ(calls[1].line, 5);
    EXPECT_GT(calls[1].first_block, calls[0].first_block);
    EXPECT_TRUE(calls[2].empty);
    EXPECT_FALSE(calls[1].empty);
}

TEST(ToolCalls, WithoutM6TheToolOfTIsThereFromTheStart) {
    EXPECT_EQ(calls_of("G0 X0 Y0 Z0\nT4\nG0 X5\nM2\n"), (std::vector<ToolCall>{{0, 4, 2}}));
    EXPECT_EQ(calls_of("G0 X0 Y0 Z0\nM2\n"), (std::vector<ToolCall>{{}}));
}

TEST(ToolCalls, TwoTWithoutM6AreRefusedWithTheLine) {
    try {
        (void)calls_of("T4\nG0 X0 Y0 Z0\nT5\nG0 X5\nM2\n");
        FAIL() << "taken";
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().place.line, 3);
        EXPECT_EQ(error.diagnostic().message, "T5 is selected after T4, and no M6 changes to it");
    }
}

} // namespace
} // namespace millwright::gcode
