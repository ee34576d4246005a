// The lines that Grbl 1.1, grblHAL and FluidNC send, taken apart. Lengths as they come: mm, or inches if $13
// is on; rotary axes in degrees.
#pragma once

#include "core/drivers/grbl/firmware.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace millwright::drivers::grbl {

using Axes = std::vector<double>; ///< 3 to 9: X Y Z and what follows

enum class MachineState { idle, run, hold, jog, alarm, door, check, home, sleep, tool };

struct Ack {};
struct ErrorAnswer {
    int number = 0;
};
struct AlarmMessage {
    int number = 0;
};
struct Welcome {
    GrblIdentity who;
};
struct StatusMessage {
    MachineState state = MachineState::idle;
    int sub_state = -1; ///< after the colon; -1: none
    std::optional<Axes> machine_position{}, work_position{}, offset{};
    std::optional<int> free_blocks{}, free_bytes{}, line{};
    std::optional<double> feed{}, spindle_rpm{};
    std::optional<std::array<int, 3>> overrides{};
    std::string pins{};
    std::optional<std::string> accessories{}; ///< spindle and coolant; reported together with overrides
    bool foreign_fields = false;              ///< it has fields that Grbl 1.1 does not send

    /// Whether its axes may be moving now.
    [[nodiscard]] bool moving() const;
    /// Held or on its way into a hold: it goes on when it is resumed.
    [[nodiscard]] bool held() const {
        return state == MachineState::hold || state == MachineState::door || state == MachineState::tool;
    }
};
struct SettingMessage {
    int number = 0;
    double value = 0.0;
};
/// [PRB:...], [OPT:...], [MSG:...]
struct Feedback {
    std::string tag, text;
};
/// $/axes/x/max_rate_mm_per_min=5000.000 of a FluidNC, $300=router of a grblHAL: what has no number, or a
/// malformed value.
struct NamedSetting {
    std::string name, value;
};
struct StartupLine {
    bool executed = false;
};
struct Blank {};
/// Nothing that such a controller sends: bytes were lost or changed on the way.
struct Garbage {};

using Message = std::variant<Ack,
                             ErrorAnswer,
                             AlarmMessage,
                             Welcome,
                             StatusMessage,
                             SettingMessage,
                             NamedSetting,
                             Feedback,
                             StartupLine,
                             Blank,
                             Garbage>;

/// `line` without its end. Any bytes give a message; numbers in it are finite.
[[nodiscard]] Message read_message(std::string_view line);

/// A finite number as Grbl prints it: no exponent, no words.
[[nodiscard]] std::optional<double> read_number(std::string_view text);
/// "1.000,2.000,-3.000", and up to six further axes.
[[nodiscard]] std::optional<Axes> read_axes(std::string_view text);

/// "1.000,2.000,-3.000:1" of a PRB feedback; nothing if it is not that.
struct ProbeResult {
    Axes position{};
    bool touched = false;
};
[[nodiscard]] std::optional<ProbeResult> read_probe_result(std::string_view text);

} // namespace millwright::drivers::grbl
