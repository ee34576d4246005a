// The MCS-51 of the comparison beside SDCC's simulator: the program that ships, compiled by SDCC, line by
// line with the same clocks and the same results.
#include "core/base/files.h"
#include "core/cordic_control/mcs51_line.h"
#include "tests/support/oracle.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace millwright {
namespace {

using namespace cordic;

class S51 : public OracleTest {
protected:
    S51() : OracleTest("sdcc", "sdcc") {}

    void compile() {
        const std::string source = "assets/samples/line-8051.c";
        const ProgramRun compiled = run({"-mmcs51", "-o", folder_.path().string() + "/", source});
        ASSERT_EQ(compiled.exit_code, 0) << compiled.output;
        hex_ = (folder_.path() / "line-8051.ihx").string();
        std::ifstream listing(folder_.path() / "line-8051.rst");
        const std::regex instruction(R"(^\s*([0-9A-F]{6}) (D2|C2) 90 .*)");
        std::smatch found;
        for (std::string line; std::getline(listing, line);) {
            if (std::regex_match(line, found, instruction)) {
                (found[2] == "D2" ? rise_ : fall_) = found[1]; // the last of each
            }
        }
        ASSERT_FALSE(rise_.empty() || fall_.empty());
    }

    /// Clocks of the simulator between the two instructions, with the line in external memory.
    [[nodiscard]] std::int64_t simulated(const Mcs51Line& line) const {
        std::string memory;
        const auto put = [&](std::uint32_t word) {
            for (int n = 0; n < 4; ++n) {
                memory += fmt::format(" {:#x}", word >> (8 * n) & 0xffU);
            }
        };
        for (const std::int32_t number : {line.x0, line.x1, line.y0, line.y1}) {
            put(static_cast<std::uint32_t>(number));
        }
        put(std::bit_cast<std::uint32_t>(1.0F));
        put(std::bit_cast<std::uint32_t>(1.0F));
        const std::string commands = (folder_.path() / "commands").string();
        std::ofstream(commands) << "set memory xram 0" << memory << "\nbreak 0x" << rise_ << "\nbreak 0x"
                                << fall_ << "\nrun\nstate\nrun\nstate\nquit\n";
        const ProgramRun answer =
            run_other("bash", {"-c", fmt::format("s51 -t 51 '{}' < '{}'", hex_, commands)});
        std::vector<std::int64_t> clocks;
        const std::regex total(R"(Total time since last reset= \S+ sec \((\d+) clks\))");
        for (std::sregex_iterator at(answer.output.begin(), answer.output.end(), total), end; at != end;
             ++at) {
            clocks.push_back(std::stoll((*at)[1]));
        }
        EXPECT_EQ(clocks.size(), 2U) << answer.output;
        return clocks.size() == 2 ? clocks[1] - clocks[0] : 0;
    }

    [[nodiscard]] const std::string& hex() const { return hex_; }

private:
    test::ScratchFolder folder_;
    std::string hex_, rise_, fall_;
};

TEST_F(S51, CountsTheSameClocksAndTheResultsAreRight) {
    ASSERT_NO_FATAL_FAILURE(compile());
    const std::vector<std::uint8_t> code = read_intel_hex(read_file(hex()), hex());
    for (const Mcs51Line& line : {Mcs51Line{.x0 = 5, .x1 = 4, .y0 = 7, .y1 = 8}, // the thesis's
                                  Mcs51Line{.x0 = 0, .x1 = 8000, .y0 = 0, .y1 = 6000},
                                  Mcs51Line{.x0 = -123456, .x1 = 654321, .y0 = 99, .y1 = -100000},
                                  Mcs51Line{.x0 = 0, .x1 = 1, .y0 = 0, .y1 = 2000000000},
                                  Mcs51Line{.x0 = 10, .x1 = 10, .y0 = 3, .y1 = 2}}) {
        const Mcs51LineRun ours = run_mcs51_line(code, line, hex());
        EXPECT_EQ(ours.clocks, simulated(line)) << line.x1;
        const double dx = line.x1 - line.x0;
        const double dy = line.y1 - line.y0;
        EXPECT_NEAR(ours.sign_x * ours.vx, dx / std::hypot(dx, dy), 4e-7) << line.x1;
        EXPECT_NEAR(ours.sign_y * ours.ay, dy / std::hypot(dx, dy), 4e-7) << line.x1;
    }
}

} // namespace
} // namespace millwright
