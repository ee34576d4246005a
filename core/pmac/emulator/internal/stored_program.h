// Motion programs and PLC programs as a PMAC stores them: lines that became statements, each checked when it
// came.
#pragma once

#include "core/pmac/emulator/internal/expression.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::pmac::card {

inline constexpr std::string_view axis_letters = "XYZABCUVW";

enum class Verb {
    label,
    linear,
    rapid,
    circle_clockwise,
    circle_counter_clockwise,
    absolute, ///< of `axes`; of all if there are none
    incremental,
    feed_axes,
    normal, ///< plane of circles: `words` I J K
    feed,
    move_time,
    acceleration_time,
    s_curve_time,
    move, ///< `words`: axes, I J K R
    dwell,
    delay,
    set, ///< variable `letter``data` = `value`
    if_true,
    otherwise,
    end_if,
    while_true,
    end_while,
    go_to,
    go_sub,
    call,
    return_back,
    home, ///< motors in `numbers`
    home_zero,
    place, ///< PSET `words`
    command,
    send,
    enable_plc,
    disable_plc,
    stop,
    block_start,
    block_stop,
    code ///< G, M, T or D: `letter``data`
};

struct Statement {
    Verb verb = Verb::label;
    Expression data, value; ///< a condition is in `data`
    char letter = 0;
    std::string axes;    ///< letters
    bool radius = false; ///< R among the axes of INC, ABS
    struct AxisWord {
        char letter = 'X';
        Expression data;
    };
    std::vector<AxisWord> words;
    std::vector<int> numbers;
    std::string text;
    bool implied = false; ///< the end of an IF or WHILE that ends with its line
    int jump = -1;        ///< where IF, ELSE, ENDIF, WHILE and ENDWHILE go on
};

/// A line's statements; nothing if it is no line of a program. `plc`: without motion.
[[nodiscard]] std::optional<std::vector<Statement>> compile(const std::vector<Token>& line, bool plc);

/// A buffer: what was stored, and how it is listed.
class StoredProgram {
public:
    explicit StoredProgram(bool plc = false) : plc_(plc) {}

    /// Returns whether it is a line of a program; then it is stored.
    bool add(const std::vector<Token>& line);
    void clear();
    /// Finds the ends of loops and conditions. Returns whether every one has its own.
    bool join();

    [[nodiscard]] const std::vector<Statement>& statements() const { return statements_; }
    [[nodiscard]] const std::vector<std::vector<Token>>& lines() const { return lines_; }
    /// Of a label N; -1: there is none.
    [[nodiscard]] int place_of(int label) const;
    [[nodiscard]] bool sound() const { return sound_; }

private:
    bool plc_;
    bool sound_ = true;
    std::vector<Statement> statements_;
    std::vector<std::vector<Token>> lines_;
};

} // namespace millwright::pmac::card
