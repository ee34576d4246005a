#include "core/drivers/grbl/settings.h"

#include <algorithm>
#include <array>

namespace millwright::drivers {

namespace {

constexpr std::array known_settings = {
    GrblSetting{0, "Step pulse length", "us", "how long a step pulse stays on; 3 at least"},
    GrblSetting{1, "Step idle delay", "ms", "motors stay powered so long after a motion; 255: always"},
    GrblSetting{2, "Step pulse invert", "mask", "step outputs that are active low; 1: X, 2: Y, 4: Z"},
    GrblSetting{3, "Direction invert", "mask", "axes that turn the other way round; 1: X, 2: Y, 4: Z"},
    GrblSetting{4, "Step enable invert", "0/1", "the enable output is active high"},
    GrblSetting{5, "Limit pins invert", "0/1", "limit switches that open when hit"},
    GrblSetting{6, "Probe pin invert", "0/1", "a probe that opens when it touches"},
    GrblSetting{10, "Status report", "mask", "1: machine instead of work position, 2: buffers"},
    GrblSetting{11, "Junction deviation", "mm", "how fast corners are taken; smaller is slower"},
    GrblSetting{12, "Arc tolerance", "mm", "how far the chords of an arc may be from it"},
    GrblSetting{13, "Report in inches", "0/1", "positions and feeds of reports are inches"},
    GrblSetting{20, "Soft limits", "0/1", "motions beyond the travel raise an alarm; needs homing"},
    GrblSetting{21, "Hard limits", "0/1", "a limit switch that is hit stops the machine dead"},
    GrblSetting{22, "Homing cycle", "0/1", "the machine has limit switches to home by"},
    GrblSetting{23, "Homing direction invert", "mask", "axes that home towards minus; 1: X, 2: Y, 4: Z"},
    GrblSetting{24, "Homing feed", "mm/min", "of the slow, second approach to a switch"},
    GrblSetting{25, "Homing seek", "mm/min", "of the first search for a switch"},
    GrblSetting{26, "Homing debounce", "ms", "pause until a switch has stopped bouncing"},
    GrblSetting{27, "Homing pull-off", "mm", "how far the machine moves off a switch that it found"},
    GrblSetting{30, "Greatest spindle speed", "rpm", "at full output"},
    GrblSetting{31, "Least spindle speed", "rpm", "at the least output"},
    GrblSetting{32, "Laser mode", "0/1", "the spindle output is a laser, which follows the speed"},
    GrblSetting{100, "X steps", "step/mm", "steps of the X motor for one mm"},
    GrblSetting{101, "Y steps", "step/mm", "steps of the Y motor for one mm"},
    GrblSetting{102, "Z steps", "step/mm", "steps of the Z motor for one mm"},
    GrblSetting{110, "X greatest speed", "mm/min", "no motion moves X faster; rapids use it"},
    GrblSetting{111, "Y greatest speed", "mm/min", "no motion moves Y faster; rapids use it"},
    GrblSetting{112, "Z greatest speed", "mm/min", "no motion moves Z faster; rapids use it"},
    GrblSetting{120, "X acceleration", "mm/s2", "with which X speeds up and brakes"},
    GrblSetting{121, "Y acceleration", "mm/s2", "with which Y speeds up and brakes"},
    GrblSetting{122, "Z acceleration", "mm/s2", "with which Z speeds up and brakes"},
    GrblSetting{130, "X travel", "mm", "from the home switch to the other end, for soft limits and homing"},
    GrblSetting{131, "Y travel", "mm", "from the home switch to the other end, for soft limits and homing"},
    GrblSetting{132, "Z travel", "mm", "from the home switch to the other end, for soft limits and homing"},
};

// Axes beyond X, Y and Z, of any firmware; a Grbl for more axes has them, too.
constexpr std::array further_axes = {
    GrblSetting{103, "A steps", "step/deg", "steps of the A motor for one degree"},
    GrblSetting{104, "B steps", "step/deg", "steps of the B motor for one degree"},
    GrblSetting{105, "C steps", "step/deg", "steps of the C motor for one degree"},
    GrblSetting{113, "A greatest speed", "deg/min", "no motion turns A faster; rapids use it"},
    GrblSetting{114, "B greatest speed", "deg/min", "no motion turns B faster; rapids use it"},
    GrblSetting{115, "C greatest speed", "deg/min", "no motion turns C faster; rapids use it"},
    GrblSetting{123, "A acceleration", "deg/s2", "with which A speeds up and brakes"},
    GrblSetting{124, "B acceleration", "deg/s2", "with which B speeds up and brakes"},
    GrblSetting{125, "C acceleration", "deg/s2", "with which C speeds up and brakes"},
    GrblSetting{133, "A travel", "deg", "for soft limits and homing; 0: without end"},
    GrblSetting{134, "B travel", "deg", "for soft limits and homing; 0: without end"},
    GrblSetting{135, "C travel", "deg", "for soft limits and homing; 0: without end"},
};

constexpr std::array grblhal_settings = {
    GrblSetting{
        22, "Homing cycle", "mask", "1: on, 4: needed at the start, 8: zero is at the switches, and more"},
    GrblSetting{40, "Jog soft limits", "0/1", "jogs end at the travel instead of being refused"},
    GrblSetting{43, "Homing passes", "", "how often a switch is approached slowly"},
    GrblSetting{44, "Homing, first pass", "mask", "axes that home first; 1: X, 2: Y, 4: Z, 8: A, 16: B"},
    GrblSetting{45, "Homing, second pass", "mask", "axes that home second"},
    GrblSetting{46, "Homing, third pass", "mask", "axes that home third"},
    GrblSetting{47, "Homing, fourth pass", "mask", "axes that home fourth"},
    GrblSetting{48, "Homing, fifth pass", "mask", "axes that home fifth"},
    GrblSetting{49, "Homing, sixth pass", "mask", "axes that home sixth"},
    GrblSetting{341, "Tool change", "mode", "what M6 does; 0: waits for a person, 4: nothing"},
    GrblSetting{376, "Rotary axes", "mask", "axes that count degrees; 1: A, 2: B, 4: C"},
    GrblSetting{398, "Planner blocks", "", "motions that are planned ahead"},
    GrblSetting{481, "Report interval", "ms", "between status reports that it sends unasked; 0: none"},
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
        return "Its reports do not show its planner: what is executed is known late. With $10=511 it is "
               "known at "
               "once.";
    case GrblFirmware::fluidnc:
        return "Its reports do not show its planner: what is executed is known late. With $10=3 it is known "
               "at "
               "once.";
    case GrblFirmware::grbl:
        break;
    }
    return "Its reports do not tell of its planner: what is executed is known about 21 lines late. With "
           "$10=3 it is known at once.";
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
