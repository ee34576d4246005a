// Closed pipes, full disks and signals while a job runs: the machine is looked after and the log ends.
#include "tests/app/emulator.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <sstream>
#include <thread>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string back_and_forth(int lines) {
    std::string text = "G21 G90 G94\nG1 Z0 F3000\n";
    for (int n = 0; n < lines; ++n) {
        text += n % 2 == 0 ? "X10\n" : "X0\n";
    }
    return text + "M30\n";
}

/// The last record of the only log.
nlohmann::json end_of_log(const fs::path& folder) {
    nlohmann::json last;
    for (const auto& entry : fs::directory_iterator(folder)) {
        std::istringstream text(entry.path().extension() == ".jsonl" ? content_of(entry.path()) : "");
        for (std::string line; std::getline(text, line);) {
            last = nlohmann::json::parse(line);
        }
    }
    return last;
}

struct Streams : testing::Test {
    ScratchFolder scratch;
    std::string port = (scratch / "grbl").string();
    std::string file = (scratch / "way.ngc").string();
    std::string logs = (scratch / "logs").string();

    [[nodiscard]] std::vector<std::string> words() const {
        return {"send", file, "--driver", "grbl", "--port", port, "--log", logs};
    }
    /// Through a shell, with `redirection` behind the command.
    static Ended run_as(const std::string& redirection, const std::vector<std::string>& arguments) {
        return Program(arguments, {}, {"sh", "-c", "\"$0\" \"$@\" " + redirection}).end();
    }
};

TEST_F(Streams, APipeThatIsClosedDoesNotEndAJob) {
    write_content(file, back_and_forth(40));
    const Emulator emulator(port, {"--speed", "20"});
    EXPECT_NE(run_as("2>&1 | head -n 1", words()).out, "");
    EXPECT_EQ(end_of_log(logs).at("end"), "done");
}

TEST_F(Streams, ProgressThatCannotBePrintedDoesNotEndAJob) {
    write_content(file, back_and_forth(40));
    const Emulator emulator(port, {"--speed", "20"});
    for (const char* const lost : {"2>/dev/full", "2>&-"}) {
        const Ended ended = run_as(lost, words());
        EXPECT_EQ(ended.exit_code, 0) << lost;
        EXPECT_THAT(ended.out, HasSubstr("All 43 blocks were executed")) << lost;
        EXPECT_EQ(end_of_log(logs).at("end"), "done") << lost;
    }
}

TEST_F(Streams, NoLogGetsTheNumberOfAStreamThatIsClosed) {
    write_content(file, back_and_forth(40));
    const Emulator emulator(port, {"--speed", "20"});
    EXPECT_EQ(run_as("<&- >&- 2>&-", words()).exit_code, 1);
    EXPECT_EQ(end_of_log(logs).at("end"), "done"); // every line of it is JSON
}

TEST_F(Streams, AJobWhoseOutputIsLostComesToItsEndAndFails) {
    write_content(file, back_and_forth(40));
    const Emulator emulator(port, {"--speed", "20"});
    const Ended ended = run_as(">/dev/full", words());
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("standard output could not be written: No space left on device"));
    EXPECT_EQ(end_of_log(logs).at("end"), "done");
}

TEST_F(Streams, NobodyIsAskedWhereTheQuestionCannotBeRead) {
    write_content(file, back_and_forth(4));
    const Emulator emulator(port, {"--speed", "20"});
    auto twice = words();
    twice.insert(twice.begin() + 1, file);
    const Ended ended = Program(twice, "y\n", {"sh", "-c", "\"$0\" \"$@\" >/dev/full"}).end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("cannot ask for input"));
    EXPECT_FALSE(fs::exists(fs::path(logs) / "way-0002.jsonl")) << "its start was not confirmed";
}

TEST_F(Streams, HelpThatCannotBePrintedFails) {
    for (const char* const option : {"--help", "--version"}) {
        const Ended ended = run_as(">/dev/full", {option});
        EXPECT_EQ(ended.exit_code, 1) << option;
        EXPECT_THAT(ended.err, HasSubstr("No space left on device")) << option;
    }
    const Ended limited =
        Program({"--help"}, {}, {"sh", "-c", "ulimit -f 1; \"$0\" \"$@\" >" + (scratch / "help").string()})
            .end();
    EXPECT_EQ(limited.exit_code, 1);
    EXPECT_THAT(limited.err, HasSubstr("File too large"));
}

TEST_F(Streams, EverySignalThatEndsAProgramStopsTheMachineAndEndsTheLog) {
    write_content(file, back_and_forth(4000));
    for (const int signal : {SIGINT,
                             SIGTERM,
                             SIGHUP,
                             SIGQUIT,
                             SIGUSR1,
                             SIGUSR2,
                             SIGALRM,
                             SIGXCPU,
                             SIGPWR,
                             SIGSTKFLT,
                             SIGRTMIN}) {
        fs::remove_all(logs);
        Emulator emulator(port, {"--speed", "5"});
        Program sender(words());
        sender.wait_for_error_text("Block ");
        sender.send(signal);
        EXPECT_EQ(sender.end().exit_code, 1) << signal;
        EXPECT_EQ(end_of_log(logs).at("end"), "cancelled") << signal;
        (void)emulator.stop();
    }
}

TEST_F(Streams, ASecondCtrlCIsAnEmergencyStopWhoseLogEnds) {
    write_content(file, back_and_forth(4000));
    // Braking takes this controller several seconds.
    const Emulator emulator(port, {"--speed", "0.1"});
    Program sender(words());
    sender.wait_for_error_text("Block ");
    sender.send(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    sender.send(SIGINT);
    EXPECT_EQ(sender.end().exit_code, 1);
    EXPECT_TRUE(end_of_log(logs).contains("end"));
}

TEST_F(Streams, AJobIsNotSuspended) {
    write_content(file, back_and_forth(4000));
    const Emulator emulator(port, {"--speed", "5"});
    Program sender(words());
    sender.wait_for_error_text("Block ");
    sender.send(SIGTSTP);
    sender.wait_for_error_text("not suspended while it supervises a machine");
    sender.send(SIGINT);
    EXPECT_EQ(sender.end().exit_code, 1);
    EXPECT_EQ(end_of_log(logs).at("end"), "cancelled");
}

TEST_F(Streams, NohupOutlivesItsTerminal) {
    write_content(file, back_and_forth(200));
    const Emulator emulator(port, {"--speed", "20"});
    Program sender(words(), {}, {"nohup"});
    sender.wait_for_error_text("Block ");
    sender.send(SIGHUP);
    EXPECT_EQ(sender.end().exit_code, 0);
    EXPECT_EQ(end_of_log(logs).at("end"), "done");
}

} // namespace
} // namespace millwright::test
