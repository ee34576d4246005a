#include "tests/app/emulator.h"
#include "tests/app/sending.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <sstream>
#include <utility>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string zigzag(int lines) {
    std::string text = "G21 G90 G94\nG1 Z0 F3000\n";
    for (int n = 0; n < lines; ++n) {
        text += "X" + std::to_string(n % 2 == 0 ? 10 : 0) + " Y" + std::to_string(n % 200) + "\n";
    }
    return text + "M30\n";
}

TEST_F(Send, LetsGrblReadAProgramBeforeItRuns) {
    const std::string good = "G21 G90\nG0 X3\nG1 X10 F3000\nM30\n";
    write_content(file, good);
    Emulator emulator(port, {"--speed", "20"});
    const auto with = [this](std::vector<std::string> more) {
        std::vector<std::string> all = words();
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    };
    const Ended read = with({"--check-only"});
    EXPECT_EQ(read.exit_code, 0) << read.err;
    EXPECT_THAT(read.out, HasSubstr("Grbl read 4 lines in check mode without errors"));
    EXPECT_TRUE(last_record(logs).is_null()) << "no job was done";
    const Ended checked = with({"--check"});
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
    EXPECT_THAT(checked.out, HasSubstr("All 4 blocks were executed"));

    write_content(file, "G21 G90\nM6 T1\nG1 X10 F3000\nM30\n");
    const Ended refused = with({"--check"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("line 2: error 20"));
    EXPECT_THAT(with({"--check", "--trace-box"}).err, HasSubstr("--trace-box does not run a program"));
    EXPECT_EQ(with({"--check-only", "--continue"}).exit_code, 2);
    (void)emulator.stop();
}

TEST_F(Send, TracesTheBoxOfTheCuts) {
    write_content(file, "G21 G90 F3000\nG0 Z4\nG0 X40 Y40\nG1 X10 Y5\nG2 X20 I5 J0\nG0 X0 Y0\nM30\n");
    Emulator emulator(port, {"--speed", "20"});
    std::vector<std::string> trace = words();
    trace.emplace_back("--trace-box");
    const Ended ended = run(trace);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    std::string text;
    for (const auto& entry : fs::directory_iterator(logs)) {
        text += entry.path().extension() == ".ngc" || entry.path().extension() == ".jsonl"
                    ? content_of(entry.path())
                    : "";
    }
    EXPECT_THAT(text, HasSubstr("the box of "));
    EXPECT_EQ(ended.err.find("spindle"), std::string::npos) << "it is off on purpose\n" << ended.err;
    EXPECT_EQ(last_record(logs).at("end"), "done");
    EXPECT_DOUBLE_EQ(last_record(logs).at("position").at(2).get<double>(), 4.0);
    (void)emulator.stop();
}

TEST_F(Send, SendsAFileToAnEmulatedController) {
    write_content(file, zigzag(20));
    Emulator emulator(port, {"--speed", "20", "--line-numbers"});
    const Ended ended = run(words());
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("Connected to Grbl 1.1h"));
    EXPECT_THAT(ended.out, HasSubstr("All 23 blocks were executed"));
    EXPECT_EQ(last_record(logs).at("end"), "done");
    const Ended emulated = emulator.stop();
    EXPECT_EQ(emulated.exit_code, 0);
    EXPECT_THAT(emulated.out, HasSubstr("Grbl 1.1h at " + port));
    EXPECT_FALSE(fs::is_symlink(port));
}

TEST_F(Send, SendsFiveAxesToOtherFirmwareAndNamesIt) {
    write_content(file, "G21 G90 G94\nG1 X10 A90 B-45 F3000\nX0 A0 B0\nM30\n");
    for (const auto& [firmware, name] :
         {std::pair("grblhal", "grblHAL 1.1f"), std::pair("fluidnc", "FluidNC v3.7.12")}) {
        Emulator emulator(port, {"--firmware", firmware, "--axes", "XYZAB", "--speed", "20"});
        const Ended ended = run(words());
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_THAT(ended.out, HasSubstr(std::string("Connected to ") + name));
        EXPECT_THAT(ended.out, HasSubstr("All 4 blocks were executed"));
        EXPECT_THAT(emulator.stop().out, HasSubstr(std::string(name) + " at " + port));
    }
    Emulator three(port, {"--firmware", "grblhal", "--speed", "20"});
    const Ended refused = run(words());
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err,
                HasSubstr("zigzag.ngc:2: the program moves A and B, but the machine has only X, Y and Z"));
}

