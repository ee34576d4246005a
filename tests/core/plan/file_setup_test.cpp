#include "core/plan/file_setup.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

namespace millwright::plan {
namespace {

/// Two tools: a slot 2 mm deep from X 0 to X 40, then one 1 mm deep at Y 20.
constexpr const char* two_tools = "G21 G90 G17\n"
                                  "T1 M6\n"
                                  "M3 S8000\n"
                                  "G0 Z5\n"
                                  "G0 X0 Y0\n"
                                  "G1 Z-2 F200\n"
                                  "G1 X40 F300\n"
                                  "G0 Z5\n"
                                  "T7 M6\n"
                                  "M3 S8000\n"
                                  "G0 Z5\n"
                                  "G0 X0 Y20.5\n"
                                  "G1 Z-1 F200\n"
                                  "G1 X40 F300\n"
                                  "G0 Z5\n"
                                  "M2\n";

std::shared_ptr<const OpenedProgram> opened(const test::ScratchFolder& scratch, const std::string& text) {
    const std::filesystem::path file = scratch / "part.ngc";
    write_file(file, text);
    ProgramReader reader([] {});
    reader.open(file, {}, "assets");
    reader.wait_idle();
    return reader.latest();
}

StockJob job_of(const OpenedProgram& program, const ToolTexts& tools) {
    StockJob job;
    job.program = program.motion->program;
    job.listing = program.motion->listing;
    job.settings.stock = suggested_stock(program);
    job.settings.resolution = 0.25;
    job.file = file_setup(program, tools);
    return job;
}

TEST(FileSetup, AsksForEachToolWithTheLineThatCallsIt) {
    const test::ScratchFolder scratch;
    const auto program = opened(scratch, two_tools);
    const auto called = called_tools(*program);
    ASSERT_EQ(called.size(), 2U);
    EXPECT_EQ(called[0].number, 1);
    EXPECT_EQ(called[1].number, 7);
    EXPECT_EQ(called[1].line, 9);
    const auto missing = missing_tool(*program, {{1, "flat:6"}});
    ASSERT_TRUE(missing);
    EXPECT_EQ(missing->place.line, 9);
    EXPECT_EQ(missing->message, "the program calls tool 7, whose shape is not known");
    EXPECT_FALSE(missing_tool(*program, {{1, "flat:6"}, {7, "ball:4"}}));
    EXPECT_THROW((void)file_setup(*program, {{1, "flat:6"}}), Error);
    EXPECT_THROW((void)file_setup(*program, {{1, "flat:6"}, {7, "brick"}}), Error);
}

TEST(FileSetup, AProgramWithoutACallNeedsOneTool) {
    const test::ScratchFolder scratch;
    const auto program = opened(scratch, "G21 G90\nG0 X0 Y0 Z5\nG1 X5 Z-1 F100\nM2\n");
    const auto missing = missing_tool(*program, {});
    ASSERT_TRUE(missing);
    EXPECT_EQ(missing->place.line, 0);
    EXPECT_EQ(file_setup(*program, {{0, "flat:6"}}).tools.size(), 1U);
}

TEST(FileSetup, TheSuggestedStockIsTheBoxOfTheFeedsUpToTheTop) {
    const test::ScratchFolder scratch;
    const auto program = opened(scratch, two_tools);
    EXPECT_EQ(suggested_stock(*program), "box:42,23,3@-1,-1,-3");
    EXPECT_EQ(suggested_stock(*opened(scratch, "G21 G90\nG0 X0 Y0 Z5\nM2\n")), "");
}

TEST(FileSetup, EachToolCutsItsOwnBlocks) {
    const test::ScratchFolder scratch;
    const auto program = opened(scratch, two_tools);
    StockJob job = job_of(*program, {{1, "flat:6"}, {7, "flat:4"}});
    job.settings.stock = "box:60,60,10@-10,-30,-10";
    const StockSimulation simulation(job, {});
    const auto& result = *simulation.result();
    constexpr double pi = 3.14159265358979;
    // Slots with round ends, in closed form.
    const double first = 2.0 * (40.0 * 6.0 + pi * 9.0), second = 1.0 * (40.0 * 4.0 + pi * 4.0);
    EXPECT_NEAR(result.cut.removed_volume(), first + second, 0.01 * (first + second));
    EXPECT_TRUE(result.points.empty()) << "there is no part";
    const bool is_hit = std::ranges::any_of(
        result.events, [](const StockEvent& event) { return event.kind != StockEventKind::near_miss; });
    EXPECT_FALSE(is_hit);
    EXPECT_FALSE(result.feeds.empty());
}

TEST(FileSetup, ARapidThroughMaterialIsFoundAtItsLineAndShownAnywhere) {
    const test::ScratchFolder scratch;
    const auto program = opened(scratch,
                                "G21 G90\nT1 M6\nM3 S1000\nG0 Z5\nG0 X-10 Y0\nG0 Z-1\nG1 X0 F300\nG0 X20\n"
                                "G1 X40\nG0 Z5\nM2\n");
    StockJob job = job_of(*program, {{1, "flat:6"}});
    job.settings.stock = "box:60,20,10@-5,-10,-10";
    StockSimulation simulation(job, {});
    const auto& events = simulation.result()->events;
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.front().kind, StockEventKind::rapid_in_stock);
    EXPECT_EQ(events.front().line, 8);
    const StockPicture start = simulation.picture_before(0, {});
    EXPECT_EQ(start.heights.size(), start.mesh.points.size());
    EXPECT_TRUE(std::ranges::none_of(start.heights, [](const auto& h) { return h.has_value(); }));
}

TEST(FileSetup, WhatTheMachineCannotDoIsNotSimulated) {
    const test::ScratchFolder scratch;
    const auto program = opened(scratch, "G21 G90\nT1\nG0 X0 Y0 Z5\nT2\nG1 X5 F100\nM2\n");
    ASSERT_TRUE(program->motion);
    ASSERT_TRUE(program->motion->unsimulated) << "two T and no M6";
    EXPECT_EQ(program->motion->unsimulated->place.line, 4);
    EXPECT_TRUE(called_tools(*program).empty());
    EXPECT_THROW((void)file_setup(*program, {{1, "flat:6"}, {2, "flat:6"}}), Error);
}

} // namespace
} // namespace millwright::plan
