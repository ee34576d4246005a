// What an emulated Grbl says of itself.
#pragma once

#include "core/emulators/grbl/internal/parser.h"

#include <string>
#include <string_view>

namespace millwright::emulators::internal {

struct Probe {
    Axes position{};
    bool touched = false;
};

struct Overrides {
    int feed = 100, rapid = 100, spindle = 100; ///< percent

    friend bool operator==(const Overrides&, const Overrides&) = default;
};

/// What a status report is made of.
struct Snapshot {
    std::string_view state;
    Axes position{}, offset{};
    int free_blocks = 0, free_bytes = 0;
    int line_number = 0; ///< 0: none
    double feed = 0.0;   ///< mm/min
    double spindle_rpm = 0.0;
    std::string pins;
    Overrides overrides;
    std::string accessories;
    int alarm = 0;        ///< of a grblHAL, in state Alarm
    bool all = false;     ///< a grblHAL was asked for everything
    bool homed = false;   ///<
    int tool = 0;         ///<
    int work_system = 54; ///<
};

/// Decides which fields are shown now and then only.
class StatusReport {
public:
    [[nodiscard]] std::string text(const Snapshot& now, const Eeprom& eeprom, const Build& build, bool busy);
    void show_offset_next() { offset_wait_ = 0; }
    void show_overrides_next() { override_wait_ = 0; }

private:
    int offset_wait_ = 0;
    int override_wait_ = 0;
};

/// A coordinate of each axis with its decimals, in inches if $13 says so.
[[nodiscard]] std::string coordinates(const Axes& axes, const Eeprom& eeprom, const Build& build);
/// The answers to `$$` and `$#`, line ends included.
[[nodiscard]] std::string settings_report(const Eeprom& eeprom, const Build& build);
[[nodiscard]] std::string
parameters_report(const Modes& modes, const Probe& probe, const Eeprom& eeprom, const Build& build);
[[nodiscard]] std::string probe_report(const Probe& probe, const Eeprom& eeprom, const Build& build);
/// "[MSG:text]" as the firmware says it, line end included.
[[nodiscard]] std::string message(std::string_view text, const Build& build);
/// The answer to `$I`, line ends included.
[[nodiscard]] std::string build_report(const Eeprom& eeprom, const Build& build, bool line_numbers, bool rt);

} // namespace millwright::emulators::internal