TEST_F(Send, ObeysKeysWhileItRuns) {
    write_content(file, "G21 G90 F3000\nG1 X10\nM0\nG1 X0\nM30\n");
    Emulator emulator(port, {"--speed", "20"});
    auto listening = words();
    listening.emplace_back("--keys");
    Program sender(listening);
    sender.wait_for_error_text("holding");
    sender.type("+");
    sender.type("r"); // M0 is over when somebody says so
    const Ended ended = sender.end();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("(r to resume)"));
    EXPECT_EQ(last_record(logs).at("end"), "done");
}

TEST_F(Send, RestsAfterTheFirstBlockWhereThatIsWanted) {
    write_content(file, "G21 G90 F3000\nG1 X10\nG1 X0\nM30\n");
    Emulator emulator(port, {"--speed", "20"});
    auto listening = words();
    listening.insert(listening.end(), {"--keys", "--single-block"});
    Program sender(listening);
    sender.wait_for_error_text("single block: line 2 is next");
    sender.type("b");
    sender.type("r");
    const Ended ended = sender.end();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

TEST_F(Send, NamesTheProgramThatHoldsTheSerialPort) {
    write_content(file, zigzag(2000));
    Emulator emulator(port, {"--speed", "1"});
    Program first(words());
    first.wait_for_error_text("Block ");
    const Ended second = run(words());
    EXPECT_EQ(second.exit_code, 1);
    EXPECT_THAT(second.err,
                HasSubstr("another program is using the serial port: millwright (process " +
                          std::to_string(first.pid()) + ")"));
    first.send(SIGINT);
    EXPECT_EQ(first.end().exit_code, 1);
    EXPECT_EQ(last_record(logs).at("end"), "cancelled"); // by us, and by nothing else before
}

TEST_F(Send, RefusesWhatIsLongerThanAMachineWithoutHoming) {
    write_content(file, "G21\nG0 X99999\nM2\n");
    Emulator emulator(port);
    const Ended ended = run(words());
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err,
                HasSubstr("zigzag.ngc:2: axis X would move from 0.000 mm to 99999.000 mm in machine "
                          "coordinates, a distance of 99999.000 mm, but its travel is only 200.000 mm"));
}

TEST_F(Send, IsStoppedByItsKey) {
    write_content(file, zigzag(2000));
    Emulator emulator(port, {"--speed", "5"});
    auto listening = words();
    listening.emplace_back("--keys");
    Program sender(listening);
    sender.wait_for_error_text("Block ");
    sender.type("q");
    EXPECT_EQ(sender.end().exit_code, 1);
    EXPECT_NE(last_record(logs).at("end"), "done");
}

TEST_F(Send, TellsOfAnEmergencyStop) {
    write_content(file, zigzag(2000));
    Emulator emulator(port, {"--speed", "20", "--faults", "estop=3000"});
    const Ended ended = run(words());
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_EQ(last_record(logs).at("end"), "fault");
}

TEST_F(Send, LeavesThePercentSignsOfAProgramOut) {
    write_content(file, "%\nG21 G90 F3000\nG1 X1\nM30\n%\n");
    Emulator emulator(port, {"--speed", "20"});
    const Ended ended = run(words());
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

TEST_F(Send, BrakesAndStopsAtCtrlC) {
    write_content(file, zigzag(2000));
    Emulator emulator(port, {"--speed", "5"});
    for (const int signal : {SIGINT, SIGHUP}) { // the latter where the terminal is closed
        fs::remove_all(logs);
        Program sender(words());
        sender.wait_for_error_text("Block ");
        sender.send(signal);
        const Ended ended = sender.end();
        EXPECT_EQ(ended.exit_code, 1) << signal;
        EXPECT_THAT(ended.err, HasSubstr("millwright: cancelled\n"));
        EXPECT_THAT(ended.out, HasSubstr("The job was cancelled"));
        EXPECT_EQ(last_record(logs).at("end"), "cancelled");
    }
}

/// CAM programs have them.
TEST_F(Send, PlansFeedsOfNoLengthAndDwellsOfNoTime) {
    write_content(file, "G21 G90\nG0 X0 Y0 Z5\nG1 X0 Y0 F600\nG4 P0\nG1 X5\nM2\n");
    const Ended ended = run(
        {"send", file, "--machine", "router-xyz", "--driver", "virtual", "--speed", "100", "--log", logs});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(last_record(logs).at("end"), "done");
}

TEST_F(Send, DispatchesAFileToTheCordicProcessor) {
    write_content(file, "G21 G90 F600\nG61.1\nG1 X5\nG3 X0 Y5 I-5 J0\nM2\n");
    const std::vector<std::string> words{"send", file, "--machine", "router-xyz", "--driver", "cordic"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        more.insert(more.end(), {"--speed", "0", "--log", logs});
        return run(more);
    };
    const Ended ended = with({});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("zigzag:2:1: the CORDIC processor does not stop at corners"));
    EXPECT_EQ(last_record(logs).at("end"), "done");
    EXPECT_THAT(with({"--clock", "1000"}).err, HasSubstr("took longer to compute at 0.001 MHz"));
    EXPECT_THAT(with({"--from-line", "3"}).err, HasSubstr("from the beginning"));
    EXPECT_THAT(run({"send", file, "--driver", "cordic"}).err,
                HasSubstr("the cordic driver needs a machine"));
    write_content(file, "G21 F600\nG38.2 X5\nM2\n");
    EXPECT_EQ(with({}).exit_code, 1);
}

