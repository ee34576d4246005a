// The lines that Grbl 1.1 sends, taken apart. Lengths as they come: mm, or inches if $13 is on.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace millwright::machine::grbl {

using Axes = std::array<double, 3>;

enum class MachineState { idle, run, hold, jog, alarm, door, check, home, sleep };

struct Ack {};
struct ErrorAnswer {
    int number = 0;
};
struct AlarmMessage {
    int number = 0;
};
struct Welcome {
    std::string version; ///< as 1.1h
};
struct StatusMessage {
    MachineState state = MachineState::idle;
    int sub_state = -1; ///< after the colon; -1: none
    std::optional<Axes> machine_position{}, work_position{}, offset{};
    std::optional<int> free_blocks{}, free_bytes{}, line{};
    std::optional<double> feed{}, spindle_rpm{};
    std::optional<std::array<int, 3>> overrides{};
    std::string pins{};
    std::optional<std::string> accessories{}; ///< spindle and coolant; told together with overrides

    /// Whether its axes may be moving now.
    [[nodiscard]] bool moving() const;
};
struct SettingMessage {
    int number = 0;
    double value = 0.0;
};
/// [PRB:...], [OPT:...], [MSG:...]
struct Feedback {
    std::string tag, text;
};
struct StartupLine {
    bool executed = false;
};
struct Blank {};
/// Nothing that Grbl sends: bytes were lost or changed on the way.
struct Garbage {};

using Message = std::variant<Ack,
                             ErrorAnswer,
                             AlarmMessage,
                             Welcome,
                             StatusMessage,
                             SettingMessage,
                             Feedback,
                             StartupLine,
                             Blank,
                             Garbage>;

/// `line` without its end. Any bytes give a message; numbers in it are finite.
[[nodiscard]] Message read_message(std::string_view line);

/// A finite number as Grbl prints it: no exponent, no words.
[[nodiscard]] std::optional<double> read_number(std::string_view text);
/// "1.000,2.000,-3.000"; what other axes follow is left out.
[[nodiscard]] std::optional<Axes> read_axes(std::string_view text);

/// "1.000,2.000,-3.000:1" of a PRB feedback; nothing if it is not that.
struct ProbeResult {
    Axes position{};
    bool touched = false;
};
[[nodiscard]] std::optional<ProbeResult> read_probe_result(std::string_view text);

} // namespace millwright::machine::grbl
