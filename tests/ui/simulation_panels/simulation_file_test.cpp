// The simulation of a G-code file in the window, which has neither stock nor tools in it: real mouse and
// keys, real OpenGL.
#include "core/base/files.h"
#include "core/plan/file_setup.h"
#include "tests/support/scratch_folder.h"
#include "tests/ui/person/person.h"
#include "tests/ui/person/plot_person.h"
#include "ui/workspaces/stock_workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

namespace millwright::panels {
namespace {

using test::Person;
using testing::HasSubstr;

constexpr const char* in_section = "inspector/simulation/";

/// A slot 2 mm deep by T1, one 1 mm deep by T7, and a rapid through the wall between them on line 16.
constexpr const char* slots_by_two_tools = "G21 G90 G17\n"
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
                                           "G1 X0\n"
                                           "G0 Y0\n"
                                           "G0 Z5\n"
                                           "M2\n";

class FileSimulation : public ::testing::Test {
protected:
    FileSimulation() { begin({1600, 1000}); }

    void begin(const render::PixelSize& screen) {
        person_.reset(); // its context goes before the next one comes
        person_ = std::make_unique<Person>(screen);
        open("part.ngc", slots_by_two_tools);
        person().app().view_state().stock.settings.resolution = 0.5;
        person().click("inspector/simulation");
        person().wait_idle();
        person().frames(3);
    }

    void open(const std::string& name, const std::string& text) {
        const auto file = person().folder() / name;
        write_file(file, text);
        person().open(file);
        person().wait_idle();
    }

    void name_both_tools() {
        person().fill_in(at("tool_1"), "flat:6");
        person().fill_in(at("tool_7"), "ball:4");
        person().wait_idle();
    }

    void simulate() {
        person().click(at("simulation_run"));
        person().wait_idle();
        ASSERT_NE(stock().view().result, nullptr);
        ASSERT_NE(stock().view().picture, nullptr);
        ASSERT_TRUE(actions::stock_is_current(person().app().look()));
    }

    [[nodiscard]] static std::string at(const std::string& id) { return in_section + id; }
    [[nodiscard]] Person& person() { return *person_; }
    [[nodiscard]] actions::StockWorkspace& stock() { return person().app().stock(); }
    [[nodiscard]] actions::ViewState& view_state() { return person().app().view_state(); }

