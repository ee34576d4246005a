// Before a real machine moves a person is asked, once, in sight of the machine.
#include "core/base/files.h"
#include "tests/ui/person/at_machine.h"
#include "ui/window/view_panel.h"
#include "ui/workspaces/at_rest.h"
#include "ui/workspaces/start_prompt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::panels {
namespace {

using actions::Workspace;
using test::Person;
using testing::HasSubstr;

class StartSheetAtGrbl : public ::testing::Test {
protected:
    StartSheetAtGrbl() { test::connect(person, grbl); }

    void open(const std::string& program) {
        write_file(person.folder() / "part.ngc", program);
        person.open(person.folder() / "part.ngc");
        person.wait_idle();
    }
    void show_machine() {
        person.app().run("view.machine");
        person.frames(3);
    }
    [[nodiscard]] bool is_asked() { return person.sees(start); }
    void wait_for_check() {
        ASSERT_TRUE(person.live_until([this] {
            const auto now = person.app().look();
            return is_asked() && now.start_check && now.start_check->wish == now.view_state.start;
        }));
    }
    /// Of Run, once the whole program was read for this machine.
    [[nodiscard]] std::string run_refusal() {
        EXPECT_TRUE(person.live_until([this] { return person.app().look().run_check != nullptr; }));
        person.frames(2);
        return person.refusal("inspector/job/machine_run");
    }
    /// Opens the sheet for what is shown, which Run may refuse.
    void ask_all_the_same() {
        const auto now = person.app().look();
        const jobs::Job job = jobs::text_job(std::string(now.opened->text->text()), now.opened->file);
        person.app().ask_to_start(actions::start_wish(job, {}, now.connection));
        person.frames(2);
        wait_for_check();
        person.frames(2);
    }
    [[nodiscard]] bool has_job() {
        const auto job = person.app().look().job;
        return job.running || job.outcome || job.failure;
    }