TEST_F(Send, TellsWhichFaultEndedTheJob) {
    write_content(file, zigzag(2000));
    Emulator emulator(port, {"--speed", "20", "--faults", "alarm=3000"});
    const Ended ended = run(words());
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.out, HasSubstr("a limit switch was triggered"));
    EXPECT_EQ(last_record(logs).at("end"), "fault");
}

TEST_F(Send, ProbesWhatTheEmulatorPutsThere) {
    write_content(file, "G21 G90\nG38.2 Z-10 F600\nM2\n");
    {
        Emulator emulator(port, {"--surface", "-3"});
        const Ended touched = run(words());
        EXPECT_EQ(touched.exit_code, 0) << touched.err;
    }
    Emulator emulator(port);
    const Ended missed = run(words());
    EXPECT_EQ(missed.exit_code, 1);
    EXPECT_THAT(missed.out + missed.err, HasSubstr("probe"));
}

TEST_F(Send, TellsWhatIsWrongBeforeAnythingIsSent) {
    write_content(file, "G0 X1\nG0 X2 ?\n");
    Ended ended = run(words());
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("zigzag.ngc:2:7: this character is a real-time command"));
    write_content(file, "G0 X1\n");
    ended = run(words());
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("there is no such serial port (plug the controller in"));
    ended = run({"send", (scratch / "nothing.ngc").string(), "--driver", "grbl", "--port", port});
    EXPECT_EQ(ended.exit_code, 1);
    ended = run({"send", file, "--driver", "none", "--port", port});
    EXPECT_EQ(ended.exit_code, 2);
}

