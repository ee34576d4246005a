// A job that waits for another tool in the Machine workspace: what a person sees and can do meanwhile.
#include "core/base/files.h"
#include "tests/ui/person/at_machine.h"
#include "ui/workspaces/job_source.h"
#include "ui/workspaces/kept_view_state.h"
#include "ui/workspaces/start_prompt.h"
#include "ui/workspaces/tool_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::panels {
namespace {

using drivers::DriverState;
using drivers::ToolChangeWay;
using test::Person;
using testing::HasSubstr;

const std::string two_tools = "G21 G90 G94\nG0 Z5\nM3 S800\nG1 X5 F2000\nG0 Z6\nT3 M6 (6 mm end mill)\n"
                              "G1 X9 F2000\nG0 Z8\nM30\n";

class ToolChangeAtGrbl : public ::testing::TestWithParam<render::PixelSize> {
protected:
    ToolChangeAtGrbl() : person(GetParam()) { test::connect(person, grbl); }

    void open(const std::string& program) {
        write_file(person.folder() / "part.ngc", program);
        person.open(person.folder() / "part.ngc");
        person.wait_idle();
        person.app().run("view.machine");
        person.frames(3);
    }
    [[nodiscard]] drivers::DriverStatus status() { return person.app().look().connection.status; }
    [[nodiscard]] bool waits() {
        return actions::waits_for_tool(status()) && status().state == DriverState::holding;
    }
    /// By one report: the controller's own position is ahead of a window that still says that it waits, and a
    /// machine that jogs takes no zero.
    [[nodiscard]] bool rests_below(int axis, double position) {
        return waits() && status().position[axis] < position;
    }
    [[nodiscard]] std::string name(const std::string& what) const {
        return what + "-" + std::to_string(GetParam().width);
    }

