// The firmwares that speak Grbl's protocol, and in what they differ for a host. Facts after their
// documentation and their behaviour; docs/reference/grbl.md, Other firmware.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace millwright::drivers {

enum class GrblFirmware { grbl, grblhal, fluidnc };

/// What settings look like.
enum class SettingForm {
    numbers,           ///< numbers with numbers as values
    numbers_with_text, ///< some values are no numbers
    names              ///< the limits of each axis have names, too ("$/axes/x/max_travel_mm")
};

/// What differs from one firmware to another, in one place.
struct GrblFacts {
    GrblFirmware firmware = GrblFirmware::grbl;
    std::string_view name; ///< as its makers write it
    /// That the planner holds at most where the controller does not report it.
    int planner_blocks = 15;
    /// Pieces of motion that may have left the planner and still be under way.
    int segment_blocks = 6;
    /// s of motion that a jog keeps under way: with less, what is prepared ahead always ends in braking.
    double jog_time = 0.08;
    /// A jog cancel empties the receive buffer: a line that waits there is never answered.
    bool cancel_drops_lines = false;
    /// Answers a jog line that a cancel ended with this error; 0: with none.
    int cancelled_jog_error = 0;
    /// After a refused line it refuses all G-code with the same error, until a $ line was right.
    bool errors_stick = false;
    SettingForm settings = SettingForm::numbers;
    /// An axis A, B or C counts as a length unless $376 says that it is rotary.
    bool rotary_mask = false;
    /// $22 is a mask: 1 homing is on, 8 the switches are at zero. $44 to $49 say which axes it homes.
    bool homing_mask = false;
};

[[nodiscard]] const GrblFacts& facts_of(GrblFirmware firmware);

/// Who answers, and in which version.
struct GrblIdentity {
    GrblFirmware firmware = GrblFirmware::grbl;
    std::string version; ///< as 1.1h, 1.1f, v3.7.12

    friend bool operator==(const GrblIdentity&, const GrblIdentity&) = default;
};

/// Of the line with which a controller begins anew: "Grbl 1.1h ['$' for help]", "GrblHAL 1.1f ['$' or '$HELP'
/// for help]", "Grbl 3.7 [FluidNC v3.7.12 (wifi) '$' for help]". Nothing for any other line.
[[nodiscard]] std::optional<GrblIdentity> read_greeting(std::string_view line);

/// What [VER:...] adds to what is known: the firmware where it names itself, and its build. `text` is what is
/// behind the first colon.
struct GrblBuild {
    std::optional<GrblIdentity> identity; ///< a FluidNC names itself here
    std::string build;                    ///< as 20190825; empty: none
};
[[nodiscard]] GrblBuild read_build(std::string_view text);

/// Letters of `count` axes where the controller names none: X, Y, Z, A, B, C, U, V, W.
[[nodiscard]] std::string default_axis_letters(int count);

} // namespace millwright::drivers
