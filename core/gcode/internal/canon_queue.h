// The way out of the interpreter: to the sink at once, or behind the moves that cutter compensation holds
// back because their ends depend on the next move.
#pragma once

#include "core/gcode/canon.h"
#include "core/geometry/vectors.h"

#include <string>
#include <vector>

namespace millwright::gcode::internal {

/// An operation that is held back.
struct Waiting {
    bool is_move = true;
    Move move;
    Vec2 direction = Vec2::Zero(); ///< of a straight move as programmed, in the plane; zero where it has none
    double sweep = 0.0;            ///< of an arc as programmed, rad; 0: its end is final
    Command command;
    std::string text; ///< of the command
};

class CanonQueue {
public:
    CanonQueue(CanonSink& sink, int most_moves_of_a_line) : sink_(&sink), most_moves_(most_moves_of_a_line) {}

    /// From here on operations come from this line.
    void begin(const SourceLine& line) {
        now_ = line;
        words_ = {};
        moves_ = 0;
    }
    /// What new moves of the line say.
    void set_words(const MoveWords& words) { words_ = words; }
    [[nodiscard]] SourcePlace place() const { return now_.place; }

    /// Before the first of the many moves of a cycle, so that a line that is refused moves nothing. Throws
    /// Refusal if up to `count` more are too many for a line, or for the cycles of a program.
    void expect_room_for(double count) const;

    /// A move that this line asks for.
    [[nodiscard]] Move new_move(MoveKind kind) const {
        Move move;
        move.kind = kind;
        move.source = now_.place;
        move.words = words_;
        return move;
    }

    /// At once. The source of a command is filled in where it is missing. Throws Refusal if a single line
    /// makes more than a million moves.
    void send(const Move& move);
    void send(const Curve& curve);
    void send(Command command);
    void send(CommandKind kind, int index = 0, double value = 0.0);

    /// In the order of the program: behind the moves that wait, if there are any.
    void post(Command command);
    void post(CommandKind kind, int index = 0, double value = 0.0);

    [[nodiscard]] std::vector<Waiting>& waiting() { return waiting_; }
    [[nodiscard]] const std::vector<Waiting>& waiting() const { return waiting_; }

private:
    void count_move();
    [[noreturn]] void refuse_line() const;
    [[noreturn]] static void refuse_program();

    CanonSink* sink_;
    SourceLine now_;
    MoveWords words_;
    int most_moves_;
    int moves_ = 0;
    int further_moves_ = 0;
    std::vector<Waiting> waiting_;
};

[[nodiscard]] inline Command command_of(CommandKind kind, int index = 0, double value = 0.0) {
    Command command;
    command.kind = kind;
    command.index = index;
    command.value = value;
    return command;
}

[[nodiscard]] Command command_of(CommandKind kind, const AxisValues& axes, int index = 0);
[[nodiscard]] Command command_of(CommandKind kind, std::string_view text);

} // namespace millwright::gcode::internal