    test::GrblBench grbl;
    Person person;
};

TEST_P(ToolChangeAtGrbl, WaitsWhileThePersonJogsAndZeroesAndGoesOnWithContinue) {
    open(two_tools);
    person.app().view_state().manual.tool_changes[grbl.port()].plan.spin_up = 0.0;
    test::press_run(person);
    ASSERT_TRUE(person.live_until([this] { return waits(); }));
    EXPECT_TRUE(person.sees("inspector/job/tool_change"));
    EXPECT_THAT(status().message, HasSubstr("change to tool 3 at line 6: M6 (6 mm end mill)"));
    person.keep(name("tool-change-waits"));
    person.app().view_state().manual.step = 10.0;
    person.frames(2);
    for (const char* button : {"hand/jog/minus_X", "hand/jog/minus_Z", "hand/position/zero_Z"}) {
        ASSERT_TRUE(person.sees(button)) << button;
        EXPECT_EQ(person.refusal(button), "") << button;
    }
    person.click("hand/jog/minus_X");
    ASSERT_TRUE(person.live_until([this] { return rests_below(0, -4.9); }));
    person.click("hand/jog/minus_Z");
    ASSERT_TRUE(person.live_until([this] { return rests_below(2, -3.9); }));
    person.click("hand/position/zero_Z");
    ASSERT_TRUE(person.live_until([this] { return waits() && status().work_offset[2] < -3.9; }));
    EXPECT_TRUE(person.app().look().job.running);
    ASSERT_TRUE(person.click_when_offered("inspector/job/machine_resume"));
    ASSERT_TRUE(person.live_until([this] { return person.app().look().job.outcome.has_value(); }, 60.0))
        << test::conversation(person);
    EXPECT_EQ(person.app().look().job.outcome->end, jobs::JobEnd::done)
        << person.app().look().job.outcome->sentence;
    EXPECT_NEAR(grbl.position()[2], 4.0, 0.01); // Z8 from the new zero
    EXPECT_FALSE(person.sees("inspector/job/tool_change"));
}

TEST_P(ToolChangeAtGrbl, StopEndsTheJobThatWaits) {
    open(two_tools);
    test::press_run(person);
    ASSERT_TRUE(person.live_until([this] { return waits(); }));
    const auto there = grbl.position();
    person.click("inspector/job/machine_stop");
    ASSERT_TRUE(person.live_until([this] { return person.app().look().job.outcome.has_value(); }));
    EXPECT_EQ(person.app().look().job.outcome->end, jobs::JobEnd::stopped);
    EXPECT_EQ(person.app().look().job.outcome->executed_blocks, 5);
    EXPECT_EQ(grbl.position(), there);
}

TEST_P(ToolChangeAtGrbl, AProgramIsRefusedWhereThatIsChosen) {
    open(two_tools);
    const std::string way = "inspector/tool_changes/way";
    person.bring_into_sight(way);
    person.choose(way, "none");
    ASSERT_TRUE(person.live_until([this] { return !person.refusal("inspector/job/machine_run").empty(); }));
    EXPECT_THAT(person.refusal("inspector/job/machine_run"), HasSubstr("error 20"));
}

TEST_P(ToolChangeAtGrbl, TheSensorHasItsFieldsAndIsCheckedBefore) {
    open(two_tools);
    const std::string way = "inspector/tool_changes/way";
    person.bring_into_sight(way);
    person.choose(way, "probe");
    person.fill_in("inspector/tool_changes/sensor_x", "-12.5");
    person.fill_in("inspector/tool_changes/deepest_z", "-40");
    person.bring_into_sight("inspector/tool_changes/sensor_feed");
    person.keep(name("tool-change-sensor"));
    const auto& kept = person.app().view_state().manual.tool_changes.at(grbl.port());
    EXPECT_EQ(kept.plan.way, ToolChangeWay::probe);
    EXPECT_EQ(kept.plan.sensor.x, -12.5);
    EXPECT_EQ(kept.plan.sensor.deepest_z, -40.0);
    ASSERT_TRUE(person.live_until([this] { return !person.refusal("inspector/job/machine_run").empty(); }));
    const auto checked = person.app().look().run_check;
    ASSERT_TRUE(checked);
    EXPECT_TRUE(std::ranges::any_of(checked->faults, [](const Diagnostic& fault) {
        return fault.message.find("needs a machine that homes") != std::string::npos;
    }));
    const auto now = person.app().look();
    const auto wish = std::make_shared<const actions::StartWish>(
        actions::start_wish(actions::wanted_job(now), {}, now.connection));
    EXPECT_THAT(actions::check_start(wish, {}).tool,
                HasSubstr("The tool with which the Z zero was set must be in the spindle"));
}

INSTANTIATE_TEST_SUITE_P(Windows,
                         ToolChangeAtGrbl,
                         ::testing::Values(render::PixelSize{1280, 800}, render::PixelSize{1024, 700}));

TEST(ToolChangeSettings, AreKeptForEachPort) {
    actions::ViewState view_state;
    actions::ToolChangeSettings settings;
    settings.here = false;
    settings.plan = {.way = ToolChangeWay::macro,
                     .spin_up = 1.5,
                     .sensor = {.x = -1.25, .y = 2.0, .travel_z = -3.0, .deepest_z = -44.0, .feed = 150.0},
                     .macro_file = "/home/me/my lines.nc"};
    view_state.manual.tool_changes["/dev/ttyUSB0"] = settings;
    view_state.manual.tool_changes["tcp:cnc:23"].plan.way = ToolChangeWay::probe;
    const auto kept = actions::kept_of(view_state, {});
    actions::ViewState again;
    EXPECT_THAT(actions::restore(again, kept), testing::IsEmpty());
    EXPECT_EQ(again.manual.tool_changes, view_state.manual.tool_changes);
    EXPECT_EQ(actions::restore(again, {{"tool_change.x", "here stop nan 0 0 0 0 0 "}}).size(), 1u);
    EXPECT_FALSE(actions::tool_changes_of("sometimes stop 3 0 0 0 0 200 "));
}

} // namespace
} // namespace millwright::panels