    std::unique_ptr<Person> person_;
};

TEST_F(FileSimulation, AsksForEveryToolWithTheLineThatCallsIt) {
    EXPECT_THAT(person().refusal(at("simulation_run")),
                testing::AllOf(HasSubstr("Line 2"), HasSubstr("tool 1")));
    person().keep("simulation-file-asks");
    person().fill_in(at("tool_1"), "flat:6");
    person().wait_idle();
    EXPECT_THAT(person().refusal(at("simulation_run")),
                testing::AllOf(HasSubstr("Line 9"), HasSubstr("tool 7")));
    person().fill_in(at("tool_7"), "spoon:4");
    person().wait_idle();
    EXPECT_EQ(view_state().stock.file.tools.count(7), 0U) << "no such tool";
    person().press_key(render::Key::escape);
    person().fill_in(at("tool_7"), "ball:4");
    person().wait_idle();
    EXPECT_EQ(person().refusal(at("simulation_run")), "");
}

TEST_F(FileSimulation, ShowsWhatIsLeftWithoutAPart) {
    EXPECT_EQ(view_state().stock.file.stock, "box:42,23,3@-1,-1,-3") << "the box around the path";
    name_both_tools();
    const render::Picture without = person().picture_of("view/iso");
    simulate();
    EXPECT_NE(person().picture_of("view/iso"), without);
    EXPECT_TRUE(person().sees(at("removed")));
    EXPECT_TRUE(person().sees(at("air")));
    EXPECT_FALSE(person().sees(at("gouge"))) << "there is nothing to compare with";
    EXPECT_FALSE(person().sees("view/stock_legend"));
    EXPECT_GT(stock().view().result->cut.removed_volume(), 100.0);
    person().keep("simulation-file-dark-1600x1000");
    view_state().theme = widgets::Theme::light;
    person().frames(4);
    person().keep("simulation-file-light-1600x1000");
    EXPECT_THAT(person().desktop().ui().cut_texts(), testing::IsEmpty());
}

TEST_F(FileSimulation, FollowsTheTimeline) {
    name_both_tools();
    simulate();
    const auto end = stock().view().picture;
    view_state().playback.time = 0.3 * person().app().look().duration();
    person().wait_idle();
    const auto before = stock().view().picture;
    EXPECT_EQ(before->block, person().app().look().block());
    EXPECT_LT(before->block, end->block);
    EXPECT_NE(before->mesh.points, end->mesh.points);
}

TEST_F(FileSimulation, ARapidThroughMaterialIsListedAndAClickGoesToItsLine) {
    name_both_tools();
    person().fill_in(at("stock_text"), "box:60,60,10@-10,-20,-10");
    simulate();
    const auto& events = stock().view().result->events;
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.front().kind, plan::StockEventKind::rapid_in_stock);
    EXPECT_EQ(events.front().line, 16);
    person().click(at("list"));
    person().frames(3);
    ASSERT_TRUE(person().sees("lower/collisions/event_0"));
    person().click("lower/collisions/event_0");
    person().wait_idle();
    EXPECT_EQ(person().app().look().file_place().value().line, 16);
    person().keep("simulation-file-collision");
}

TEST_F(FileSimulation, AToolThatWasChangedSinceNeedsAnotherSimulation) {
    name_both_tools();
    simulate();
    EXPECT_FALSE(stock().is_outdated(person().app().look()));
    person().fill_in(at("tool_7"), "flat:5");
    person().wait_idle();
    EXPECT_TRUE(stock().is_outdated(person().app().look()));
    simulate();
    EXPECT_FALSE(stock().is_outdated(person().app().look()));
}

TEST_F(FileSimulation, AnotherFileBeginsWithItsOwnStockAndWithoutTools) {
    name_both_tools();
    simulate();
    open("other.ngc", "G21 G90\nT1 M6\nM3 S900\nG0 X0 Y0 Z5\nG1 Z-1 F100\nG1 X10\nM2\n");
    EXPECT_FALSE(actions::stock_is_current(person().app().look()));
    EXPECT_EQ(view_state().stock.file.stock, "box:12,2,2@-1,-1,-2");
    EXPECT_THAT(person().refusal(at("simulation_run")), HasSubstr("tool 1")) << "never that of another file";
}

TEST_F(FileSimulation, TheProjectKeepsItsOwnStock) {
    const project::StockInput before = person().project().stock;
    name_both_tools();
    person().fill_in(at("stock_text"), "box:60,60,10@-10,-20,-10");
    person().wait_idle();
    EXPECT_EQ(person().project().stock, before);
    person().press_key(render::Key::f4);
    person().wait_idle();
    EXPECT_TRUE(person().sees(at("allowance")));
    EXPECT_FALSE(person().sees(at("tool_1")));
}

TEST_F(FileSimulation, WhileAJobRunsTheStockIsThatOfTheExecutedBlocks) {
    open("one.ngc", "G21 G90 G94\nM3 S900\nG0 X0 Y0 Z5\nG1 Z-1 F300\nG1 X10\nY5\nX0\nY10\nX10\nG0 Z5\nM2\n");
    person().fill_in(at("tool_0"), "flat:4");
    person().wait_idle();
    simulate();
    person().app().run("view.machine");
    view_state().machine_speed = 4.0;
    person().wait_idle();
    person().app().run("machine.run");
    int most = 0;
    bool follows = false; // until then the picture is still that of the end
    const int end = person().app().look().program()->block_count();
    ASSERT_TRUE(person().live_until(
        [&] {
            const auto now = person().app().look();
            if (now.job.running && now.job.report && now.stock.view().picture) {
                const int shown = now.stock.view().picture->block;
                const int executed = now.job.report->driver.executed_blocks;
                follows = follows || shown <= executed;
                if (!follows) {
                    return now.job.outcome.has_value();
                }
                EXPECT_LE(shown, executed);
                if (most <= 4 && shown > 4) {
                    person().keep("simulation-live");
                }
                most = std::max(most, shown);
            }
            return now.job.outcome.has_value();
        },
        60.0));
    EXPECT_GT(most, 4);
    EXPECT_LE(stock().view().picture->block, end);
    EXPECT_EQ(person().app().look().job.outcome->end, jobs::JobEnd::done);
}

TEST_F(FileSimulation, FitsSmallScreensInBothThemes) {
    begin({1280, 800});
    name_both_tools();
    simulate();
    EXPECT_THAT(person().desktop().ui().cut_texts(), testing::IsEmpty());
    person().keep("simulation-file-dark-1280x800");
    view_state().theme = widgets::Theme::light;
    person().frames(4);
    EXPECT_THAT(person().desktop().ui().cut_texts(), testing::IsEmpty());
    person().keep("simulation-file-light-1280x800");
}

TEST(PlotSimulation, CutsTheProgramOfThePlot) {
    test::PlotPerson bench("assets/samples/plot/hatched-sign.plt", {1600, 1000});
    Person& person = bench.person;
    person.app().view_state().stock.settings.resolution = 0.5;
    person.click("inspector/simulation");
    bench.settle();
    const auto called = plan::called_tools(*person.app().look().opened);
    ASSERT_FALSE(called.empty());
    for (const gcode::ToolCall& call : called) {
        EXPECT_NE(person.refusal("inspector/simulation/simulation_run"), "");
        person.fill_in("inspector/simulation/tool_" + std::to_string(call.number), "flat:1");
    }
    bench.settle();
    const render::Picture before = person.picture_of("view/iso");
    person.click("inspector/simulation/simulation_run");
    bench.settle();
    ASSERT_TRUE(actions::stock_is_current(person.app().look()));
    EXPECT_GT(person.app().stock().view().result->cut.removed_volume(), 0.0);
    person.keep("simulation-plot");
    EXPECT_NE(person.picture_of("view/iso"), before);
}

TEST(PlotSimulation, StaysWhileSomethingElseIsLookedAtAndSoDoWhatWasTypedForFileAndPlot) {
    const test::ScratchFolder scratch;
    write_file(scratch / "one.ngc", "G21 G90\nT1 M6\nM3 S900\nG0 Z5\nG1 Z-1 F300\nX40\nG0 Z5\nM2\n");
    test::PlotPerson bench("assets/samples/plot/hatched-sign.plt", {1600, 1000});
    Person& person = bench.person;
    person.app().view_state().stock.settings.resolution = 0.5;
    person.click("inspector/simulation");
    bench.settle();
    for (const gcode::ToolCall& call : plan::called_tools(*person.app().look().opened)) {
        person.fill_in("inspector/simulation/tool_" + std::to_string(call.number), "flat:1");
    }
    bench.settle();
    const auto of_plot = person.app().view_state().stock.file;
    ASSERT_FALSE(of_plot.tools.empty());
    person.click("inspector/simulation/simulation_run");
    bench.settle();
    ASSERT_TRUE(actions::stock_is_current(person.app().look()));
    person.app().run("view.machine");
    bench.settle();
    EXPECT_NE(person.app().stock().view().picture, nullptr);
    person.app().run("view.plot");
    bench.settle();
    EXPECT_TRUE(actions::stock_is_current(person.app().look()));
    EXPECT_NE(person.app().stock().view().picture, nullptr);

    const auto shows_file = [&] {
        return person.app().look().in_file() &&
               person.app().view_state().stock.file.file == scratch / "one.ngc";
    };
    person.app().run("view.program"); // in the Plot workspace a G-code file is opened as a plot
    person.open(scratch / "one.ngc");
    ASSERT_TRUE(person.live_until(shows_file));
    EXPECT_TRUE(person.app().view_state().stock.file.tools.empty());
    person.app().view_state().stock.file.tools[1] = "ball:6";
    person.app().view_state().stock.file.stock = "box:50,30,5@-5,-5,-5";
    person.app().run("view.plot");
    bench.settle();
    EXPECT_EQ(person.app().view_state().stock.file.tools, of_plot.tools);
    person.app().run("view.program");
    ASSERT_TRUE(person.live_until(shows_file));
    EXPECT_EQ(person.app().view_state().stock.file.stock, "box:50,30,5@-5,-5,-5");
    EXPECT_EQ(person.app().view_state().stock.file.tools.at(1), "ball:6");
}

} // namespace
} // namespace millwright::panels
