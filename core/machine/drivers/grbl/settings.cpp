#include "core/machine/drivers/grbl/settings.h"

#include <algorithm>
#include <array>

namespace millwright::machine {

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

} // namespace

std::span<const GrblSetting> grbl_settings() {
    return known_settings;
}

std::string_view grbl_reports_advice(int reports) {
    constexpr unsigned int buffers = 2;
    return (static_cast<unsigned int>(reports) & buffers) != 0
               ? std::string_view()
               : "Its reports do not tell of its planner: what is executed is known about 21 lines late. "
                 "With "
                 "$10=3 it is known at once.";
}

const GrblSetting* find_grbl_setting(int number) {
    const auto* found = std::ranges::find(known_settings, number, &GrblSetting::number);
    return found == known_settings.end() ? nullptr : found;
}

} // namespace millwright::machine
