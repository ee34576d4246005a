// A G-code file and the machine that executes it: every axis in step with the cursor, bodies and figures
// alike.
#include "core/base/files.h"
#include "core/base/units.h"
#include "tests/ui/person/person.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace millwright::panels {
namespace {

using actions::Workspace;
using test::Person;

constexpr const char* five_axes = "G21 G90 G94\n"
                                  "G0 X0 Y0 Z50 A0 C0\n"
                                  "G1 X10 Y5 A-20 C30 F1000\n"
                                  "X30 Z60 A-40 C-60\n"
                                  "M2\n";

void open_for(Person& person, const std::string& machine, const std::string& text) {
    const auto file = person.folder() / "part.ngc";
    write_file(file, text);
    person.app().view_state().file.reading.machine = machine;
    person.open(file);
    ASSERT_TRUE(person.app().look().opened->errors.empty());
}

/// To the beginning of `line` (from 1).
void stand_at(Person& person, int line) {
    const auto& opened = *person.app().look().opened;
    person.app().view_state().playback.time =
        actions::time_of(opened, opened.execution->step_at_or_after(line));
    person.frames(3);
}

std::vector<double> axes(Person& person) {
    const auto now = person.app().look();
    const auto moment = now.moment();
    std::vector<double> values;
    for (int n = 0; moment && n < moment->axes.size(); ++n) {
        const bool turns = now.machine()->axis(n).kind == kinematics::AxisKind::rotary;
        values.push_back(turns ? to_degrees(moment->axes[n]) : moment->axes[n]);
    }
    return values;
}

void expect_axes(Person& person, const std::vector<double>& wanted, double within) {
    const std::vector<double> found = axes(person);
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t n = 0; n < wanted.size(); ++n) {
        EXPECT_NEAR(found[n], wanted[n], within) << "axis " << n;
    }
}

TEST(ProgramOnItsMachine, ShowsEveryAxisWhereTheCursorIs) {
    Person person;
    open_for(person, "ac-table", five_axes);
    stand_at(person, 4);
    expect_axes(person, {10.0, 5.0, 50.0, -20.0, 30.0}, 1e-6);
    person.app().view_state().playback.time = person.app().look().duration();
    person.frames(3);
    expect_axes(person, {30.0, 5.0, 60.0, -40.0, -60.0}, 1e-6);
    for (const char* axis : {"X", "Y", "Z", "A", "C"}) {
        EXPECT_TRUE(person.sees(std::string("inspector/position/axes/") + axis)) << axis;
    }
}

// It held at the M6, and only the word "holding" was seen.
TEST(ProgramOnItsMachine, SaysForWhichToolASimulatedJobWaits) {
    Person person;
    open_for(person, "router-xyz", "G21 G90 G94\nT3 M6 (6 mm end mill)\nG0 X5\nM2\n");
    person.app().run("view.machine");
    person.frames(3);
    EXPECT_FALSE(person.sees("inspector/job/waiting"));
    person.app().run("machine.run");
    ASSERT_TRUE(person.live_until([&] { return person.sees("inspector/job/waiting"); }));
    person.keep("waits-for-tool");
    person.click("inspector/job/machine_resume");
    EXPECT_TRUE(person.live_until([&] { return !person.app().look().job.running; }));
    EXPECT_FALSE(person.sees("inspector/job/waiting"));
}

TEST(ProgramOnItsMachine, MovesTheBodiesWithTheCursor) {
    Person person;
    open_for(person, "ac-table", five_axes);
    auto& layers = person.app().view_state().layers_now();
    layers = {};
    layers.design.surface = layers.floor = layers.origin = false;
    layers.machine.bodies = true;
    fit_program(person.app().view_state());
    stand_at(person, 3);
    const render::Picture before = person.picture_of("view/iso");
    person.keep("program-machine");
    stand_at(person, 4);
    EXPECT_GT(render::difference(before, person.picture_of("view/iso"), 0).fraction,
              0.005); // the table turned, the column went sideways
    stand_at(person, 3);
    EXPECT_EQ(person.picture_of("view/iso"), before);

    person.app().run("view.machine");
    person.frames(4);
    EXPECT_TRUE(person.sees("hand/position/axes/C"));
    person.keep("program-machine-workspace");
}

TEST(ProgramOnItsMachine, KnowsTheAxesOfLongProgramsWithoutRotaryAxes) {
    Person person;
    std::string text = "G21 G90 G1 F3000\n";
    const auto count = static_cast<int>(plan::most_planned_points) + 10;
    for (int n = 0; n < count; ++n) {
        fmt::format_to(std::back_inserter(text), "X{:.3f} Y{:.2f}\n", 0.1 * (n % 1000), 0.01 * (n / 1000));
    }
    open_for(person, "router-xyz", text + "M2\n");
    ASSERT_FALSE(person.app().look().opened->motion);
    constexpr int line = 123'457; // stands at the end of the line before, which is move number line - 3
    stand_at(person, line);
    const int n = line - 3;
    expect_axes(person, {0.1 * (n % 1000), 0.01 * (n / 1000), 0.0}, 1e-2);
    EXPECT_TRUE(person.sees("inspector/position/axes/X"));
    open_for(person, "ac-table", text + "M2\n");
    EXPECT_TRUE(axes(person).empty()); // the positions of its tables are not stored
}

TEST(ProgramOnItsMachine, ShowsTheConnectedMachineInTheMachineWorkspace) {
    Person person;
    open_for(person, "ac-table", five_axes);
    person.app().run("view.machine");
    person.frames(2);
    person.app().run("machine.connect");
    ASSERT_TRUE(person.live_until([&] { return person.app().look().connection.connected(); }));
    person.app().connection().tell(
        [](drivers::Driver& driver) { (void)driver.command("G21 G90 G0 X12 Z34 A-7"); });
    ASSERT_TRUE(person.live_until([&] {
        const auto found = axes(person);
        return found.size() == 5 && std::abs(found[3] + 7.0) < 1e-6 && std::abs(found[2] - 34.0) < 1e-6;
    }));
    expect_axes(person, {12.0, 0.0, 34.0, -7.0, 0.0}, 1e-6);
    EXPECT_TRUE(person.app().look().at_machine());
    person.keep("machine-connected-file");
    person.app().run("view.program"); // there the cursor is shown
    person.app().view_state().playback.time = 0.0;
    person.frames(3);
    expect_axes(person, {0.0, 0.0, 0.0, 0.0, 0.0}, 1e-6);
}

} // namespace
} // namespace millwright::panels
