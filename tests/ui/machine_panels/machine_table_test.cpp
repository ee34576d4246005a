// A table that takes records and does not report its position, in the Machine workspace.
#include "core/base/files.h"
#include "tests/ui/person/at_machine.h"
#include "tests/ui/person/person.h"
#include "tests/ui/person/table_bench.h"
#include "ui/machine_panels/job_time_left.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <string>

namespace millwright::panels {
namespace {

using drivers::DriverState;
using test::Person;
using test::TableBench;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int program_lines = 40;

/// A row a line, from line 4 on: line n goes to Y n.
std::filesystem::path rows(const std::filesystem::path& folder) {
    std::string text = "G21 G90 G94 G17\nG0 Z5\nG1 Z-1 F3000\n";
    for (int n = 4; n < program_lines; ++n) {
        text += "X" + std::to_string(n % 2 == 0 ? 5 : 50) + " Y" + std::to_string(n) + "\n";
    }
    write_file(folder / "rows.ngc", text + "M2\n");
    return folder / "rows.ngc";
}

class MachineTable : public ::testing::Test {
protected:
    void connect() {
        person.open(rows(person.folder()));
        auto& choice = person.app().view_state().manual.choice;
        choice.driver = "records";
        choice.address = table.port();
        choice.record.emplace();
        choice.record->answer = "ok";
        test::connect(person);
    }
    [[nodiscard]] actions::FrameState now() { return person.app().look(); }
    [[nodiscard]] bool known() {
        const drivers::DriverStatus status = now().connection.status;
        return status.position_known && status.position_doubt.empty();
    }
    void begin_at(int line) {
        person.click("inspector/job/begin/on");
        person.fill_in("inspector/job/begin/line", std::to_string(line));
        person.wait_idle();
    }
    /// As it is read at the table.
    void say_where(const std::string& path, double x, double y, double z) {
        person.fill_in(path + "/X", std::to_string(x));
        person.fill_in(path + "/Y", std::to_string(y));
        person.fill_in(path + "/Z", std::to_string(z));
        person.click(path + "/there");
        ASSERT_TRUE(person.live_until([&] { return known(); }));
    }

