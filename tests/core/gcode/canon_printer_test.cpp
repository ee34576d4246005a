#include "core/gcode/canon_printer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::gcode {
namespace {

std::string printed_move(const AxisValues& target) {
    std::string text;
    CanonPrinter printer([&](std::string_view piece) { text += piece; });
    Move move;
    move.kind = MoveKind::feed;
    move.target = target;
    printer.move(move, {});
    printer.flush();
    return text;
}

TEST(CanonPrinter, WritesFourDecimalsRoundedAsTheExactValueIs) {
    std::mt19937 random(274);
    std::uniform_real_distribution<double> size(-9.0, 14.0), sign(-1.0, 1.0);
    std::uniform_int_distribution<int> tie(-2'000'000, 2'000'000);
    for (int n = 0; n < 50'000; ++n) {
        AxisValues t{};
        t[Axis::x] = std::copysign(std::pow(10.0, size(random)), sign(random));
        t[Axis::y] = (tie(random) + 0.5) / 1e4; // nearly half way between two texts
        t[Axis::z] = std::nextafter((tie(random) + 0.5) / 1e4, sign(random) * 1e9);
        t[Axis::a] = tie(random) / 1e4;
        ASSERT_EQ(printed_move(t),
                  fmt::format("    1 N..... STRAIGHT_FEED({:.4f}, {:.4f}, {:.4f}, {:.4f}, 0.0000, 0.0000)\n",
                              t[Axis::x],
                              t[Axis::y],
                              t[Axis::z],
                              t[Axis::a]));
    }
    for (const double value : {0.0, -0.0, 1e-5, -1e-5, -5e-5, 9.99995, -9.99995, 0.99999, 123456789.0}) {
        AxisValues t{};
        t[Axis::x] = value;
        EXPECT_EQ(printed_move(t).substr(27, fmt::format("{:.4f}", value).size()),
                  fmt::format("{:.4f}", value));
    }
}

TEST(CanonPrinter, NumbersNoLineOnceTheProgramIsOver) { // as rs274 prints it
    std::string text;
    CanonPrinter printer([&](std::string_view piece) { text += piece; });
    SourceLine last;
    last.text = "N20 M2";
    for (const CommandKind kind : {CommandKind::program_end, CommandKind::on_reset}) {
        Command command;
        command.kind = kind;
        printer.command(command, last);
    }
    printer.flush();
    EXPECT_EQ(text, "    1 N20    PROGRAM_END()\n    2 N..... ON_RESET()\n");
}

} // namespace
} // namespace millwright::gcode