TEST_F(Send, LeavesALogThatTellsTheTruthWhenItIsKilled) {
    write_content(file, zigzag(3000));
    Emulator emulator(port, {"--speed", "5"});
    auto trusting = words();
    trusting.emplace_back("--trust-position"); // somebody has checked its position
    Program sender(trusting);
    sender.wait_for_error_text("Block ");
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const auto running = nlohmann::json::parse(run({"jobs", logs, "--json"}).out);
    EXPECT_EQ(running.at(0).at("end"), "running");
    sender.send(SIGKILL);
    EXPECT_EQ(sender.end().exit_code, -SIGKILL);
    const Ended told = run({"jobs", logs, "--json"});
    const auto jobs = nlohmann::json::parse(told.out);
    ASSERT_EQ(jobs.size(), 1U);
    EXPECT_EQ(jobs[0].at("end"), "broken off");
    const int executed = jobs[0].at("executed_blocks");
    const int allowed = jobs[0].at("allowed_blocks");
    EXPECT_LT(executed, allowed);
    EXPECT_LT(allowed, 3003);
    EXPECT_THAT(run({"jobs", logs}).out,
                HasSubstr("the next " + std::to_string(allowed - executed) + " may have been as well"));
    // The controller executes what it has and then stands still; nothing starts again automatically.
    const int next = jobs[0].at("next_line");
    Ended rest;
    for (int n = 0; n < 50; ++n) {
        rest = run({"send",
                    file,
                    "--driver",
                    "grbl",
                    "--port",
                    port,
                    "--log",
                    logs,
                    "--from-line",
                    std::to_string(std::max(next, 2900)),
                    "--clearance",
                    "5"});
        if (rest.err.find("the machine cannot accept a job: the machine was moving") == std::string::npos) {
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    EXPECT_EQ(rest.exit_code, 0) << rest.err;
    const auto after = nlohmann::json::parse(run({"jobs", logs, "--json"}).out);
    EXPECT_EQ(after.size(), 2U);
    EXPECT_EQ(after[0].at("end"), "done");
}

TEST_F(Send, AnotherCommandStopsWhatAKilledOneLeftMoving) {
    write_content(file, zigzag(300));
    Emulator emulator(port);
    {
        Program sender(words());
        sender.wait_for_error_text("Block ");
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        sender.send(SIGKILL);
        EXPECT_EQ(sender.end().exit_code, -SIGKILL);
    }
    const Ended refused = run(words());
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("the machine was moving when the connection was made"));
    EXPECT_THAT(refused.err, HasSubstr("millwright stop --driver grbl --port " + port));
    const std::vector<std::string> stop{"stop", "--driver", "grbl", "--port", port, "--log", logs};
    const Ended stopped = run(stop);
    EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
    EXPECT_THAT(stopped.out, HasSubstr("The machine was stopped (idle"));
    EXPECT_THAT(run(stop).out, HasSubstr("The machine is not moving"));
    fs::remove_all(logs);
    write_content(file, zigzag(3));
    EXPECT_EQ(run(words()).exit_code, 0);
}

/// Each command is a program of its own: what one has seen the next has to read from the disk.
TEST_F(Send, RemembersThatThePositionMayBeLostUntilSomebodyHasLooked) {
    write_content(file, zigzag(300));
    Emulator emulator(port, {"--speed", "20", "--faults", "reset=2000"});
    auto trusting = words();
    trusting.emplace_back("--trust-position");
    ASSERT_EQ(run(trusting).exit_code, 1);

    write_content(file, zigzag(3));
    const Ended short_job = run(words());
    EXPECT_EQ(short_job.exit_code, 1);
    EXPECT_THAT(short_job.err, HasSubstr("may be lost (the controller was reset)"));
    EXPECT_THAT(short_job.err, HasSubstr("Every job requires this, or --trust-position"));
    EXPECT_THAT(short_job.err, HasSubstr("Stored work offsets may be wrong"));

    auto at_a_line = words();
    at_a_line.insert(at_a_line.end(), {"--from-line", "6", "--clearance", "5"});
    write_content(file, zigzag(20));
    const Ended refused = run(at_a_line);
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("(the controller was reset)"));
    EXPECT_THAT(refused.err, HasSubstr("could start at the wrong position"));
    at_a_line.emplace_back("--trust-position");
    EXPECT_EQ(run(at_a_line).exit_code, 0);
    at_a_line.pop_back();
    EXPECT_EQ(run(at_a_line).exit_code, 0);
}

TEST_F(Send, UnlocksNothingForAJobThatIsRefused) {
    write_content(file, zigzag(20));
    Emulator emulator(port, {"--speed", "20", "--faults", "alarm=600"});
    ASSERT_EQ(run(words()).exit_code, 1);
    auto at_a_line = words();
    at_a_line.insert(at_a_line.end(), {"--from-line", "6", "--clearance", "5", "--unlock"});
    Ended ended = run(at_a_line);
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("could start at the wrong position"));
    ended = run(words());
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("--unlock to continue from the current position")); // it is locked still
    EXPECT_THAT(ended.err, testing::Not(HasSubstr("requires this"))) << "the position comes after the lock";
    EXPECT_THAT(ended.err, testing::Not(HasSubstr("reset to unlock")));
}

/// The records of the only log in `folder`, by name.
std::vector<nlohmann::json> logged_records(const fs::path& folder, const std::string& name) {
    std::vector<nlohmann::json> found;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".jsonl") {
            continue;
        }
        std::istringstream text(content_of(entry.path()));
        for (std::string line; std::getline(text, line);) {
            const auto record = nlohmann::json::parse(line);
            if (record.at("record") == name) {
                found.push_back(record);
            }
        }
    }
    return found;
}

