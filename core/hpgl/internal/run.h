// The state of a plotter while a file is read, and what the commands are given. Each group of commands has
// its own file; a command that cannot be followed is refused, and what it has drawn is taken back. No
// exception: damaged files have as many such commands as good ones, and would take ten times as long.
#pragma once

#include "core/geometry/vectors.h"
#include "core/hpgl/internal/lexer.h"
#include "core/hpgl/internal/pen.h"
#include "core/hpgl/internal/problems.h"
#include "core/hpgl/internal/user_units.h"

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace millwright::hpgl::internal {

// How labels look: size, direction, slant, spacing, origin (SI SR DI DR DV SL ES LO).

struct LabelStyle {
    bool size_relative = false;
    Vec2 size = Vec2(0.187, 0.269); ///< cm, HP's on an A4 sheet; if relative percent of the span P1 to P2
    bool direction_relative = false;
    Vec2 direction = Vec2(1.0, 0.0);
    int path = 0;                ///< DV: 0 to the right, 1 down, 2 to the left, 3 up
    double slant = 0.0;          ///< tangent of the angle to upright
    Vec2 extra = Vec2(0.0, 0.0); ///< added to the cell, in cells
    int origin = 1;
    Vec2 line_start = Vec2::Zero(); ///< where a carriage return goes to, plotter units
    Vec2 label_end = Vec2::Zero();  ///< where the last label ended, plotter units
};

/// What fills a polygon (FT). Lengths in plotter units.
struct Filling {
    int type = 1;
    double spacing = 0.0; ///< 0: 1 % of the distance from P1 to P2
    double angle_deg = 0.0;
};

/// How far a tick reaches from the line, as a fraction of the span between P1 and P2 (TL).
struct Ticks {
    double positive = 0.005;
    double negative = 0.005;
};

/// What DF puts back.
struct Modes {
    bool relative = false;
    Ticks ticks;
    Filling filling;
    LabelStyle label;
    bool chord_by_deviation = false; ///< CT1: chords are given by their distance from the arc
    bool width_relative = false;     ///< WU1: pen widths in percent of the distance from P1 to P2
    char symbol = '\0';              ///< SM; 0: none
    std::array<Pattern, 8> patterns = initial_patterns();
    int line_type = 0; ///< of LT; 0 here is solid, dots are -100
};

struct Run {
    Run(const HpglSettings& chosen, Problems& found, Lexer& source, Plot& made)
        : settings(chosen), problems(found), lexer(source), plot(made), units(chosen), pen(chosen, found) {}

    const HpglSettings& settings;
    Problems& problems;
    Lexer& lexer;
    Plot& plot;
    UserUnits units;
    Pen pen;
    Modes modes;
    PenUse usual; ///< of pens that nothing was said about
    bool polygon_damaged = false;
    std::string buffered_label;
    std::vector<std::string_view> misplaced; ///< commands: while there are any, nothing is drawn

    [[nodiscard]] Vec2 at() const { return units.user(pen.at()); }
    /// Why the command being followed cannot be. What it sets afterwards stays: return.
    void refuse(std::string why) { pen.refuse(std::move(why)); }
    [[nodiscard]] bool refuses_if_lost() {
        if (pen.lost()) {
            refuse("the pen position is unknown here because of an earlier error");
        }
        return pen.refused();
    }
    /// `setup`, which says where coordinates lie, could not be followed, or is in order (again).
    void misplace(std::string_view setup, bool wrong) {
        std::erase(misplaced, setup);
        if (wrong) {
            misplaced.push_back(setup);
        }
        pen.stay_lost(!misplaced.empty());
    }
    /// Distance from P1 to P2, plotter units.
    [[nodiscard]] double diagonal() const { return units.span().norm(); }
};

/// One command with its numbers, which are as many as the command may have.
struct Given {
    const Command& command;
    std::span<const double> numbers;

    [[nodiscard]] std::size_t count() const { return numbers.size(); }
    [[nodiscard]] double operator[](std::size_t n) const { return numbers[n]; }
    [[nodiscard]] double value(std::size_t n, double otherwise) const {
        return n < numbers.size() ? numbers[n] : otherwise;
    }
    [[nodiscard]] Vec2 point(std::size_t n) const { return {numbers[n], numbers[n + 1]}; }
};

} // namespace millwright::hpgl::internal
