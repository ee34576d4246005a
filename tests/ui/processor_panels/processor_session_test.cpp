// The recorded session of docs/user/processor.md: what a person does in the Processor workspace, played with
// mouse and keys, and what the workspace shows behind each step, compared with the record.
#include "core/base/files.h"
#include "core/base/units.h"
#include "tests/ui/person/person.h"
#include "ui/workspaces/processor_workspace.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace millwright::panels {
namespace {

using actions::ProcessorWorkspace;
using test::Person;

constexpr const char* record = "docs/user/processor-session.txt";

/// What is left to turn in the pass that is under way, as its drawing says it.
std::string left(const cordic::IterationTrace& trace) {
    return trace.points.empty() ? "-"
                                : fmt::format("{:.2e} deg", to_degrees(trace.points.back().angle_error));
}

std::string shown_state(const ProcessorWorkspace& workspace) {
    const cordic::Debugger& debugger = workspace.debugger();
    const cordic::ProcessorState& state = debugger.state();
    const auto row = workspace.code_row();
    return fmt::format(
        "clock {} | line {} | {} | micro {:02x} {} | x {:.6g} y {:.6g} z {:.3g} | left {} | points {}",
        state.clocks.total,
        debugger.line(),
        row < 0 ? "-" : workspace.code()[static_cast<std::size_t>(row)].text,
        state.sequencer.address,
        to_text(state.pipeline.op),
        debugger.processor().number(state.path.x),
        debugger.processor().number(state.path.y),
        debugger.processor().number(state.path.z),
        left(debugger.iterations()),
        debugger.processor().published().size());
}

/// "click PATH [TIMES]", "row PATH N" (the N-th line of a listing), "wait" (until it stands), "picture NAME".
void act(Person& person, const std::string& line) {
    std::istringstream words(line);
    std::string verb;
    std::string path;
    int number = 1;
    words >> verb >> path >> number;
    if (verb == "click") {
        for (int n = 0; n < number; ++n) {
            person.click(path);
        }
    } else if (verb == "row") {
        const widgets::Rect lines = person.place(path);
        const float height = person.desktop().ui().px(19.0F);
        person.click_at({lines.x + 0.4F * lines.w, lines.y + (static_cast<float>(number) - 0.5F) * height});
    } else if (verb == "wait") {
        EXPECT_TRUE(person.live_until([&] { return !person.app().look().processor.running(); })) << line;
    } else if (verb == "picture") {
        person.hover({5.0F, 990.0F});
        person.keep(path);
    } else {
        ADD_FAILURE() << "unknown step: " << line;
    }
    person.frames();
}

TEST(ProcessorSession, GoesAsItWasRecorded) {
    Person person({1600, 1000});
    person.press_key(render::Key::f7);
    person.frames(3);
    std::istringstream lines(read_file(record));
    std::string played;
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] == '#' || line[0] == ' ') {
            played += line[0] == ' ' ? "" : line + "\n";
            continue;
        }
        act(person, line);
        played += line + "\n    " + shown_state(person.app().look().processor) + "\n";
    }
    EXPECT_EQ(played, read_file(record)) << "what was played now:\n" << played;
}

} // namespace
} // namespace millwright::panels
