// LinuxCNC's interpreter as the judge of ours: the same canonical commands in the same order, numbers within
// 1e-4, for the samples that ship and for random programs; and where it refuses, so do we.
#include "core/base/files.h"
#include "core/gcode/canon_printer.h"
#include "core/gcode/interpreter.h"
#include "tests/core/gcode/random_program.h"
#include "tests/support/oracle.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace millwright::gcode {
namespace {

const std::filesystem::path samples = "assets/samples/gcode";

struct Canon {
    std::vector<std::string> lines;
    bool refused = false;
    std::string error;
};

/// Lines that begin with their running number; what is printed by the program itself has none.
std::vector<std::string> canonical_lines(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, end - at);
        if (line.size() > 7 && line[5] == ' ' && line[6] == 'N') {
            lines.push_back(line.substr(6));
        }
        at = end + 1;
    }
    while (!lines.empty() && lines.back().ends_with("ON_RESET()")) {
        lines.pop_back(); // rs274 closes once or twice, by whether it was given an ini file
    }
    return lines;
}

/// Equal word for word, numbers within 1e-4 (and the last digit's rounding).
bool same(const std::string& a, const std::string& b) {
    constexpr double tolerance = 1.01e-4;
    const char* p = a.c_str();
    const char* q = b.c_str();
    while (*p != '\0' && *q != '\0') {
        char* p_end = nullptr;
        char* q_end = nullptr;
        const double x = std::strtod(p, &p_end);
        const double y = std::strtod(q, &q_end);
        if (p_end != p && q_end != q) {
            if (!(std::abs(x - y) <= tolerance * std::max(1.0, std::abs(x) * 1e-12))) {
                return false;
            }
            p = p_end;
            q = q_end;
        } else if (*p++ != *q++) {
            return false;
        }
    }
    return *p == *q;
}

class Rs274Reader : public OracleTest {
protected:
    Rs274Reader() : OracleTest("rs274", "linuxcnc-uspace") {
        // Tells rs274 where subroutines are.
        write_file(ini_, "[DISPLAY]\nPROGRAM_PREFIX = " + std::filesystem::absolute(samples).string() + "\n");
    }
    ~Rs274Reader() override {
        std::filesystem::remove(file_);
        std::filesystem::remove(ini_);
    }

    Canon theirs(const std::filesystem::path& file) const {
        const ProgramRun answer =
            run({"-g", "-i", ini_.string(), "-t", (samples / "tools.tbl").string(), file.string()});
        return {canonical_lines(answer.output), answer.exit_code != 0, {}};
    }

    static Canon ours(const std::filesystem::path& file) {
        ReaderSettings settings;
        settings.machine_unit = LengthUnit::inch; // of rs274's own machine
        settings.tools = read_tool_table(samples / "tools.tbl");
        std::string text;
        CanonPrinter printer([&](std::string_view piece) { text += piece; });
        Interpreter program(file, settings, printer);
        program.run();
        printer.flush();
        const bool refused = !program.errors().empty();
        return {canonical_lines(text), refused, refused ? to_text(program.errors().front()) : ""};
    }

    void expect_same(const std::filesystem::path& file, const std::string& name) {
        const Canon a = theirs(file);
        const Canon b = ours(file);
        ASSERT_EQ(a.refused, b.refused) << name << ": " << b.error;
        for (std::size_t n = 0; n < std::min(a.lines.size(), b.lines.size()); ++n) {
            ASSERT_PRED2(same, a.lines[n], b.lines[n]) << name << ", canonical line " << n + 1;
        }
        ASSERT_EQ(a.lines.size(), b.lines.size()) << name;
        compared_ += static_cast<int>(b.lines.size());
    }

    void expect_same_text(const std::string& text, const std::string& name) {
        write_file(file_, text);
        expect_same(file_, name);
        if (HasFatalFailure()) {
            ADD_FAILURE() << text;
        }
    }

    int compared_ = 0;

private:
    std::filesystem::path file_ =
        std::filesystem::path(testing::TempDir()) / ("rs274_reader_" + std::to_string(getpid()) + ".ngc");
    std::filesystem::path ini_ = std::filesystem::path(file_).replace_extension(".ini");
};

TEST_F(Rs274Reader, DoesTheSameWithEverySample) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(samples)) {
        if (entry.path().extension() == ".ngc") {
            expect_same(entry.path(), entry.path().filename().string());
            ++count;
        }
    }
    EXPECT_GE(count, 25);
}

TEST_F(Rs274Reader, DoesTheSameWithRandomPrograms) {
    for (unsigned seed = 1; seed <= 80 && !HasFatalFailure(); ++seed) {
        expect_same_text(test::random_program_text(seed), "seed " + std::to_string(seed));
    }
    EXPECT_GT(compared_, 8000);
}

TEST_F(Rs274Reader, OffsetsTheSameContoursAndRefusesTheSameOnes) {
    for (unsigned seed = 1; seed <= 80 && !HasFatalFailure(); ++seed) {
        expect_same_text(test::random_contour(seed), "seed " + std::to_string(seed));
    }
    EXPECT_GT(compared_, 1000);
}