TEST_F(Send, PlansAFileForAMachineAndWaitsAtItsStops) {
    write_content(file, "G21 G90\nG1 X10 F6000\nM0\nX20\nM1\nX10\nT4 M6\nX30\nM30\n");
    const auto stream = (scratch / "stream.txt").string();
    for (const bool to_file : {false, true}) {
        std::vector<std::string> words{
            "send", file, "--machine", "router-xyz", "--log", logs + (to_file ? "2" : ""), "--keys"};
        for (const auto* word : {"--optional-stop", "--driver"}) {
            words.emplace_back(word);
        }
        words.emplace_back(to_file ? "stream" : "virtual");
        if (to_file) {
            words.insert(words.end(), {"--port", "file:" + stream});
        }
        Program sender(words);
        for (const auto* why : {"program stop at line 3: M0",
                                "optional stop at line 5: M1",
                                "change to tool 4 at line 7: M6"}) {
            sender.wait_for_error_text(std::string("holding: ") + why + " (r to resume)");
            sender.type("r");
        }
        const Ended ended = sender.end();
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_THAT(ended.out, HasSubstr(to_file ? "All 9 blocks were sent" : "All 9 blocks were executed"));
        EXPECT_EQ(logged_records(words[5], "waiting").size(), 3U);
        EXPECT_EQ(logged_records(words[5], "waiting")[0].at("line"), 3);
        EXPECT_EQ(logged_records(words[5], "resume").size(), 3U);
        EXPECT_EQ(last_record(words[5]).at("end"), "done");
    }
    EXPECT_THAT(content_of(stream), testing::EndsWith("30.0000 0.0000 0.0000\n"));
}

// The offset of a work system that was not given was 0: the retract went down to Z0 of the work.
TEST_F(Send, PlansNoPositionsThatNobodyCanKnow) {
    write_content(file, "G21 G90\nG0 X1 Y1 Z50\nG1 Z40 F3000\nG53 G0 Z60\nM2\n");
    const std::string stream = (scratch / "stream.txt").string();
    for (const char* driver : {"virtual", "cordic", "stream", "records"}) {
        std::vector<std::string> words{
            "send", file, "--driver", driver, "--machine", "router-xyz", "--log", logs};
        const bool to_port = driver == std::string("stream") || driver == std::string("records");
        if (to_port) {
            words.insert(words.end(), {"--port", "file:" + stream});
        } else {
            words.insert(words.end(), {"--speed", "0"});
        }
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 1) << driver;
        EXPECT_THAT(ended.err, HasSubstr("zigzag.ngc:4:1: G53 moves to a machine position")) << driver;
        words.insert(words.end(), {"--origin", "0,0,5"});
        const Ended placed = run(words);
        EXPECT_EQ(placed.exit_code, 0) << driver << placed.err;
    }
}

TEST_F(Send, AsksForAMachineWhereItPlans) {
    write_content(file, "G1 X1 F100\n");
    EXPECT_THAT(run({"send", file, "--driver", "virtual"}).err,
                HasSubstr("needs a machine (give --machine)"));
    EXPECT_THAT(run({"send", file, "--driver", "stream", "--machine", "router-xyz"}).err,
                HasSubstr("the stream driver needs a port"));
    EXPECT_THAT(
        run({"send", file, "--driver", "grbl", "--port", port, "--machine", "router-xyz"}).err,
        HasSubstr("--machine and --at apply only to the drivers virtual, cordic, stream and records"));
}

TEST_F(Send, ListsJobsAndPorts) {
    EXPECT_THAT(run({"jobs", logs}).out, HasSubstr("No job logs"));
    for (const std::string& none : {std::string("/dev/zero"), program_file().string()}) {
        const Ended refused = run({"jobs", none});
        EXPECT_EQ(refused.exit_code, 1) << none;
        EXPECT_THAT(refused.err, HasSubstr(none + ": is not a folder"));
        EXPECT_EQ(refused.out, "");
    }
    write_content(logs + ".jsonl", "nonsense\n");
    const Ended bad = run({"jobs", scratch.path().string()});
    EXPECT_EQ(bad.exit_code, 1);
    EXPECT_THAT(bad.err, HasSubstr("logs.jsonl:1"));
    EXPECT_EQ(run({"ports"}).exit_code, 0);
}

TEST_F(Send, SaysBeforeItMovesWhatAPersonShouldKnow) {
    write_content(file, "G21\nT3\nG1 X1 F600\nM30\n");
    Emulator emulator(port, {"--speed", "20"});
    const Ended ended = run(words());
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("uses tools T3"));
    EXPECT_THAT(ended.err, HasSubstr("zigzag.ngc:3: the first cut comes before the spindle is started"));
}

TEST_F(Send, EmulatesNothingThatNobodyCouldReach) {
    EXPECT_EQ(run({"emulate", "grbl"}).exit_code, 2);
    EXPECT_EQ(run({"emulate", "grbl", "--tcp", "70000"}).exit_code, 2);
    const Ended ended = run({"emulate", "grbl", "--pty", port, "--faults", "rust=1"});
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.err, HasSubstr("unknown fault 'rust'"));
}

} // namespace
} // namespace millwright::test