    TableBench table{{.takes_time = true, .keep = true}};
    Person person{{1280, 1100}};
};

TEST_F(MachineTable, BeginsAtALineFromWhereAPersonSaysThatItStands) {
    connect();
    EXPECT_FALSE(known());
    EXPECT_TRUE(person.sees("hand/messages/stands/there"));
    begin_at(20);
    EXPECT_THAT(person.refusal("inspector/job/machine_run"), HasSubstr("does not report its position"));
    person.app().run("machine.run");
    person.frames(5);
    EXPECT_FALSE(now().job.running);
    EXPECT_EQ(table.records(), 0);
    person.keep("table-asks");

    say_where("inspector/job/begin/stands", 30.0, 33.0, -1.0);
    EXPECT_FALSE(person.sees("hand/messages/stands/there"));
    EXPECT_EQ(table.records(), 0); // nothing moves by that
    person.wait_idle();
    EXPECT_EQ(person.refusal("inspector/job/machine_run"), "");
    test::press_run(person);
    int first_line = program_lines;
    double most_left = 0.0;
    ASSERT_TRUE(person.live_until(
        [&] {
            const actions::FrameState shown = now();
            if (shown.job.running && shown.job.report) {
                first_line = std::min(first_line, shown.file_place().value().line);
                most_left = std::max(most_left, job_time_left(shown, *shown.job.report).value_or(0.0));
            }
            return shown.job.outcome.has_value();
        },
        60.0));
    EXPECT_EQ(now().job.outcome->end, jobs::JobEnd::done) << now().job.outcome->sentence;
    EXPECT_THAT(table.positions().front(), ElementsAre(30.0, 33.0, 5.0)); // up from there, before all else
    EXPECT_GE(first_line, 20);
    EXPECT_GT(most_left, 10.0) << "20 rows of 45 mm at 50 mm/s, of the job's own plan"; // it was 0 to the end
    EXPECT_DOUBLE_EQ(table.position()[1], program_lines - 1);
}

/// What is offered then is the line that comes next, not one that was cut before.
TEST_F(MachineTable, AJobThatBeganAtALineIsOfferedAgainFromWhereItStopped) {
    connect();
    say_where("hand/messages/stands", 0.0, 0.0, 5.0);
    begin_at(20);
    test::press_run(person);
    ASSERT_TRUE(person.live_until([&] { return table.position()[1] > 26.0; }, 60.0));
    person.app().run("machine.stop");
    ASSERT_TRUE(person.live_until([&] { return now().job.outcome.has_value(); }));
    const double row = table.position()[1];
    EXPECT_LT(row, program_lines - 1);
    person.frames(3);
    person.click("inspector/job/begin/on");
    person.frames(2);
    EXPECT_NEAR(now().view_state.start_at.line, row + 1.0, 1.0);
    person.keep("table-goes-on");
}

// It has no work offsets: a position that needs one went to it as if the offset were 0.
TEST_F(MachineTable, RunsNoProgramWhosePositionsNobodyCanKnow) {
    connect();
    const std::filesystem::path file = person.folder() / "down.ngc";
    write_file(file, "G21 G90\nG0 X9 Y9 Z20\nG1 Z10 F1000\nG53 G0 Z0\nM2\n");
    person.open(file);
    person.wait_idle();
    person.click("menu/workspaces/machine");
    person.frames(3);
    EXPECT_THAT(person.refusal("inspector/job/machine_run"), HasSubstr("G53 moves to a machine position"));
    EXPECT_EQ(now().opened->findings.size(), 1U);
}

TEST_F(MachineTable, BeginsNothingAfterAnEmergencyStopBeforeAPersonHasLooked) {
    connect();
    test::press_run(person);
    // Within a row: between two rows the table has answered, and its position is known.
    ASSERT_TRUE(person.live_until(
        [&] {
            const drivers::DriverStatus status = now().connection.status;
            return status.position[1] > 8.0 && status.sent_blocks > status.executed_blocks;
        },
        60.0));
    person.app().run("machine.emergency_stop");
    ASSERT_TRUE(person.live_until([&] { return now().job.outcome.has_value(); }));
    EXPECT_THAT(now().job.outcome->sentence, HasSubstr("had been sent, and it is not known how far"));
    ASSERT_TRUE(person.live_until([&] { return test::machine_is(person, DriverState::alarm); }));
    person.app().run("machine.reset");
    ASSERT_TRUE(person.live_until([&] { return test::machine_is(person, DriverState::idle); }));
    person.frames(3);
    EXPECT_THAT(person.refusal("inspector/job/machine_run"), HasSubstr("does not report its position"));
    person.keep("table-in-doubt");
    // The place before the row, which it would confirm, is not where the table is.
    EXPECT_FALSE(person.sees("hand/messages/machine_trust_position"));
    EXPECT_THAT(person.app().catalogue().find("machine.trust_position").permission(now()).reason,
                HasSubstr("does not report its position"));
    const auto at = table.position();
    say_where("hand/messages/stands", at[0], at[1], at[2]);
    person.frames(2);
    EXPECT_EQ(person.refusal("inspector/job/machine_run"), "");
}

/// As the system has it.
unsigned baud_of(const std::string& path) {
    const int handle = ::open(path.c_str(), O_RDWR | O_NOCTTY);
    termios settings{};
    EXPECT_EQ(::tcgetattr(handle, &settings), 0) << path;
    ::close(handle);
    switch (::cfgetospeed(&settings)) {
    case B9600:
        return 9600;
    case B19200:
        return 19200;
    default:
        return 0;
    }
}

TEST_F(MachineTable, IsConnectedToAtTheRateThatIsChosenInTheWindow) {
    person.open(rows(person.folder()));
    auto& choice = person.app().view_state().manual.choice;
    choice.driver = "records";
    choice.address = table.port();
    choice.record.emplace();
    choice.record->answer = "ok";
    person.app().run("view.machine");
    person.frames(3);
    person.click("inspector/connection/serial");
    person.frames(2);
    person.choose("inspector/connection/serial/rate", "19200");
    EXPECT_EQ(choice.address, table.port() + ",19200");
    person.choose("inspector/connection/serial/stop_bits", "two");
    EXPECT_EQ(choice.address, table.port() + ",19200,8N2");
    person.keep("table-serial-line");
    test::connect(person);
    EXPECT_EQ(baud_of(table.port()), 19200U);
    person.click("inspector/connection/machine_disconnect");
    ASSERT_TRUE(person.live_until([&] { return now().connection.link == actions::LinkState::none; }));
    person.choose("inspector/connection/serial/rate", "9600");
    test::connect(person);
    EXPECT_EQ(baud_of(table.port()), 9600U);
}

TEST_F(MachineTable, EndsItsRecordsAsIsChosenInTheWindow) {
    const std::filesystem::path sent = person.folder() / "sent.txt";
    std::string program = "G21 G90 G94 G17\nG0 Z5\nG1 Z4 F3000\n";
    for (int n = 1; n <= 12; ++n) {
        program += "X" + std::to_string(n) + "\n";
    }
    write_file(person.folder() / "short.ngc", program + "M2\n");
    person.open(person.folder() / "short.ngc");
    auto& choice = person.app().view_state().manual.choice;
    choice.driver = "records";
    choice.address = "file:" + sent.string();
    person.app().run("view.machine");
    person.frames(3);
    person.choose("inspector/connection/ending", "crlf");
    ASSERT_TRUE(choice.record);
    EXPECT_EQ(choice.record->ending, "\r\n");
    test::connect(person);
    if (!known()) {
        say_where("hand/messages/stands", 0.0, 0.0, 5.0);
    }
    person.wait_idle();
    test::press_run(person);
    ASSERT_TRUE(person.live_until([&] { return now().job.outcome.has_value(); }, 60.0));
    const std::string text = read_file(sent);
    EXPECT_GT(std::ranges::count(text, '\n'), 10);
    EXPECT_EQ(std::ranges::count(text, '\n'), std::ranges::count(text, '\r'));
    EXPECT_THAT(text, testing::EndsWith("\r\n"));
}

} // namespace
} // namespace millwright::panels
