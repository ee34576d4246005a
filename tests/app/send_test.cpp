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

std::string zigzag(int lines) {
    std::string text = "G21 G90 G94\nG1 F3000\n";
    for (int n = 0; n < lines; ++n) {
        text += "X" + std::to_string(n % 2 == 0 ? 10 : 0) + " Y" + std::to_string(n) + "\n";
    }
    return text + "M30\n";
}

/// An emulated controller as a program of its own.
class Emulator {
public:
    explicit Emulator(const fs::path& link, std::vector<std::string> more = {})
        : program_(words(link, more)) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (!fs::exists(link) && std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }
    Ended stop() {
        program_.send(SIGINT);
        return program_.end();
    }

private:
    Program program_;

    static std::vector<std::string> words(const fs::path& link, std::vector<std::string> more) {
        std::vector<std::string> all = {"emulate", "grbl", "--pty", link.string()};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
};

nlohmann::json last_record(const fs::path& folder) {
    nlohmann::json last;
    for (const auto& entry : fs::directory_iterator(folder)) {
        std::istringstream text(content_of(entry.path()));
        for (std::string line; std::getline(text, line);) {
            last = nlohmann::json::parse(line);
        }
    }
    return last;
}

struct Send : testing::Test {
    ScratchFolder scratch;
    std::string port = (scratch / "grbl").string();
    std::string file = (scratch / "zigzag.ngc").string();
    std::string logs = (scratch / "logs").string();

    [[nodiscard]] std::vector<std::string> words() const {
        return {"send", file, "--driver", "grbl", "--port", port, "--log", logs};
    }
};

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

TEST_F(Send, BrakesAndStopsAtCtrlC) {
    write_content(file, zigzag(2000));
    Emulator emulator(port, {"--speed", "5"});
    Program sender(words());
    sender.wait_for_error_text("Block ");
    sender.send(SIGINT);
    const Ended ended = sender.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("millwright: cancelled\n"));
    EXPECT_THAT(ended.out, HasSubstr("The job was cancelled"));
    EXPECT_EQ(last_record(logs).at("end"), "cancelled");
}

TEST_F(Send, TellsWhichFaultEndedTheJob) {
    write_content(file, zigzag(2000));
    Emulator emulator(port, {"--speed", "20", "--faults", "alarm=3000"});
    const Ended ended = run(words());
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.out, HasSubstr("a limit switch was hit"));
    EXPECT_EQ(last_record(logs).at("end"), "fault");
}

TEST_F(Send, TellsWhatIsWrongBeforeAnythingIsSent) {
    write_content(file, "G0 X1\nG0 X2 ?\n");
    Ended ended = run(words());
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("zigzag.ngc:2:7: this character is a real-time command"));
    write_content(file, "G0 X1\n");
    ended = run(words());
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("cannot open the serial port"));
    ended = run({"send", (scratch / "nothing.ngc").string(), "--driver", "grbl", "--port", port});
    EXPECT_EQ(ended.exit_code, 1);
    ended = run({"send", file, "--driver", "none", "--port", port});
    EXPECT_EQ(ended.exit_code, 2);
}

TEST_F(Send, EmulatesNothingThatNobodyCouldReach) {
    EXPECT_EQ(run({"emulate", "grbl"}).exit_code, 1);
    EXPECT_EQ(run({"emulate", "grbl", "--tcp", "70000"}).exit_code, 2);
    const Ended ended = run({"emulate", "grbl", "--pty", port, "--faults", "rust=1"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("there is no fault 'rust'"));
}

} // namespace
} // namespace millwright::test
