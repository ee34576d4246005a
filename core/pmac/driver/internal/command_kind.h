// What kind of on-line command a line to a PMAC is: which only ask, which only stop, which never end.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace millwright::pmac::internal {

/// Whether `line` is nothing but questions after position, velocity, following error, status and variables,
/// as `#1P M1023` and `&1??`: such a line changes nothing, also while motors move.
[[nodiscard]] bool only_asks(std::string_view line);

/// Whether `line` is nothing but stops, as `#1J/ #2J/`, `&1A`, `H`.
[[nodiscard]] bool only_stops(std::string_view line);

/// The same without J/, which somebody types to close a loop.
[[nodiscard]] bool only_aborts(std::string_view line);

/// Whether `line` takes power away and does nothing else: `#1K`, `K`.
[[nodiscard]] bool only_kills(std::string_view line);

/// Whether `line` disables PLC programs and does nothing else: `DISABLE PLC 1,5..7`.
[[nodiscard]] bool only_disables_plcs(std::string_view line);

/// Whether `line` enables a PLC program other than the guard's.
[[nodiscard]] bool enables_plc(std::string_view line);

/// Whether `line` runs a motion program, or a step of one: `B1R`, `S`.
[[nodiscard]] bool runs_program(std::string_view line);

/// Whether `line` has a jog to a place, by a way or until a trigger (`J=`, `J:500`, `J^`).
[[nodiscard]] bool jogs(std::string_view line);

/// Whether `line` has a jog without an end (`J+`, `J-`), which runs until somebody thinks of stopping it.
[[nodiscard]] bool jogs_without_end(std::string_view line);
/// Whether `line` is a number alone, which the card stores in P0.
[[nodiscard]] bool sets_p0(std::string_view line);

/// Whether `line` sets variables to numbers, or defines one, and does nothing else: `I130=2000`.
[[nodiscard]] bool only_sets(std::string_view line);

struct MotorStep {
    int motor = 0;
    double counts = 0.0;
};

/// `#1J:200`, with nothing but a question behind it.
[[nodiscard]] std::optional<MotorStep> step_of(std::string_view line);

/// Where a jog is to end: `J=9000`, or from where the motor is: `J:500`, `J^500`.
struct MotorGoal {
    int motor = 0;
    double counts = 0.0;
    bool from_here = false;
};

/// The goals that `line` gives to motors by number, in their order. `motor`: which one is addressed before
/// it, and behind it.
[[nodiscard]] std::vector<MotorGoal> goals_of(std::string_view line, int& motor);

/// Power that a line takes away from a motor, or gives it by closing its loop (`J/`, `A`, `HM`, any jog).
struct PowerChange {
    std::optional<int> motor{}; ///< none: every one of the coordinate system
    bool given = false;
};

/// What `line` changes, in its order; `motor` as above.
[[nodiscard]] std::vector<PowerChange> power_changes_of(std::string_view line, int& motor);

/// Whether `line` begins with OPEN, or with CLOSE: what is between them is stored, not done.
[[nodiscard]] bool opens_buffer(std::string_view line);
[[nodiscard]] bool closes_buffer(std::string_view line);

/// Whether `line` is one for the card itself, which acts on it at once also between OPEN and CLOSE: a jog,
/// a stop, the start of a program, or whatever is addressed by # or &. Definitions (->) and questions are
/// not.
[[nodiscard]] bool acts_at_once(std::string_view line);

/// Whether `line` surely begins no motion: it asks, sets, addresses, defines, or ends a buffer.
[[nodiscard]] bool begins_nothing(std::string_view line);

/// Whether `line` lets something in the card begin motion without a command from here: another PLC program,
/// or another coordinate system than `system`, whose programs are not watched.
[[nodiscard]] bool may_move_later(std::string_view line, int system);

/// Sets the output of a motor to anything but 0, its loop open.
[[nodiscard]] bool opens_loop(std::string_view line);

} // namespace millwright::pmac::internal
