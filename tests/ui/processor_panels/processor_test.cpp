// The Processor workspace with real mouse and keys in real OpenGL: stepping the thesis's arc.
#include "core/base/numbers.h"
#include "tests/ui/person/person.h"
#include "ui/window/window.h"
#include "ui/workspaces/processor_workspace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

namespace millwright::panels {
namespace {

using actions::ProcessorWorkspace;
using actions::Workspace;
using test::Person;

/// A person who has come to the workspace by its key.
struct ProcessorWorkspacePerson {
    explicit ProcessorWorkspacePerson(const render::PixelSize& screen = {1280, 800}) : person(screen) {
        person.press_key(render::Key::f7);
        person.frames(3);
    }
    [[nodiscard]] const ProcessorWorkspace& processor() { return person.app().look().processor; }
    [[nodiscard]] const cordic::ProcessorState& state() { return processor().debugger().state(); }

    Person person;
};

TEST(ProcessorWorkspace, OpensByItsKeyWithTheThesissArcAndShowsEveryPart) {
    ProcessorWorkspacePerson bench;
    EXPECT_EQ(bench.person.app().view_state().workspace, Workspace::processor);
    EXPECT_EQ(bench.processor().name(), "thesis-arc.ngc");
    for (const char* path : {"view/diagram",
                             "view/blocks/sequencer",
                             "code/instructions",
                             "timeline/processor_run",
                             "inspector/registers/XI",
                             "lower/vector",
                             "lower/path",
                             "lower/map"}) {
        EXPECT_TRUE(bench.person.sees(path)) << path;
    }
    EXPECT_GT(bench.processor().differences().size(), 10U);
    bench.person.keep("processor-reset");
}

TEST(ProcessorWorkspace, StepsByClockMicroInstructionInstructionAndBlock) {
    ProcessorWorkspacePerson bench;
    Person& person = bench.person;
    person.click("timeline/processor_clock");
    EXPECT_EQ(bench.state().clocks.total, 1);
    person.click("timeline/processor_instruction");
    EXPECT_EQ(bench.state().instructions, 1);
    EXPECT_TRUE(person.sees("inspector/registers/Vmax_changed"));
    EXPECT_FALSE(person.sees("inspector/registers/Dz_changed"));
    person.click("timeline/processor_micro");
    EXPECT_EQ(bench.state().sequencer.address, 1); // from the fetch to its second word
    const int line = bench.processor().debugger().line();
    person.click("timeline/processor_block");
    EXPECT_NE(bench.processor().debugger().line(), line);
    person.click("timeline/processor_set_point");
    EXPECT_GT(bench.processor().debugger().processor().published().size(), 0U);
    person.press_key(render::Key::digit_1, true);
    person.frames();
    EXPECT_TRUE(person.sees("inspector/registers/PC") || person.sees("inspector/registers/PC_changed"));
    person.click("timeline/processor_reset");
    EXPECT_EQ(bench.state().clocks.total, 0);
}

// To the middle of a rotation, clock by clock.
TEST(ProcessorWorkspace, ShowsTheVectorConvergingStepByStep) {
    ProcessorWorkspacePerson bench({1600, 1000});
    Person& person = bench.person;
    for (int n = 0; n < 20; ++n) {
        person.click("timeline/processor_set_point");
    }
    for (int n = 0; n < 12; ++n) {
        person.click("timeline/processor_clock");
    }
    const cordic::IterationTrace trace = bench.processor().debugger().iterations();
    ASSERT_GT(trace.points.size(), 4U);
    EXPECT_EQ(trace.mode, cordic::Mode::rotation);
    EXPECT_LT(trace.points.back().angle_error, trace.points.front().angle_error);
    EXPECT_TRUE(person.sees("lower/errors"));
    const widgets::Rect tool = person.place("lower/tool");
    person.click("timeline/processor_set_point");
    person.frames();
    const widgets::Rect moved = person.place("lower/tool");
    EXPECT_TRUE(std::abs(moved.x - tool.x) + std::abs(moved.y - tool.y) > 0.0F); // in step with the processor
    for (int n = 0; n < 12; ++n) {
        person.click("timeline/processor_clock");
    }
    person.hover({5.0F, 990.0F});
    person.keep("processor-vector");
}

TEST(ProcessorWorkspace, StopsAtABreakpointThatIsClickedInTheListing) {
    ProcessorWorkspacePerson bench;
    Person& person = bench.person;
    person.click("code/tabs/microprogram");
    person.frames();
    const widgets::Rect lines = person.place("code/microprogram");
    person.click_at({lines.x + 0.5F * lines.w, lines.y + 66.0F});
    ASSERT_EQ(bench.processor().debugger().micro_breakpoints().size(), 1U);
    const auto address = *bench.processor().debugger().micro_breakpoints().begin();
    EXPECT_NE(address, 0);
    person.click("timeline/speed/full");
    person.click("timeline/processor_run");
    EXPECT_TRUE(person.live_until([&] { return !bench.processor().running(); }));
    EXPECT_EQ(bench.processor().halt(), cordic::Halt::breakpoint);
    EXPECT_EQ(bench.state().sequencer.address, address);
    person.keep("processor-breakpoint");
    person.click_at({lines.x + 0.5F * lines.w, lines.y + 66.0F});
    EXPECT_TRUE(bench.processor().debugger().micro_breakpoints().empty());
    person.click("timeline/processor_run");
    EXPECT_TRUE(person.live_until([&] { return !bench.processor().running(); }));
    EXPECT_EQ(bench.state().stop, cordic::Stop::halted);
    EXPECT_FALSE(person.refusal("timeline/processor_clock").empty());
}

TEST(ProcessorWorkspace, RunsToABreakpointOfAnInstruction) {
    ProcessorWorkspacePerson bench;
    Person& person = bench.person;
    const widgets::Rect lines = person.place("code/instructions");
    person.click_at({lines.x + 0.5F * lines.w, lines.y + 60.0F});
    ASSERT_EQ(bench.processor().debugger().breakpoints().size(), 1U);
    const auto address = *bench.processor().debugger().breakpoints().begin();
    person.click("timeline/speed/full");
    person.click("timeline/processor_run");
    EXPECT_TRUE(person.live_until([&] { return !bench.processor().running(); }));
    EXPECT_EQ(bench.processor().debugger().instruction(), address);
}

TEST(ProcessorWorkspace, RunsToALineThatIsClicked) {
    ProcessorWorkspacePerson bench;
    Person& person = bench.person;
    person.click("code/click/run_to");
    const widgets::Rect lines = person.place("code/instructions");
    person.click_at({lines.x + 0.5F * lines.w, lines.y + 60.0F});
    const auto there = bench.processor().code()[3].address;
    EXPECT_EQ(bench.processor().debugger().instruction(), there);
    EXPECT_TRUE(bench.processor().debugger().breakpoints().empty());
    person.click("code/tabs/program");
    person.frames();
    const int line = bench.processor().debugger().line();
    const widgets::Rect program = person.place("code/program");
    person.click_at({program.x + 0.5F * program.w, program.y + 89.0F}); // the fifth line, the arc
    EXPECT_NE(bench.processor().debugger().line(), line);
    EXPECT_EQ(bench.processor().debugger().line(), 5);
}

TEST(ProcessorWorkspace, HasTheDirectionAndTheSignOfZeroOfTheThesisAsSwitches) {
    ProcessorWorkspacePerson bench;
    Person& person = bench.person;
    // The arc begins at (10, 10), about (5, 10).
    const auto first_of_arc = [&] { return bench.processor().differences()[1]; };
    const double ours = bench.processor().report().position_error;
    EXPECT_GT(first_of_arc().y, 10.1) << "G03 is counter-clockwise";
    person.click("inspector/format/thesis_direction");
    person.frames();
    EXPECT_LT(first_of_arc().y, 9.9);
    EXPECT_LT(bench.processor().report().position_error, 1e-4) // mm
        << "beside exact arithmetic that turns this way";
    person.click("inspector/format/thesis_direction");
    person.frames();
    EXPECT_EQ(bench.processor().report().position_error, ours);
    person.app().run("processor.thesis_path"); // whose first line goes along X
    person.frames();
    EXPECT_LT(bench.processor().report().speed_error, 0.01);
    person.click("inspector/format/matlab_zero");
    person.frames();
    EXPECT_NEAR(bench.processor().report().speed_error, 0.216, 1e-3);
}

TEST(ProcessorWorkspace, ShowsTheErrorOfFormatAndIterationsAtOnce) {
    ProcessorWorkspacePerson bench;
    Person& person = bench.person;
    const double thesis = bench.processor().report().position_error;
    person.click("inspector/format/classic");
    person.frames();
    const widgets::Rect steps = person.place("inspector/format/iterations");
    person.drag({steps.x + 0.5F * steps.w, steps.y + 0.5F * steps.h},
                {steps.x + 0.12F * steps.w, steps.y + 0.5F * steps.h});
    const int few = bench.processor().choice().iterations;
    EXPECT_LT(few, 15);
    EXPECT_GT(bench.processor().report().position_error, 10.0 * thesis);
    person.keep("processor-few-iterations");
    person.click("inspector/format/kind/fixed");
    person.frames();
    const widgets::Rect bits = person.place("inspector/format/fraction");
    person.drag({bits.x + 0.5F * bits.w, bits.y + 0.5F * bits.h},
                {bits.x + 0.2F * bits.w, bits.y + 0.5F * bits.h});
    EXPECT_EQ(bench.processor().choice().format.kind, cordic::NumberKind::fixed);
    EXPECT_LT(bench.processor().choice().format.fraction_bits, 22);
    EXPECT_TRUE(person.sees("inspector/errors/position"));
}

TEST(ProcessorWorkspace, TellsTheWordOfItsBitsAndKeepsItAWord) {
    ProcessorWorkspacePerson bench;
    Person& person = bench.person;
    EXPECT_FALSE(person.sees("inspector/format/word"));
    person.click("inspector/format/kind/fixed");
    person.frames();
    EXPECT_TRUE(person.sees("inspector/format/word"));
    const auto drag = [&](const std::string& slider, float share) {
        person.bring_into_sight(slider);
        const widgets::Rect at = person.place(slider);
        person.drag(at.centre(), {at.x + share * at.w, at.centre().y});
    };
    const auto format = [&] { return bench.processor().choice().format; };
    drag("inspector/format/integer", 0.0F);
    EXPECT_EQ(format().integer_bits, 1);
    drag("inspector/format/fraction", 0.0F); // to 0, were there not 8 bits at least
    EXPECT_EQ(format().word(), cordic::least_word);
    EXPECT_EQ(format().fraction_bits, 7);
    drag("inspector/format/integer", 0.83F); // its end
    EXPECT_EQ(format().integer_bits, 32);
    drag("inspector/format/fraction", 0.83F); // to 62, were there not 64 bits at most
    EXPECT_EQ(format().word(), cordic::largest_word);
    EXPECT_EQ(to_text(format()), "q32.32");
    person.keep("processor-word");
}

// In the smallest window and in a large one, without any scrolling.
TEST(ProcessorWorkspace, HasAllRegistersInSight) {
    for (const render::PixelSize& screen : {render::PixelSize{1280, 800}, render::PixelSize{1600, 1000}}) {
        ProcessorWorkspacePerson bench(screen);
        Person& person = bench.person;
        for (const char* kind : {"f32", "f64", "fixed"}) {
            person.click(std::string("inspector/format/kind/") + kind);
            person.click("timeline/processor_set_point");
            person.hover({5.0F, 5.0F});
            int seen = 0;
            for (const auto& [path, at] : person.desktop().ui().places().all()) {
                const bool is_register =
                    path.starts_with("inspector/registers/") && at.rect.h > 0.0F && at.visible;
                seen += is_register ? 1 : 0;
            }
            EXPECT_EQ(seen, cordic::register_count) << kind;
            const auto visible = [&](const char* path) {
                return person.desktop().ui().places().find(path)->visible;
            };
            EXPECT_TRUE(visible("inspector/errors/position")) << kind; // beside what changes it
            EXPECT_TRUE(visible("inspector/format/iterations")) << kind;
        }
        person.keep(screen.width == 1280 ? "processor-registers-small" : "processor-registers");
    }
}

// In fixed point a rotation ends at exactly nothing.
TEST(ProcessorWorkspace, MarksStepsThatLeaveNothingToTurn) {
    ProcessorWorkspacePerson bench;
    Person& person = bench.person;
    person.click("inspector/format/kind/fixed");
    EXPECT_FALSE(person.sees("lower/errors/zeros"));
    person.click("timeline/processor_set_point");
    const auto trace = bench.processor().debugger().iterations();
    ASSERT_TRUE(std::ranges::any_of(trace.points, [](const cordic::IterationPoint& point) {
        return !point.corrects && exactly_equal(point.angle_error, 0.0);
    }));
    person.frames(2);
    EXPECT_TRUE(person.sees("lower/errors/zeros"));
    person.keep("processor-zeros");
}

TEST(ProcessorWorkspace, ShowsWhatComesTooLateAtASlowerClock) {
    ProcessorWorkspacePerson bench({1600, 1000});
    Person& person = bench.person;
    EXPECT_TRUE(bench.processor().report().late.empty());
    person.click("inspector/registers"); // folded away, so that all of the next section is in sight
    person.click("inspector/times/clock");
    person.type("0.6"); // kHz: a chord takes 0.2 s to compute, and 0.4 s at 30 mm/min
    person.press_key(render::Key::enter);
    person.frames(2);
    EXPECT_NEAR(bench.processor().choice().clock_hz, 600.0, 1e-9);
    EXPECT_EQ(bench.processor().report().late.size(), 1U); // the rapid before it is faster
    person.click("inspector/times/clock");
    person.type("0.05"); // 2.4 s
    person.press_key(render::Key::enter);
    person.frames(2);
    EXPECT_EQ(bench.processor().report().late.size(), bench.processor().differences().size() - 1);
    EXPECT_TRUE(person.sees("inspector/times/late"));
    person.click("inspector/times/needle");
    person.type("50");
    person.press_key(render::Key::enter);
    person.frames(2);
    EXPECT_NEAR(bench.processor().choice().needle_rpm, 50.0, 1e-9);
    EXPECT_GT(bench.processor().sewing().late.size(), 0U);
    person.keep("processor-late");
}

TEST(ProcessorWorkspace, ComputesOnePassInEachSystem) {
    ProcessorWorkspacePerson bench({1600, 1000});
    Person& person = bench.person;
    const auto shows = [&](const char* path) {
        person.frames(2);
        return person.desktop().ui().places().find(path) != nullptr;
    };
    const auto type = [&](const char* field, const char* text) {
        person.click(field);
        person.type(text);
        person.press_key(render::Key::enter);
        person.frames(2);
    };
    person.click("inspector/registers"); // folded away
    EXPECT_TRUE(shows("inspector/pass/x_out"));
    EXPECT_FALSE(shows("inspector/pass/range"));
    type("inspector/pass/z", "1.8"); // beyond 1.70857 rad
    EXPECT_TRUE(shows("inspector/pass/x_out"));
    EXPECT_TRUE(shows("inspector/pass/range"));
    person.choose("inspector/pass/system", "hyperbolic"); // whose range is 1.83745
    EXPECT_TRUE(shows("inspector/pass/x_out"));
    EXPECT_FALSE(person.refusal("inspector/pass/folds").empty());
    person.bring_into_sight("inspector/pass/left");
    person.keep("processor-pass");
    person.click("inspector/pass/mode/vectoring");
    EXPECT_TRUE(shows("inspector/pass/x_out"));
    type("inspector/pass/y", "0.96"); // beyond 0.95055
    EXPECT_FALSE(shows("inspector/pass/x_out"));
    person.choose("inspector/pass/system", "linear");
    EXPECT_TRUE(shows("inspector/pass/x_out"));
}

TEST(ProcessorWorkspace, SaysWhyAProgramIsNotForIt) {
    ProcessorWorkspacePerson bench;
    bench.person.app().run("processor.project"); // the dome needs five axes
    bench.person.frames(3);
    ASSERT_TRUE(bench.processor().failure().has_value());
    EXPECT_NE(bench.processor().failure()->message.find("no axis"), std::string::npos);
    EXPECT_FALSE(bench.person.refusal("timeline/processor_run").empty());
    bench.person.click("code/tabs/program");
    bench.person.keep("processor-refused");
}

// In every micro-instruction of lines and arcs, whose signals the diagram tells, and in the widest words.
TEST(ProcessorWorkspace, CutsNoTextAtTheSmallestWindow) {
    ProcessorWorkspacePerson bench;
    Person& person = bench.person;
    std::set<std::string> cut;
    const auto look = [&] {
        person.frames();
        const auto texts = person.desktop().ui().cut_texts();
        cut.insert(texts.begin(), texts.end());
    };
    for (const char* last : {"pipeline_line_1", "sequencer_line_2", "first_line_3", "registers_line_6"}) {
        EXPECT_TRUE(person.sees(std::string("view/blocks/") + last)) << last;
    }
    std::set<std::uint8_t> seen;
    for (int n = 0; n < 400 && bench.processor().debugger().line() < 6; ++n) {
        person.app().run("processor.micro");
        if (seen.insert(bench.state().sequencer.address).second) {
            look();
        }
    }
    EXPECT_GT(seen.size(), 20U);
    for (const char* kind : {"f64", "fixed"}) {
        person.click(std::string("inspector/format/kind/") + kind);
        person.click("timeline/processor_set_point");
        person.click("timeline/processor_set_point");
        look();
    }
    for (const std::string& text : cut) {
        ADD_FAILURE() << text;
    }
}

} // namespace
} // namespace millwright::panels