    const std::string start = "dialogs/start/start_go";
    const std::string square = "G21 G90 G94\nM3 S800\nG1 X40 F60\nY12.5\nM5\nM2\n";
    test::GrblBench grbl;
    Person person;
};

TEST_F(StartSheetAtGrbl, F9InAnotherWorkspaceGoesToTheMachineAndNoFurther) {
    open(square);
    for (const Workspace from : {Workspace::design,
                                 Workspace::grid,
                                 Workspace::toolpath,
                                 Workspace::program,
                                 Workspace::processor,
                                 Workspace::plot,
                                 Workspace::arm}) {
        person.app().view_state().workspace = from;
        person.frames(3);
        person.press_key(render::Key::f9);
        person.frames(5);
        EXPECT_EQ(person.app().view_state().workspace, Workspace::machine);
        EXPECT_FALSE(is_asked());
        EXPECT_FALSE(has_job());
    }
    person.app().run("queue.add");
    person.app().view_state().workspace = Workspace::program;
    person.app().run("queue.run_next");
    person.frames(5);
    EXPECT_EQ(person.app().view_state().workspace, Workspace::machine);
    EXPECT_TRUE(person.sees("lower/queue/queue_run_next"));
    EXPECT_FALSE(is_asked());
    EXPECT_FALSE(has_job());
    EXPECT_LT(grbl.last_motion(), 0.0);
}

TEST_F(StartSheetAtGrbl, ShowsWhatWillMoveAndEnterStartsIt) {
    open(square);
    show_machine();
    person.press_key(render::Key::f9);
    wait_for_check();
    person.frames(2);
    for (const char* const row : {"program", "machine", "position", "X", "Y", "modes", "spindle", "tool"}) {
        EXPECT_TRUE(person.sees(std::string("dialogs/start/") + row)) << row;
    }
    EXPECT_THAT(person.desktop().ui().cut_texts(), testing::IsEmpty());
    EXPECT_FALSE(person.sees("dialogs/start/Z"));    // it does not move
    EXPECT_TRUE(person.sees("dialogs/start/doubt")); // this Grbl was switched on and not homed
    const auto check = person.app().look().start_check;
    EXPECT_DOUBLE_EQ(check->program_check.ranges[0].max, 40.0);
    EXPECT_DOUBLE_EQ(check->program_check.ranges[1].max, 12.5);
    EXPECT_DOUBLE_EQ(check->program_check.greatest_spindle_rpm, 800.0);
    person.keep("machine-start");

    person.press_key(render::Key::escape);
    person.frames(5);
    EXPECT_FALSE(is_asked());
    EXPECT_FALSE(has_job());

    person.press_key(render::Key::f9);
    person.press_key(render::Key::f9); // is no answer
    wait_for_check();
    EXPECT_FALSE(has_job());
    person.press_key(render::Key::enter);
    EXPECT_FALSE(is_asked());
    ASSERT_TRUE(person.live_until([this] { return grbl.moving(); }));
    person.app().run("machine.stop");
    ASSERT_TRUE(person.live_until([this] { return !person.app().look().job.running; }));
}

TEST_F(StartSheetAtGrbl, LetsTheControllerReadTheProgramAndSaysWhatItRefuses) {
    open("G21 G90 G94\nG1 X40 F60\nM66 P1\nM2\n");
    show_machine();
    EXPECT_THAT(run_refusal(), HasSubstr("part.ngc:3:1: Grbl does not support M66"));
    ask_all_the_same();
    person.click("dialogs/start/start_check");
    const std::string answer = "dialogs/start/answer";
    ASSERT_TRUE(person.live_until([&] { // after the answer it is asked for its modes and offsets
        return person.sees(answer) && actions::at_rest(person.app().look().connection).allowed;
    }));
    EXPECT_THAT(person.app().look().connection.status.answer.text, HasSubstr("line 3: "));
    EXPECT_TRUE(is_asked());
    EXPECT_LT(grbl.last_motion(), 0.0);
    person.keep("machine-start-check");
    person.press_key(render::Key::escape);
    person.frames(5);
    ask_all_the_same();
    EXPECT_FALSE(person.sees(answer)) << "of another question";
    EXPECT_FALSE(has_job());
}

TEST_F(StartSheetAtGrbl, TracesTheBoxInPlaceOfTheJob) {
    open("G21 G90 G94\nG0 X2 Y2\nG1 X4 F3000\nY5\nM2\n");
    show_machine();
    person.press_key(render::Key::f9);
    wait_for_check();
    person.app().run("machine.trust_position");
    person.frames(2);
    person.click("dialogs/start/start_trace");
    ASSERT_TRUE(person.live_until([this] {
        const auto job = person.app().look().job;
        return !job.running && job.outcome;
    }));
    EXPECT_FALSE(is_asked());
    const auto now = person.app().look();
    EXPECT_EQ(now.job.outcome->end, jobs::JobEnd::done) << now.job.outcome->sentence;
    EXPECT_NEAR(now.connection.status.position[0], 2.0, 0.01); // back where it began
    EXPECT_NEAR(now.connection.status.position[1], 2.0, 0.01);
}

TEST_F(StartSheetAtGrbl, EnterThatIsHeldFromBeforeStartsNothing) {
    open(square);
    show_machine();
    person.hold_keys({render::Key::enter});
    person.click("inspector/job/machine_run");
    wait_for_check();
    person.frames(90); // as long as a key takes to repeat, and longer
    EXPECT_TRUE(is_asked());
    EXPECT_FALSE(has_job());
    person.hold_keys({});
    person.frames(2);
    person.press_key(render::Key::enter);
    ASSERT_TRUE(person.live_until([this] { return grbl.moving(); }));
    person.app().run("machine.emergency_stop");
    ASSERT_TRUE(person.live_until([this] { return !person.app().look().job.running; }));
}

TEST_F(StartSheetAtGrbl, AProgramThatLeavesTheTravelCannotBeStarted) {
    open("G21 G90 G94\nG1 X5000 F600\nM2\n");
    show_machine();
    EXPECT_THAT(run_refusal(), HasSubstr("part.ngc:2: axis X would move "));
    EXPECT_TRUE(person.sees("inspector/job/findings"));
    person.press_key(render::Key::f9);
    person.frames(5);
    EXPECT_FALSE(is_asked());
    ask_all_the_same();
    EXPECT_THAT(person.refusal(start), HasSubstr("axis X"));
    EXPECT_TRUE(person.sees("dialogs/start/faults"));
    person.keep("machine-start-refused");
    person.press_key(render::Key::enter);
    person.frames(5);
    EXPECT_TRUE(is_asked());
    EXPECT_FALSE(has_job());
}

TEST_F(StartSheetAtGrbl, AProgramOfAxesThatTheMachineDoesNotHaveIsNotOffered) {
    show_machine();
    person.wait_idle(); // the sample moves two rotary axes, too
    person.frames(3);
    EXPECT_THAT(person.refusal("inspector/job/machine_run"),
                testing::AllOf(HasSubstr("The program moves A and B, but "),
                               HasSubstr("the connected machine has only X, Y and Z. Connect a machine")));
    EXPECT_FALSE(scene_of(person.app().look()).layers.machine.bodies); // that of another machine
    EXPECT_TRUE(person.sees("inspector/job/axes"));
    person.keep("machine-other-axes");
    person.app().run("machine.run");
    EXPECT_FALSE(is_asked());
    EXPECT_FALSE(has_job());
    // Where that is known only once the program was read for this machine, the sheet says it.
    actions::ConnectionView grbl_view = person.app().look().connection;
    grbl_view.can.dialect.reset(); // Grbl's own rules do not know the word
    const auto job = jobs::text_job("G21 G90\nG1 X10 A30 F100\nM2\n", "turns.ngc");
    const auto wish = std::make_shared<const actions::StartWish>(actions::start_wish(job, {}, grbl_view));
    const actions::StartCheck check = actions::check_start(wish, {});
    ASSERT_FALSE(check.faults.empty());
    EXPECT_EQ(check.faults.front().message, "the program moves A, but the machine has only X, Y and Z");
}

TEST_F(StartSheetAtGrbl, RunIsCheckedAgainForAnotherProgramAndAnotherPosition) {
    open("G21 G90\nG1 X10 A30 F100\nX20\nM2\n"); // the machine of the workbench has no A, this Grbl neither
    show_machine();
    EXPECT_THAT(run_refusal(), HasSubstr("the program moves A, but the machine has only X, Y and Z"));
    const auto extents = [&] {
        return actions::check_start(std::make_shared<const actions::StartWish>(actions::start_wish(
                                        jobs::text_job(read_file(person.folder() / "part.ngc"), "part.ngc"),
                                        {},
                                        person.app().look().connection)),
                                    {})
            .program_check;
    };
    EXPECT_DOUBLE_EQ(extents().ranges[0].max, 20.0); // of the lines with A, too
    EXPECT_EQ(jobs::unread_text(extents()), "");
    open("G21 G90 G94\nG1 X3 F3000\nM2\n");
    show_machine();
    EXPECT_EQ(run_refusal(), "");
    open("G21 G91 G94\nG0 X150\nM2\n"); // a travel of 200 mm of which the beginning is not known
    show_machine();
    EXPECT_EQ(run_refusal(), "");
    const auto before = person.app().look().run_check;
    person.frames(30);
    EXPECT_EQ(person.app().look().run_check, before) << "nothing has changed";
    person.app().connection().tell([](drivers::Driver& driver) { (void)driver.command("G91 G0 X2\nG90"); });
    ASSERT_TRUE(person.live_until([&] {
        const auto now = person.app().look();
        return now.run_check && now.run_check != before &&
               now.run_check->wish->machine.status.position[0] > 1.99;
    }));
}

TEST_F(StartSheetAtGrbl, RunIsCheckedAgainOnceThePositionIsConfirmed) {
    person.app().view_state().manual.tool_changes[grbl.port()].plan.way = drivers::ToolChangeWay::probe;
    ASSERT_FALSE(person.app().look().connection.status.position_doubt.empty());
    open("G21 G90 G94\nT1 M6\nG0 Z5\nM3 S800\nG1 X5 F2000\nG0 Z6\nT3 M6\nG1 X9 F2000\nG0 Z8\nM30\n");
    show_machine();
    EXPECT_THAT(run_refusal(), HasSubstr("returning from a tool change needs a verified position"));
    person.app().run("machine.trust_position");
    ASSERT_TRUE(person.live_until([&] {
        return person.refusal("inspector/job/machine_run").find("a verified position") == std::string::npos;
    }));
}

TEST_F(StartSheetAtGrbl, RunIsCheckedAgainOnceTheMacroIsRepaired) {
    const auto macro = person.folder() / "change.nc";
    auto& plan = person.app().view_state().manual.tool_changes[grbl.port()].plan;
    plan.way = drivers::ToolChangeWay::macro;
    plan.macro_file = macro.string();
    open("G21 G90 G94\nT1 M6\nG0 Z5\nM3 S800\nG1 X5 F2000\nG0 Z8\nM30\n");
    show_machine();
    EXPECT_THAT(run_refusal(), HasSubstr("change.nc"));
    write_file(macro, "G4 P0.1\n");
    ASSERT_TRUE(person.live_until(
        [&] { return person.refusal("inspector/job/machine_run").find("change.nc") == std::string::npos; }));
}

TEST_F(StartSheetAtGrbl, AProgramWithALineThatGrblCannotReadIsNotOfferedAndItsExtentsSaySo) {
    open("G21 G90 G94\nG1 X10 F600\nM66 P1\nG1 X30\nM2\n");
    show_machine();
    EXPECT_THAT(run_refusal(), HasSubstr("part.ngc:3:1: "));
    ask_all_the_same();
    const jobs::ProgramCheck& program_check = person.app().look().start_check->program_check;
    EXPECT_DOUBLE_EQ(program_check.ranges[0].max, 30.0);
    EXPECT_EQ(jobs::unread_text(program_check), "line 3");
    EXPECT_TRUE(person.sees("dialogs/start/unread"));
    person.keep("machine-start-unread");
}

TEST_F(StartSheetAtGrbl, AMachineThatIsGoneIsNotReplacedByAVirtualOne) {
    open(square);
    show_machine();
    person.click("inspector/job/machine_run");
    wait_for_check();
    person.app().connection().disconnect();
    ASSERT_TRUE(person.live_until([this] { return !person.app().look().connection.connected(); }));
    person.frames(2);
    EXPECT_THAT(person.refusal(start), HasSubstr("no longer connected"));
    person.press_key(render::Key::enter);
    person.frames(5);
    EXPECT_FALSE(has_job());
    person.wait_idle(); // what is worked out anew without a machine
    person.click("dialogs/start/start_cancel");
    EXPECT_FALSE(is_asked());
}

TEST_F(StartSheetAtGrbl, F9DoesNothingWhileSomethingElseIsAsked) {
    open(square);
    show_machine();
    person.press_key(render::Key::o, true);
    ASSERT_TRUE(person.sees("dialogs/files/entries"));
    person.press_key(render::Key::f9);
    person.frames(5);
    EXPECT_FALSE(person.app().view_state().start);
    EXPECT_FALSE(has_job());
}

} // namespace
} // namespace millwright::panels
