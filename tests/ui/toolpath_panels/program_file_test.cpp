// A G-code file in the Program workspace, with real mouse and keys in real OpenGL.
#include "core/base/files.h"
#include "tests/ui/person/person.h"
#include "ui/window/window.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <string>

namespace millwright::panels {
namespace {

using actions::Workspace;
using test::Person;

/// Passes over a wavy surface: `moves` feed moves from line 5 on, then M2.
std::string finishing(int moves) {
    std::string text = "G21 G90 G94 G54\nM3 S12000\nG0 Z20\nG1 F1500\n";
    for (int n = 0; n < moves; ++n) {
        const int pass = n / 100;
        const int along = pass % 2 == 0 ? n % 100 : 99 - n % 100;
        fmt::format_to(std::back_inserter(text),
                       "X{:.3f} Y{:.3f} Z{:.3f}\n",
                       1.0 * along,
                       2.0 * pass,
                       6.0 * std::sin(0.08 * along) * std::cos(0.1 * pass));
    }
    return text + "M5\nM2\n";
}

std::filesystem::path program(Person& person, const std::string& text, const std::string& name = "part.ngc") {
    const auto file = person.folder() / name;
    write_file(file, text);
    return file;
}

actions::FilePlace here(Person& person) {
    return person.app().look().file_place().value();
}

TEST(ProgramFile, OpensBesideTheProjectAndShowsItsWorkspace) {
    Person person;
    const project::Project before = person.project();
    person.open(program(person, finishing(3000)));
    const auto now = person.app().look();
    EXPECT_EQ(now.view_state.workspace, Workspace::program);
    EXPECT_EQ(now.project, before);
    ASSERT_TRUE(now.opened && now.opened->execution && now.opened->motion);
    EXPECT_EQ(now.opened->text->lines().count(), 3006);
    EXPECT_TRUE(person.sees("program/listing"));
    EXPECT_TRUE(person.sees("inspector/modal/feed"));
    person.keep("program-file");
}

TEST(ProgramFile, ALineThatIsClickedMovesTheCursorAndTheTool) {
    Person person;
    person.open(program(person, finishing(300)));
    const widgets::Rect lines = person.place("program/listing");
    const auto before = here(person);
    person.click_at({lines.x + 0.7F * lines.w, lines.y + 0.5F * lines.h});
    const auto after = here(person);
    EXPECT_NE(after.line, before.line);
    EXPECT_GT(person.app().look().time(), 0.0);
    // The tool stands where the line before has left it.
    const auto& opened = *person.app().look().opened;
    const auto [first, end] = opened.path.points_of(after.step);
    ASSERT_LT(first, end);
    EXPECT_LT((after.moment.tip - opened.path.point(first - 1).position()).norm(), 1e-3);
}

TEST(ProgramFile, ThePathThatIsClickedFindsItsLine) {
    Person person;
    person.open(program(person, "G21 G90\nG0 X-20 Y0\nG1 X20 F600\nM2\n"));
    person.app().run("play.last");
    person.frames(4);
    // Seen from above, the only feed move lies across the middle of the picture.
    person.desktop().window().view().viewport().look_from(render::StandardView::top);
    person.frames(4);
    const widgets::Rect view = person.place("view/iso");
    const auto scene = render::project(person.desktop().window().view().viewport().camera().view(
                                           {static_cast<int>(view.w), static_cast<int>(view.h)},
                                           {.min = {-20.0, -1.0, -1.0}, .max = {20.0, 1.0, 1.0}}),
                                       {10.0, 0.0, 0.0});
    ASSERT_TRUE(scene.has_value());
    person.click_at(
        {view.x + static_cast<float>(scene->pixel.x), view.y + static_cast<float>(scene->pixel.y)});
    EXPECT_EQ(here(person).line, 3);
    EXPECT_NEAR(here(person).moment.tip.x(), 10.0, 0.5);
}

TEST(ProgramFile, StepsByMoveAndByLine) {
    Person person;
    person.open(program(person, "G21 G90 F600\nG1 X10\nM3 S1000\nF300\nG1 X20\nM2\n"));
    person.press_key(render::Key::home);
    person.press_key(render::Key::left, true);
    EXPECT_EQ(here(person).line, 2);
    person.press_key(render::Key::right);
    EXPECT_EQ(here(person).line, 5);
    person.press_key(render::Key::left, false, true);
    EXPECT_EQ(here(person).line, 4);
    const auto now = person.app().look();
    EXPECT_FLOAT_EQ(now.opened->execution->state_after(here(person).step).feed, 300.0F);
    person.press_key(render::Key::left, false, true);
    EXPECT_EQ(here(person).line, 3);
    EXPECT_FLOAT_EQ(now.opened->execution->state_after(here(person).step).feed, 600.0F);
}

TEST(ProgramFile, PlaysThroughItsLines) {
    Person person;
    person.open(program(person, finishing(200)));
    person.press_key(render::Key::space);
    ASSERT_TRUE(person.app().view_state().playback.playing);
    person.frames(60);
    const int line = here(person).line;
    EXPECT_GT(line, 3);
    person.frames(60);
    EXPECT_GT(here(person).line, line);
}

TEST(ProgramFile, IsScrubbedOnTheTimelineAndInThePlots) {
    Person person;
    person.open(program(person, finishing(300)));
    ASSERT_TRUE(person.app().look().opened->motion);
    const double whole = person.app().look().duration();
    const widgets::Rect track = person.place("timeline/timeline/track");
    person.drag({track.x + 0.1F * track.w, track.centre().y}, {track.x + 0.6F * track.w, track.centre().y});
    EXPECT_NEAR(person.app().look().time(), 0.6 * whole, 0.02 * whole);
    const int line = here(person).line;
    EXPECT_GT(line, 5);
    for (const char* shown : {"feed", "axes"}) {
        person.click("lower/shown/" + std::string(shown));
        const widgets::Rect plot = person.place("lower/motion");
        const double before = person.app().look().time();
        person.click_at({plot.x + 0.25F * plot.w, plot.centre().y});
        const double earlier = person.app().look().time();
        EXPECT_LT(earlier, before) << shown;
        person.keep(std::string("program-plot-") + shown);
        person.click_at({plot.x + 0.8F * plot.w, plot.centre().y});
        EXPECT_GT(person.app().look().time(), earlier) << shown;
    }
    EXPECT_NE(here(person).line, line);
    EXPECT_TRUE(person.sees("inspector/modal/limit"));
}

TEST(ProgramFile, ShowsWhatIsInForceAtTheCursor) {
    Person person({1280, 1400});
    person.open(program(person, "G21 G90 G17\nT3\nM3 S900\nM8\nG55\nG91 G20\nG1 X1 F30\nM5 M9\nM2\n"));
    const auto at = [&](int line) {
        person.fill_in("program/line", std::to_string(line));
        const auto place = here(person);
        EXPECT_EQ(place.line, line);
        return person.app().look().opened->execution->state_after(place.step);
    };
    EXPECT_EQ(at(1).coordinate_system, 1);
    EXPECT_FALSE(at(1).incremental);
    const gcode::ModalView later = at(7);
    EXPECT_EQ(later.coordinate_system, 2);
    EXPECT_TRUE(later.incremental);
    EXPECT_EQ(later.unit, gcode::LengthUnit::inch);
    EXPECT_TRUE(later.flood);
    for (const char* field :
         {"motion", "feed", "spindle", "coolant", "tool", "distance", "units", "plane", "system"}) {
        EXPECT_TRUE(person.sees("inspector/modal/" + std::string(field))) << field;
    }
    EXPECT_FALSE(at(8).flood);
}

TEST(ProgramFile, FindsWordsForwardBackwardAndAround) {
    Person person;
    person.open(program(person, "G21 G90 F600\nG1 X10\n(needle)\nG1 X20\n(NEEDLE too)\nG1 X0\nM2\n"));
    person.fill_in("program/find", "needle");
    EXPECT_EQ(here(person).line, 3);
    person.press_key(render::Key::g, true);
    EXPECT_EQ(here(person).line, 5);
    person.press_key(render::Key::enter); // it is still in the field
    EXPECT_EQ(here(person).line, 3);
    person.press_key(render::Key::g, true, true);
    EXPECT_EQ(here(person).line, 5);
    person.fill_in("program/line", "6");
    EXPECT_EQ(here(person).line, 6);
}

TEST(ProgramFile, ShowsItsErrorsAndGoesToThem) {
    Person person;
    person.open(program(person, "G21 G90 F600\nG1 X10\nG1 X1O Q\nG2 X20 Y0 I1\nG1 X0\nM2\n", "bad.ngc"));
    const auto now = person.app().look();
    ASSERT_EQ(now.opened->errors.size(), 2U);
    EXPECT_EQ(now.opened->errors.front().place.line, 3);
    EXPECT_NE(now.view_state.log.back().find("bad.ngc:3"), std::string::npos);
    EXPECT_FALSE(now.opened->motion);
    person.click("inspector/faults/errors/1");
    EXPECT_EQ(here(person).line, 4);
    person.keep("program-errors");
}

TEST(ProgramFile, IsReadAgainForAnotherMachine) {
    Person person;
    person.open(program(person, "G21 G90 F600\nG1 X10 A30\nM2\n"));
    ASSERT_FALSE(person.app().look().opened->faults.empty()); // the router has no A
    person.app().view_state().file.reading.machine = "ac-table";
    person.app().run("file.read_again");
    person.wait_idle();
    EXPECT_TRUE(person.app().look().opened->faults.empty());
    EXPECT_EQ(person.app().look().opened->machine->name(), "A-on-C table");
}

TEST(ProgramFile, KeepsItsTimeApartFromTheProjects) {
    Person person;
    person.open("assets/projects/dome.json");
    person.app().run("play.last");
    person.frames(2);
    const double project_time = person.app().look().time();
    person.open(program(person, finishing(100)));
    person.app().run("view.toolpath");
    person.frames(2);
    EXPECT_DOUBLE_EQ(person.app().look().time(), project_time);
    person.app().run("view.program");
    person.frames(2);
    EXPECT_LT(person.app().look().time(), project_time);
    person.app().run("file.close_program");
    person.frames(2);
    EXPECT_FALSE(person.app().look().in_file());
    EXPECT_DOUBLE_EQ(person.app().look().time(), project_time);
}

TEST(ProgramFile, CanBeCancelledWhileItIsRead) {
    Person person;
    const auto file =
        program(person, "G21 G90 F600\no100 repeat [3000000]\nG1 X0 Y1\nG1 X9\no100 endrepeat\nM2\n");
    person.app().open(file);
    while (person.app().look().opened->path.empty()) {
        person.frames(1);
    }
    person.app().run("work.cancel");
    person.wait_idle();
    const auto opened = person.app().look().opened;
    EXPECT_TRUE(opened->cancelled);
    EXPECT_LT(opened->path.point_count(), 6'000'000);
    EXPECT_TRUE(person.sees("program/listing"));
}

TEST(ProgramFile, AFileThatIsNotThereLeavesEverythingAsItWas) {
    Person person;
    actions::ActionQueue ask;
    ask.open_file(person.folder() / "missing.ngc");
    person.app().perform(ask);
    EXPECT_FALSE(person.app().look().opened);
    EXPECT_NE(person.app().view_state().log.back().find("missing.ngc"), std::string::npos);
}

TEST(ProgramFile, AnEmptyFileIsSaidToBeEmpty) {
    Person person;
    person.open(program(person, "", "empty.ngc"));
    person.frames(3);
    EXPECT_FALSE(person.app().look().file_place().has_value() && person.app().look().duration() > 0.0);
    person.press_key(render::Key::space);
    EXPECT_FALSE(person.app().view_state().playback.playing);
}

TEST(ProgramFile, LooksRightOnSmallAndLargeScreens) {
    for (const render::PixelSize size : {render::PixelSize{1280, 720}, render::PixelSize{2560, 1440}}) {
        Person person(size);
        person.open(program(person, finishing(3000)));
        person.app().view_state().playback.time = 40.0;
        person.fill_in("program/find", "Y12.000");
        person.frames(3);
        std::string cut;
        for (const std::string& text : person.desktop().ui().cut_texts()) {
            cut += "'" + text + "' ";
        }
        EXPECT_EQ(cut, "") << size.width;
        person.keep(fmt::format("program-file-{}", size.width));
    }
}

} // namespace
} // namespace millwright::panels