TEST_F(Rs274Reader, TakesArcsWhoseEndsWereRoundedAndRefusesTheSameOnes) {
    int number = 0;
    for (const std::string unit : {"G21", "G20"}) {
        for (const double radius : {0.05, 0.5, 5.0, 50.0, 500.0}) {
            for (const double off : {0.0005, 0.002, 0.0035, 0.01, 0.02, 0.04, 0.2, 0.4, 2.0}) {
                expect_same_text(
                    fmt::format(
                        "{} G90 F100\nG2 X{:.4f} Y0 I{:.4f} J0\nM2\n", unit, 2.0 * radius - off, radius),
                    "arc " + std::to_string(++number));
            }
        }
    }
    EXPECT_EQ(number, 90);
}

// Where a line was read otherwise, or refused.
TEST_F(Rs274Reader, DoesTheSameWithLinesThatWereTakenOtherwise) {
    int number = 0;
    for (const std::string text :
         {"G21 G90\nG92 X5\nG0 X10\n#1=[#<_abs_x>+1]\nG0 X#1\nM2\n",
          "G20 G90\nG10 L2 P1 X1 R90\nG92 Y2\nG43.1 Z3\nG0 X2 Y3 Z4 A5\nX#<_abs_x> Y#<_abs_y> Z#<_abs_z> "
          "A#<_abs_a> B#<_abs_b> C#<_abs_c>\nM2\n",
          "G21 G90 G1 F500\n#1=1\no1 while [#1 NE 0]\n#1=[#1-0.33333]\nG1 X#1\no2 if [#1 LT -3]\no1 "
          "break\no2 endif\no1 endwhile\nM2\n",
          "G21\nG0 X[0.00009 EQ 0] Y[0.00011 EQ 0] Z[10000.00009 NE 10000]\nM2\n",
          "S100 M3\nG4 P1\nM5 $-1\nM2\n",
          "S100 M3 $-1\nS200 $-1\nM4 $0\nM2\n",
          "G21 G90\nG0 X1\nM99\n",
          "%\nG21\nM98 P1\nM2\nO1\nG0 X1\nM99 (back)\n%\nO1\nG0 X5\nM99\n",
          "%\nG21\nG0 X1\nM99\n%\n",
          "G21\nM98 P1\nM2\nO1\nG0 X1\nM99 ; back\n"}) {
        expect_same_text(text, "program " + std::to_string(++number));
    }
}

TEST_F(Rs274Reader, CountsLinesInFractionsToo) {
    expect_same_text("N10.5 G21 G90 F100\nN10.75 G1 X1\nN10 M2\n", "numbers");
}

TEST_F(Rs274Reader, RefusesMostOfTheBadProgramsToo) {
    // Those that LinuxCNC takes, or does not come to an end with; why: docs/reference/gcode-reading.md.
    const std::vector<std::string> ours_only{"arc-giant",
                                             "arc-giant-radius",
                                             "arc-hair",
                                             "arc-turns-many",
                                             "cycle-endless-peck",
                                             "cycle-endless-repeat",
                                             "do-endless",
                                             "while-endless",
                                             "g10-p-fraction",
                                             "g76-steep",
                                             "io-channel",
                                             "m98-other-motion",
                                             "o-skipped-else-words",
                                             "nested-deep",
                                             "number-huge",
                                             "parameter-same-line",
                                             "spline-first",
                                             "value-too-large"};
    for (const auto& entry : std::filesystem::directory_iterator("tests/golden/gcode-bad")) {
        const std::string name = entry.path().stem().string();
        if (std::find(ours_only.begin(), ours_only.end(), name) == ours_only.end()) {
            EXPECT_TRUE(theirs(entry.path()).refused) << name;
        }
    }
}

// Programs come onto the path by a move exactly as long as the radius; then roundings decide.
TEST_F(Rs274Reader, JudgesAMoveAsLongAsTheRadiusByTheSameRoundings) {
    const std::string rest = "G1 Y9 F100\nX-9\nG40\nM2\n";
    int number = 0;
    for (const std::string compensation : {"T1 M6\nG41", "G41.1 D0.125", "G42.1 D0.125"}) {
        for (const std::string end :
             {"X0.0625 Y0", "X0.0375 Y0.05", "X0.05 Y-0.0375", "X0.0624999999999 Y0"}) {
            expect_same_text(fmt::format("G20 G90 G17\nG0 X0 Y0\n{} G0 {}\n{}", compensation, end, rest),
                             "entry " + std::to_string(++number));
        }
    }
    for (const std::string end : {"X1.5875 Y0", "X0.9525 Y1.27", "X1.58749999 Y0", "X1.5876 Y0"}) {
        expect_same_text(fmt::format("G21 G90 G17\nT1 M6\nG41 G0 {}\n{}", end, rest),
                         "entry " + std::to_string(++number));
        expect_same_text(fmt::format("G21 G90 G17\nG41.1 D3.175 G0 {}\n{}", end, rest),
                         "entry " + std::to_string(++number));
    }
    EXPECT_EQ(number, 20);
}

} // namespace
} // namespace millwright::gcode
