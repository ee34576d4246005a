// Programs with tool changes that are sent to an emulated Grbl.
#include "tests/app/emulator.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct SendToolChange : testing::Test {
    ScratchFolder scratch;
    std::string port = (scratch / "grbl").string();
    std::string file = (scratch / "part.ngc").string();
    std::string logs = (scratch / "logs").string();

    [[nodiscard]] std::vector<std::string> words() const {
        return {"send", file, "--driver", "grbl", "--port", port, "--log", logs};
    }
    /// Of the logs that are there; all if `name` is empty.
    [[nodiscard]] std::vector<nlohmann::json> records(const std::string& name = {}) const {
        std::vector<nlohmann::json> found;
        if (!fs::exists(logs)) {
            return found;
        }
        for (const auto& entry : fs::directory_iterator(logs)) {
            std::istringstream text(entry.path().extension() == ".jsonl" ? content_of(entry.path()) : "");
            for (std::string line; std::getline(text, line);) {
                const auto record = nlohmann::json::parse(line);
                if (name.empty() || record.at("record") == name) {
                    found.push_back(record);
                }
            }
        }
        return found;
    }
};

TEST_F(SendToolChange, StopsForAnotherToolWhereGrblCannot) {
    write_content(file, "G21 G90 G94\nG0 Z5\nM3 S1000\nG1 X5 F3000\nT3 M6 (drill)\nG1 X9\nM30\n");
    Emulator emulator(port, {"--speed", "20"});
    const Ended refused = run(words());
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("part.ngc:5:4"));
    EXPECT_THAT(refused.err, HasSubstr("--tool-change"));
    std::vector<std::string> stops = words();
    stops.insert(stops.end(), {"--keys", "--tool-change", "stop", "--spin-up", "0.5"});
    Program sender(stops);
    sender.wait_for_error_text(
        "holding: change to tool 3 at line 5: M6 (drill) (r to resume, with the current Z zero)");
    sender.type("r");
    const Ended ended = sender.end();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("tools of the same length"));
    EXPECT_THAT(ended.out, HasSubstr("All 7 blocks were executed"));
    EXPECT_EQ(records("waiting").size(), 1U);
    EXPECT_EQ(records("waiting")[0].at("line"), 5);
    EXPECT_EQ(records("waiting")[0].at("executed_blocks"), 4);
    const auto own = records("own-line");
    ASSERT_GT(own.size(), 5U);
    EXPECT_EQ(own[0].at("text"), "M5");
    EXPECT_EQ(own[1].at("text"), "M9");
    for (const auto& line : own) { // none of them counts as a block of the program
        EXPECT_EQ(line.at("executed_blocks"), 4);
    }
    (void)emulator.stop();
}

// It waited for ever.
TEST_F(SendToolChange, IsRefusedWhereNoKeyCouldEndTheWaitBeforeAnythingMoves) {
    const std::string eeprom = (scratch / "eeprom").string();
    write_content(eeprom, "$22=1\n");
    write_content(file, "G21 G90 G94\nG0 Z5\nG1 X5 Y5 F3000\nT3 M6\nG1 X9\nG0 Z5\nM30\n");
    Emulator emulator(port, {"--eeprom", eeprom, "--speed", "20"});
    std::vector<std::string> all = words();
    std::erase(all, "--keys");
    all.insert(all.end(), {"--tool-change", "stop", "--home"});
    const Ended ended = run(all);
    EXPECT_EQ(ended.exit_code, 1) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("for the key r, but the input is not a terminal"));
    EXPECT_THAT(ended.out, testing::Not(HasSubstr("Connected")));
    EXPECT_TRUE(records().empty()) << "nothing was sent";
    (void)emulator.stop();
}

TEST_F(SendToolChange, LeavesToolChangesOutOfChecksAndTraces) {
    write_content(file, "G21 G90 G94\nG0 Z5\nG1 X5 Y5 F3000\nT3 M6\nG1 X9\nG0 Z5\nM30\n");
    Emulator emulator(port, {"--speed", "20"});
    for (const char* look : {"--check-only", "--trace-box"}) {
        std::vector<std::string> all = words();
        all.insert(all.end(), {"--tool-change", "stop", look});
        const Ended ended = run(all);
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_THAT(ended.out, HasSubstr("tool changes (M6) are skipped here"));
    }
    (void)emulator.stop();
}

TEST_F(SendToolChange, NeedsASensorThatItsMachineCanReach) {
    write_content(file, "G21 G90 G94\nG0 Z5\nT3 M6\nG1 X9 F100\nM30\n");
    Emulator emulator(port, {"--speed", "20"});
    const auto with = [this](std::vector<std::string> more) {
        std::vector<std::string> all = words();
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    };
    EXPECT_THAT(with({"--tool-change", "probe"}).err, HasSubstr("--tool-sensor"));
    EXPECT_EQ(with({"--tool-change", "later"}).exit_code, 2);
    EXPECT_EQ(with({"--tool-change", "stop", "--tool-sensor", "1,2,3,4"}).exit_code, 2);
    EXPECT_THAT(with({"--tool-change", "macro=" + (scratch / "none.nc").string()}).err, HasSubstr("none.nc"));
    const Ended ended =
        with({"--keys", "--trust-position", "--tool-change", "probe", "--tool-sensor", "-10,-10,-2,-50"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("the tool sensor needs a machine that homes"));
    EXPECT_TRUE(records().empty()) << "nothing was sent";
    (void)emulator.stop();
}

TEST_F(SendToolChange, NamesTheToolOfABeginningInTheMiddle) {
    std::string text = "G21 G90 G94\nT1 M6\nG0 Z5\nG0 X1 Y1\nG1 Z1 F3000\nG0 Z5\nT2 M6\nG0 X5 Y5\nG1 Z1\n";
    for (int n = 0; n < 8; ++n) {
        text += "G1 X" + std::to_string(n) + "\n";
    }
    write_content(file, text + "M30\n");
    Emulator emulator(port, {"--speed", "20"});
    std::vector<std::string> all = words();
    all.insert(all.end(), {"--tool-change", "stop", "--from-line", "12", "--trust-position"});
    const Ended asked = run(all);
    EXPECT_EQ(asked.exit_code, 1);
    EXPECT_THAT(asked.err,
                HasSubstr("Tool 2 must be in the spindle at line 12, and the Z zero must be set with it."));
    EXPECT_THAT(asked.err, HasSubstr("--right-tool"));
    EXPECT_TRUE(records().empty()) << "nothing was sent";
    all.emplace_back("--right-tool");
    const Ended ended = run(all);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    (void)emulator.stop();
}

} // namespace
} // namespace millwright::test
