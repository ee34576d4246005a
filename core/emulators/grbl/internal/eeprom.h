// The settings of an emulated Grbl and what else its EEPROM keeps: offsets, startup lines, build text.
#pragma once

#include "core/emulators/grbl/grbl_emulator.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::emulators::internal {

// What an emulated controller was built as: firmware, axes, sizes.

struct Build {
    EmulatedFirmware firmware = EmulatedFirmware::grbl;
    std::string axes = "XYZ"; ///< letters, X Y Z first
    bool mist = false;

    [[nodiscard]] bool is(EmulatedFirmware one) const { return firmware == one; }
    [[nodiscard]] std::size_t axis_count() const { return axes.size(); }
    /// A, B and C count degrees.
    [[nodiscard]] bool is_rotary(std::size_t axis) const { return axes[axis] >= 'A' && axes[axis] <= 'C'; }
};

/// Sizes as the firmware ships.
struct Sizes {
    int planner_blocks = 15;  ///< that can be in use
    std::size_t segments = 5; ///< that are ready for the motors
    int receive_bytes = 128;
    std::size_t longest_line = 79;
};

[[nodiscard]] Sizes sizes_of(EmulatedFirmware firmware);

/// mm, of rotary axes degrees: X, Y, Z and what follows; those that the machine lacks stay 0.
using Axes = std::array<double, 6>;

constexpr double seconds_per_minute = 60.0; // rates are per minute
constexpr double mm_per_inch = 25.4;

// Settings that several parts look at, by their number behind the $.
constexpr int report_inches_setting = 13;
constexpr int soft_limits_setting = 20;
constexpr int homing_setting = 22;
constexpr int rotary_mask_setting = 376; // of a grblHAL
constexpr int planner_blocks_setting = 398;

/// One of the numbers behind `$$`. Rates mm/min, accelerations mm/s^2, as Grbl shows them.
struct Setting {
    int number = 0;
    double value = 0.0;
    int decimals = 0; ///< as it is printed

    friend bool operator==(const Setting&, const Setting&) = default;
};

struct Eeprom {
    std::vector<Setting> settings;
    std::array<Axes, 6> work_offsets{}; ///< G54 to G59
    Axes g28{}, g30{};
    std::array<std::string, 2> startup_lines;
    std::string build_text;
    std::size_t axis_count = 3;

    /// Throws Defect for a setting that Grbl does not have.
    [[nodiscard]] double setting(int number) const;
    [[nodiscard]] double axis_setting(int first, std::size_t axis) const {
        return setting(first + static_cast<int>(axis));
    }
    /// Bit `bit` of a setting that is a mask.
    [[nodiscard]] bool has_bit(int number, std::size_t bit) const {
        return (static_cast<unsigned>(setting(number)) >> bit & 1U) != 0;
    }
    [[nodiscard]] bool is_on(int number) const { return setting(number) > 0.0; }
    /// Grbl's answer: 0, or the number of its error.
    [[nodiscard]] int set(int number, double value);

    friend bool operator==(const Eeprom&, const Eeprom&) = default;
};

/// Those that Grbl 1.1 is delivered with, but for a machine that is faster: 3000 mm/min, 200 mm/s^2.
/// Rotary axes: 3600 degrees per minute.
[[nodiscard]] std::vector<Setting> default_settings(const Build& build);
[[nodiscard]] Eeprom default_eeprom(const Build& build);

/// As lines of text: `$110=500.000`, `G54=0,0,0`, `$N0=...`, `$I=...`. Reading throws Error with file and
/// line for a line it does not know; what is missing has its default. Without a file: the defaults.
[[nodiscard]] Eeprom read_eeprom(const std::filesystem::path& file, const Build& build);
void write_eeprom(const std::filesystem::path& file, const Eeprom& eeprom);

// The bytes in which an AVR keeps the settings of an emulated Grbl, and how long it writes at them.

/// The times, s, in which a write that turns `before` into `after` has interrupts off: one per changed byte,
/// but for the last byte of a record, which is not waited for.
[[nodiscard]] std::vector<double> eeprom_pauses(const Eeprom& before, const Eeprom& after);

} // namespace millwright::emulators::internal
