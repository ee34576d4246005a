// G-code read in Grbl's dialect against the emulated Grbl, two readers that share nothing: they take and
// refuse the same lines, go to the same places, and have the same feed in force.
#include "core/emulators/grbl/grbl_emulator.h"
#include "core/gcode/interpreter.h"
#include "tests/core/emulators/grbl/last_target.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::emulators {
namespace {

using gcode::Axis;

gcode::ReaderSettings grbl_dialect() {
    gcode::ReaderSettings settings;
    settings.dialect = gcode::Dialect::grbl;
    return settings;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) {
        text += line + "\n";
    }
    return text;
}

class Controller {
public:
    Controller() {
        (void)grbl_.take_output();
        for (const char* fast :
             {"$110=60000", "$111=60000", "$112=60000", "$120=5000", "$121=5000", "$122=5000"}) {
            EXPECT_EQ(answer(fast), "ok\r\n");
        }
    }

    /// Sends a line and lets it be executed.
    std::string answer(const std::string& line) {
        grbl_.receive(line + "\n");
        std::string text;
        constexpr double patience = 600.0; // s of the machine
        for (double time = 0.0; time < patience && text.find("\r\n") == std::string::npos; time += 0.01) {
            grbl_.advance(0.01);
            text += grbl_.take_output();
        }
        while (grbl_.moving() || grbl_.planned_blocks() > 0) {
            grbl_.advance(0.01);
        }
        return text;
    }

    /// mm/min
    double feed() {
        const std::string modes = answer("$G");
        return std::stod(modes.substr(modes.find(" F") + 2));
    }
    [[nodiscard]] double position(std::size_t axis) const { return grbl_.position()[axis]; }

private:
    GrblEmulator grbl_;
};

/// As far as the first line that both refuse.
void expect_same(const std::vector<std::string>& lines, int& compared) {
    const std::string text = joined(lines);
    SCOPED_TRACE("\n" + text);
    Controller controller;
    test::LastTarget ends;
    gcode::Interpreter reader(text, "made-up.nc", grbl_dialect(), ends);
    for (const std::string& line : lines) {
        (void)reader.step();
        const bool taken = reader.errors().empty();
        const std::string answer = controller.answer(line);
        ASSERT_EQ(taken, answer.starts_with("ok"))
            << line << ": " << answer << (taken ? "" : to_text(reader.errors().back()));
        if (!taken) {
            return;
        }
        ++compared;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            constexpr double step = 1.0 / 250.0; // mm, as the emulator's axes have it
            ASSERT_NEAR(ends.at[axis], controller.position(axis), step) << line;
        }
        const double unit = reader.state().unit == gcode::LengthUnit::inch ? gcode::mm_per_inch : 1.0;
        ASSERT_NEAR(reader.state().feed_rate * unit, controller.feed(), 1.0) << line; // it reports whole ones
    }
}

void expect_all_same(const std::vector<std::string>& lines) {
    int compared = 0;
    expect_same(lines, compared);
    EXPECT_EQ(compared, std::ssize(lines));
}

TEST(GrblDialect, TakesAFeedInTheUnitOfItsOwnLine) {
    expect_all_same({"G20 G1 X3 F100", "G21 X10 F500", "G20", "G21 F254", "G20 F10 X1", "X2", "G21 X0"});
}

TEST(GrblDialect, GoesToMachinePositionsUnderG91Too) {
    expect_all_same(
        {"G90 G0 X5 Z-5", "G92 X1", "G91 X2", "G53 G0 Z-1", "G53 G1 X2 F100 Y3", "X1", "G54 G53 G0 X0"});
}

TEST(GrblDialect, TakesTheAxisWordOfAToolLengthForNoArc) {
    expect_all_same({"G90 G1 F500 X0", "G2 X20 Y0 R15", "G43.1 Z3", "G3 X0 Y0 R15", "G0 Z1", "G49", "G0 Z1"});
}

/// A line that makes sense, or nearly.
std::string random_line(std::mt19937& random) {
    const auto below = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    const auto pick = [&]<std::size_t size>(const std::array<std::string_view, size>& from) {
        return std::string(from[static_cast<std::size_t>(below(static_cast<int>(size)))]);
    };
    const auto number = [&] { return fmt::format("{:.2f}", (below(2001) - 1000) / 100.0); };
    constexpr std::array<std::string_view, 7> motions{"G0", "G1", "G2", "G3", "G80", "G1", "G0"};
    constexpr std::array<std::string_view, 10> modes{
        "G20", "G21", "G90", "G91", "G17", "G18", "G54", "G55", "G94", "G61"};
    constexpr std::array<std::string_view, 7> singles{
        "G53", "G92", "G43.1", "G10 L2 P2", "G10 L20 P1", "G28", "G30.1"};
    constexpr std::array<std::string_view, 4> alone{"G49", "G92.1", "G49 G91", "G92.1 G80 F500"};
    if (below(8) == 0) {
        return pick(alone); // the dialect is stricter about axis words beside them
    }
    std::string line = "N1";
    line += below(2) == 0 ? pick(modes) : "";
    line += below(4) == 0 ? pick(singles) : "";
    line += below(2) == 0 ? pick(motions) : "";
    for (const char letter : {'X', 'Y', 'Z'}) {
        line += below(3) == 0 ? letter + number() : "";
    }
    line += below(4) == 0 ? fmt::format("R{}", 5 + below(20)) : "";
    line += below(3) == 0 ? fmt::format("F{}", 100 + 10 * below(200)) : "";
    return line;
}

TEST(GrblDialect, TakesAndRefusesRandomLinesAsTheEmulatedGrbl) {
    int compared = 0;
    for (unsigned seed = 1; seed <= 5000 && !testing::Test::HasFatalFailure(); ++seed) {
        std::mt19937 random(seed);
        std::vector<std::string> lines{"F1000"};
        for (int n = 0; n < 12; ++n) {
            lines.push_back(random_line(random));
        }
        expect_same(lines, compared);
    }
    EXPECT_GT(compared, 10000);
}

} // namespace
} // namespace millwright::emulators
