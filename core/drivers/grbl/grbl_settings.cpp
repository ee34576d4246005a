#include "core/drivers/grbl/grbl_settings.h"

#include <algorithm>
#include <array>

namespace millwright::drivers {

namespace {

constexpr std::array known_settings = {
    GrblSetting{0, "Step pulse time", "us", "duration of a step pulse; at least 3"},
    GrblSetting{1, "Step idle delay", "ms", "delay before the motors turn off after a motion; 255: never"},
    GrblSetting{2, "Step pulse invert", "mask", "axes with active-low step outputs; 1: X, 2: Y, 4: Z"},
    GrblSetting{3, "Direction invert", "mask", "axes with reversed direction; 1: X, 2: Y, 4: Z"},
    GrblSetting{4, "Step enable invert", "0/1", "the enable output is active high"},
    GrblSetting{5, "Limit pins invert", "0/1", "limit switches that are normally closed"},
    GrblSetting{6, "Probe pin invert", "0/1", "the probe input is normally closed"},
    GrblSetting{10, "Status report options", "mask", "1: machine instead of work position, 2: buffer state"},
    GrblSetting{11, "Junction deviation", "mm", "speed in corners; smaller is slower"},
    GrblSetting{12, "Arc tolerance", "mm", "maximum deviation of the chords from an arc"},
    GrblSetting{13, "Report in inches", "0/1", "status reports are in inches"},
    GrblSetting{20, "Soft limits", "0/1", "moves beyond the travel raise an alarm; requires homing"},
    GrblSetting{21, "Hard limits", "0/1", "a triggered limit switch stops the machine immediately"},
    GrblSetting{22, "Homing cycle", "0/1", "the machine homes to limit switches"},
    GrblSetting{
        23, "Homing direction invert", "mask", "axes that home in the negative direction; 1: X, 2: Y, 4: Z"},
    GrblSetting{24, "Homing locate feed", "mm/min", "speed of the second, slow approach to a switch"},
    GrblSetting{25, "Homing search feed", "mm/min", "speed of the first search for a switch"},
    GrblSetting{26, "Homing debounce", "ms", "delay until a switch has stopped bouncing"},
    GrblSetting{27, "Homing pull-off", "mm", "distance moved off a switch after it was found"},
    GrblSetting{30, "Maximum spindle speed", "rpm", "at maximum output"},
    GrblSetting{31, "Minimum spindle speed", "rpm", "at minimum output"},
    GrblSetting{32, "Laser mode", "0/1", "the spindle output drives a laser, whose power follows the speed"},
    GrblSetting{100, "X steps per mm", "step/mm", "motor steps per mm of X travel"},
    GrblSetting{101, "Y steps per mm", "step/mm", "motor steps per mm of Y travel"},
    GrblSetting{102, "Z steps per mm", "step/mm", "motor steps per mm of Z travel"},
    GrblSetting{110, "X maximum rate", "mm/min", "upper limit for all X motion; used by rapids"},
    GrblSetting{111, "Y maximum rate", "mm/min", "upper limit for all Y motion; used by rapids"},
    GrblSetting{112, "Z maximum rate", "mm/min", "upper limit for all Z motion; used by rapids"},
    GrblSetting{120, "X acceleration", "mm/s2", "acceleration and deceleration of X"},
    GrblSetting{121, "Y acceleration", "mm/s2", "acceleration and deceleration of Y"},
    GrblSetting{122, "Z acceleration", "mm/s2", "acceleration and deceleration of Z"},
    GrblSetting{
        130, "X maximum travel", "mm", "from the homing switch to the other end, for soft limits and homing"},
    GrblSetting{
        131, "Y maximum travel", "mm", "from the homing switch to the other end, for soft limits and homing"},
    GrblSetting{
        132, "Z maximum travel", "mm", "from the homing switch to the other end, for soft limits and homing"},
};

// Axes beyond X, Y and Z, of any firmware; a Grbl for more axes has them, too.
constexpr std::array further_axes = {
    GrblSetting{103, "A steps per degree", "step/deg", "motor steps per degree of A rotation"},
    GrblSetting{104, "B steps per degree", "step/deg", "motor steps per degree of B rotation"},
    GrblSetting{105, "C steps per degree", "step/deg", "motor steps per degree of C rotation"},
    GrblSetting{113, "A maximum rate", "deg/min", "upper limit for all A rotation; used by rapids"},
    GrblSetting{114, "B maximum rate", "deg/min", "upper limit for all B rotation; used by rapids"},
    GrblSetting{115, "C maximum rate", "deg/min", "upper limit for all C rotation; used by rapids"},
    GrblSetting{123, "A acceleration", "deg/s2", "acceleration and deceleration of A"},
    GrblSetting{124, "B acceleration", "deg/s2", "acceleration and deceleration of B"},
    GrblSetting{125, "C acceleration", "deg/s2", "acceleration and deceleration of C"},
    GrblSetting{133, "A maximum travel", "deg", "for soft limits and homing; 0 = unlimited"},
    GrblSetting{134, "B maximum travel", "deg", "for soft limits and homing; 0 = unlimited"},
    GrblSetting{135, "C maximum travel", "deg", "for soft limits and homing; 0 = unlimited"},
};

constexpr std::array grblhal_settings = {
    GrblSetting{22,
                "Homing cycle",
                "mask",
                "1: enabled, 4: required at startup, 8: zero is at the switches, and more"},
    GrblSetting{40, "Jog soft limits", "0/1", "jogs stop at the end of travel instead of being refused"},
    GrblSetting{43, "Homing passes", "", "number of slow approaches to a switch"},
    GrblSetting{44, "Homing, first pass", "mask", "axes that home first; 1: X, 2: Y, 4: Z, 8: A, 16: B"},
    GrblSetting{45, "Homing, second pass", "mask", "axes that home second"},
    GrblSetting{46, "Homing, third pass", "mask", "axes that home third"},
    GrblSetting{47, "Homing, fourth pass", "mask", "axes that home fourth"},
    GrblSetting{48, "Homing, fifth pass", "mask", "axes that home fifth"},
    GrblSetting{49, "Homing, sixth pass", "mask", "axes that home sixth"},
    GrblSetting{341, "Tool change", "mode", "effect of M6; 0: waits for the operator, 4: ignored"},
    GrblSetting{376, "Rotary axes", "mask", "axes measured in degrees; 1: A, 2: B, 4: C"},
    GrblSetting{398, "Planner blocks", "", "number of motions planned ahead"},
    GrblSetting{481, "Report interval", "ms", "interval of automatic status reports; 0 = none"},
};

} // namespace

std::span<const GrblSetting> grbl_settings() {
    return known_settings;
}

std::string_view grbl_reports_advice(int reports, GrblFirmware firmware) {
    constexpr unsigned int buffers = 2;
    if ((static_cast<unsigned int>(reports) & buffers) != 0) {
        return {};
    }
    switch (firmware) {
    case GrblFirmware::grblhal: // whose other bits show feed, inputs and offsets
        return "Its status reports do not show the planner, so execution is confirmed late. With $10=511 it "
               "is confirmed at once.";
    case GrblFirmware::fluidnc:
        return "Its status reports do not show the planner, so execution is confirmed late. With $10=3 it is "
               "confirmed at once.";
    case GrblFirmware::grbl:
        break;
    }
    return "Its status reports do not show the planner, so execution is confirmed about 21 lines late. With "
           "$10=3 it is confirmed at once.";
}

const GrblSetting* find_grbl_setting(int number, GrblFirmware firmware) {
    const auto find = [number](std::span<const GrblSetting> settings) {
        const auto found = std::ranges::find(settings, number, &GrblSetting::number);
        return found == settings.end() ? nullptr : &*found;
    };
    const GrblSetting* own = firmware == GrblFirmware::grblhal ? find(grblhal_settings) : nullptr;
    own = own == nullptr ? find(known_settings) : own;
    return own == nullptr ? find(further_axes) : own;
}

} // namespace millwright::drivers
