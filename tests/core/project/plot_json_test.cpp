#include "core/base/error.h"
#include "core/base/files.h"
#include "core/project/level_settings.h"
#include "core/project/plot_settings.h"
#include "core/project/project_file.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::project {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// Nothing in it has its default value.
Project every_setting_changed() {
    Project project = project_from_preset("dome");
    project.plot.file = "/drawings/sign.plt";
    PlotSettings& set = project.plot.settings;
    for (const auto& setting : plot_numbers()) {
        setting.set(set, 0.5 * (setting.max + setting.default_value()));
    }
    set.use = PictureUse::halftone;
    set.hpgl.fill = hpgl::FillMode::outline;
    set.hpgl.line_ends = hpgl::LineEnds::join;
    set.hpgl.dashes = false;
    set.hpgl.strictness = hpgl::Strictness::strict;
    set.picture.gray = plot::GrayRule::luminance;
    set.picture.invert = true;
    set.tracing.turns = plot::TurnPolicy::left;
    set.drawing_use = DrawingUse::carving;
    set.clear_floor = false;
    set.join_dots = set.through = true;
    set.tip.kind = plot::TipKind::v;
    set.strokes.side = plot::CutterSide::inside;
    set.strokes.corners = plot::Corners::round;
    set.strokes.hatch_cross = set.strokes.order = set.strokes.link_inside = true;
    set.machine = "router-xyz";
    set.post = "grbl";
    for (int pen = -1; pen < 3; ++pen) {
        plot::Level level{.pen = pen, .enabled = pen != 0};
        level.side = pen > 0 ? std::optional(plot::CutterSide::outside) : std::nullopt;
        for (const auto& setting : level_numbers()) {
            setting.set(level, 0.25 * (3.0 * setting.min + setting.max));
        }
        set.levels.push_back(level);
    }
    set.level = set.levels.front();
    return project;
}

std::string plot_fault(const std::string& plot) {
    try {
        (void)project_from_text(R"({"format": "millwright-project", "version": 1, "name": "", "surface":
{"preset": "dome"}, "machine": {"file": "m"}, "plot": )" +
                                    plot + "}",
                                "part.json");
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "no fault";
}

TEST(PlotOfAProject, WhatIsWrittenIsRead) {
    const Project project = every_setting_changed();
    ASSERT_TRUE(faults_of(project).empty()) << faults_of(project).front();
    EXPECT_EQ(project_from_text(project_text(project), "x"), project);
    EXPECT_FALSE(project == project_from_preset("dome"));
}

TEST(PlotOfAProject, IsNotWrittenWhereThereIsNone) {
    EXPECT_THAT(project_text(project_from_preset("dome")), Not(HasSubstr("\"plot\"")));
}

// Written always it would be one that a person has set, and win over a program's own.
TEST(PlotOfAProject, TheSpindleIsWrittenWhereAPersonHasSetIt) {
    Project project = project_from_preset("dome");
    project.plot.file = "/drawings/turns.ngc";
    EXPECT_THAT(project_text(project), Not(HasSubstr("\"spindle_rpm\": 10000")));
    EXPECT_FALSE(project_from_text(project_text(project), "x").plot.settings.spindle_rpm);
    project.plot.settings.spindle_rpm = usual_spindle_rpm;
    EXPECT_EQ(project_from_text(project_text(project), "x").plot.settings.spindle_rpm, usual_spindle_rpm);
}

TEST(PlotOfAProject, BesideItsProjectMovesWithIt) {
    const test::ScratchFolder scratch;
    const fs::path one = scratch / "one";
    const fs::path other = scratch / "other";
    fs::create_directory(one);
    Project project = project_from_preset("dome");
    project.plot.file = one / "drawings" / "sign.plt";
    write_project(project, one / "part.json");
    EXPECT_THAT(read_file(one / "part.json"), HasSubstr("\"drawings/sign.plt\""));
    EXPECT_EQ(read_project(one / "part.json"), project);
    fs::rename(one, other);
    EXPECT_EQ(read_project(other / "part.json").plot.file, other / "drawings" / "sign.plt");
    project.plot.file = "/elsewhere/sign.plt";
    write_project(project, other / "part.json");
    EXPECT_EQ(read_project(other / "part.json").plot.file, "/elsewhere/sign.plt");
}

// It was "." in a project that was written to the current folder.
TEST(PlotOfAProject, WithoutAFileNamesNone) {
    const test::ScratchFolder scratch;
    const fs::path before = fs::current_path();
    fs::current_path(scratch.path());
    write_project(project_from_preset("dome"), "part.json");
    const Project read = read_project("part.json");
    fs::current_path(before);
    EXPECT_EQ(read, project_from_preset("dome"));
    EXPECT_THAT(read_file(scratch / "part.json"), Not(HasSubstr("\"plot\"")));
}

TEST(PlotOfAProject, FaultsComeWithTheirField) {
    EXPECT_EQ(plot_fault("{}"), "no fault");
    EXPECT_THAT(plot_fault(R"({"link_mm": -1})"), HasSubstr("plot/link_mm: -1 is not between 0 and 100"));
    EXPECT_THAT(plot_fault(R"({"use": "carpet"})"), HasSubstr("plot/use: 'carpet' is not a valid choice"));
    EXPECT_THAT(plot_fault(R"({"levels": [{"pen": 1}, {"depth_mm": 2}]})"), HasSubstr("plot/levels[1]"));
    EXPECT_THAT(plot_fault(R"({"levels": [{"pen": 1, "passes": 0}]})"),
                HasSubstr("plot/levels[0]/passes: 0 is not between 1 and 1000"));
    EXPECT_THAT(plot_fault(R"({"machine": ""})"), HasSubstr("plot/machine: the name is empty"));
    EXPECT_THAT(plot_fault(R"({"speed": 3})"),
                HasSubstr("plot/speed: the field \"speed\" is not known here"));
}

TEST(PlotOfAProject, OutOfItsRangesIsNotWritten) {
    Project project = project_from_preset("dome");
    project.plot.settings.levels.resize(2);
    project.plot.settings.levels[1].cutting = 0.0;
    EXPECT_THAT(faults_of(project),
                testing::ElementsAre(HasSubstr("plot/levels[1]/feed_mm_per_min: 0 is not between")));
    EXPECT_THROW((void)project_text(project), Error);
}

} // namespace
} // namespace millwright::project
