#include "core/drivers/grbl/codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace millwright::drivers {

namespace {

constexpr std::array known_errors = {
    GrblCode{1, "a word does not start with a letter", "write each word as a letter and a number"},
    GrblCode{2, "the number of a word is missing or invalid", "correct the number"},
    GrblCode{3, "unknown $ command", "check the command; $ alone lists the commands"},
    GrblCode{
        4, "negative value where only positive values are allowed", "F, N, P, S and T must not be negative"},
    GrblCode{5, "homing is disabled", "enable it with $22=1 if the machine has limit switches"},
    GrblCode{6, "step pulse time is too short", "$0 must be greater than 3 microseconds"},
    GrblCode{
        7, "the stored settings could not be read and were reset to defaults", "check all settings with $$"},
    GrblCode{8,
             "this command is only possible while the machine is idle",
             "wait until it has finished, or stop it"},
    GrblCode{9, "G-code is locked during alarm or jogging", "unlock or home the machine, or end the jog"},
    GrblCode{10, "soft limits require homing", "enable homing first ($22=1)"},
    GrblCode{11, "the line is too long", "Grbl accepts 79 characters; remove spaces and comments"},
    GrblCode{12, "the setting exceeds the maximum step rate", "reduce the maximum rate or the steps per mm"},
    GrblCode{13, "the safety door is open", "close it, then resume"},
    GrblCode{14, "the startup line or build info is too long to store", "shorten it"},
    GrblCode{15, "the jog target is outside the machine's travel", "reduce the jog distance"},
    GrblCode{16,
             "the jog has no '=' or contains words that are not allowed",
             "a jog accepts X Y Z F and G20 G21 G53 G90 G91"},
    GrblCode{17,
             "laser mode requires a PWM spindle output",
             "build Grbl with variable spindle speed, or set $32=0"},
    GrblCode{20, "unsupported G-code command", "generate the program for Grbl"},
    GrblCode{21, "two commands of the same modal group in one line", "put them on separate lines"},
    GrblCode{22, "the feed rate is not set", "add an F word to this line or an earlier one"},
    GrblCode{23, "this command requires an integer value", "correct the number"},
    GrblCode{24, "two commands in the line both require axis words", "put them on separate lines"},
    GrblCode{25, "a word is repeated in the line", "remove one of them"},
    GrblCode{26, "this command requires axis words", "add X, Y or Z"},
    GrblCode{27, "invalid line number", "N must be from 1 to 9999999"},
    GrblCode{28, "a word required by this command is missing", "G4 requires P; G10 requires P and L"},
    GrblCode{29, "only the work coordinate systems G54 to G59 are supported", "choose one of these six"},
    GrblCode{30, "G53 requires G0 or G1", "activate one of them first"},
    GrblCode{31, "axis words found, but motion is cancelled by G80", "activate G0 or G1 first"},
    GrblCode{32, "the arc has no axis word in its plane", "add an axis word of the plane"},
    GrblCode{33, "the motion target is invalid", "check the end and centre of the arc, or the probe target"},
    GrblCode{34, "an arc of this radius cannot reach its end", "use a larger R, or use I J K"},
    GrblCode{35, "the arc has neither R nor an I J K word in its plane", "add one"},
    GrblCode{36, "the line contains unused words", "remove them"},
    GrblCode{37, "G43.1 offsets the tool axis only", "specify Z only"},
    GrblCode{38, "the tool number is too large", "the highest tool number is 255"},
};

constexpr std::array known_alarms = {
    GrblCode{1,
             "a limit switch was triggered and the machine stopped abruptly; its position is lost",
             "move the axis off the switch, then home"},
    GrblCode{2,
             "the target is outside the machine's travel; the position is still valid",
             "check the offsets and the program"},
    GrblCode{3, "a reset during motion; the position may be lost", "home before continuing"},
    GrblCode{
        4, "the probe was not in its initial state", "check whether it is already touching, and its wiring"},
    GrblCode{5, "the probe did not make contact", "start closer, or increase the probe distance"},
    GrblCode{6, "homing failed: reset during the homing cycle", "home again"},
    GrblCode{7, "homing failed: the safety door was opened", "close it and home again"},
    GrblCode{8,
             "homing failed: the limit switch was not released by the pull-off",
             "increase the pull-off distance ($27), and check the wiring"},
    GrblCode{9,
             "homing failed: no limit switch was found",
             "check the travel ($130 to $132), the search distance and the wiring"},
};

// What grblHAL has beyond Grbl 1.1.
constexpr std::array grblhal_errors = {
    GrblCode{18, "the reset input is active", "release the reset input"},
    GrblCode{19, "the value must be greater than zero", "correct the number"},
    GrblCode{39, "the value is out of range", "correct the number"},
    GrblCode{40, "a tool change is pending", "change the tool, then resume"},
    GrblCode{
        41, "the spindle is not turning, but this motion is synchronised to it", "start the spindle first"},
    GrblCode{42, "threading requires the ZX plane", "activate G18 first"},
    GrblCode{43, "the feed rate exceeds the machine's maximum", "reduce it"},
    GrblCode{44, "spindle speed out of range", "use a speed between $31 and $30"},
    GrblCode{45, "a limit switch is triggered; only homing is allowed", "home the machine"},
    GrblCode{46, "the machine must be homed first", "home the machine"},
    GrblCode{47, "the current tool is unknown", "set it with M61 Q"},
    GrblCode{48, "two values in the line contradict each other", "remove one of them"},
    GrblCode{49, "the power-on self-test failed", "switch the controller off and on again"},
    GrblCode{50, "the emergency stop is active", "release it, then reset"},
    GrblCode{51, "a motor driver reports a fault", "check the motor drivers, then reset"},
    GrblCode{52, "the value is outside the range of the setting", "$ES lists the ranges"},
    GrblCode{53, "this setting is not available on this board", "see the board's documentation"},
    GrblCode{54, "the retract height is below the hole depth", "correct R or Z"},
    GrblCode{55,
             "two auto-squared axes cannot be homed at the same time",
             "home them in separate passes ($44 ...)"},
    GrblCode{56, "this coordinate system is locked", "unlock it ($486)"},
    GrblCode{57, "% is not at the start or end of a file", "remove it"},
    GrblCode{58, "this auxiliary port is not available", "use another P value"},
    GrblCode{60, "the SD card cannot be mounted", "check the card"},
    GrblCode{61, "the SD card cannot be read", "check the card"},
    GrblCode{62, "a folder on the SD card cannot be opened", "check the card"},
    GrblCode{63, "the folder does not exist", "correct the name"},
    GrblCode{64, "the SD card is not mounted", "mount it with $FM"},
    GrblCode{65, "the file system is not mounted", "mount it with $FM"},
    GrblCode{66, "the file system is read-only", "use another file system"},
    GrblCode{70, "Bluetooth could not be started", "see the board's documentation"},
    GrblCode{71, "an expression contains an unknown operation", "correct the expression"},
    GrblCode{72, "division by zero in an expression", "correct the expression"},
    GrblCode{73, "a value in an expression is too large or too small", "correct the expression"},
    GrblCode{74, "a value in an expression is not valid for its operation", "correct the expression"},
    GrblCode{75, "invalid expression", "correct the expression"},
    GrblCode{76, "an expression has no finite result", "correct the expression"},
    GrblCode{77, "a password is required", "log in at the controller"},
    GrblCode{78, "access is denied", "log in at the controller"},
    GrblCode{79, "not allowed while the machine is in a critical alarm", "reset the machine first"},
    GrblCode{80, "this flow statement is allowed only in a macro on the controller", "remove it"},
    GrblCode{81, "unknown flow statement", "correct it"},
    GrblCode{82, "flow statements are nested too deeply", "reduce the nesting"},
    GrblCode{83, "out of memory in a flow statement", "shorten the macro"},
    GrblCode{84, "the file cannot be opened", "check its name"},
    GrblCode{253, "a macro on the controller reported an error", "check the macro"},
};

constexpr std::array grblhal_alarms = {
    GrblCode{10, "the emergency stop is active", "release it, then reset"},
    GrblCode{11, "the machine must be homed", "home the machine"},
    GrblCode{12, "a limit switch is triggered", "move the axis off the switch, then reset"},
    GrblCode{13,
             "the probe was triggered during a move that is not a probing move",
             "move the probe clear, then home"},
    GrblCode{14, "the spindle did not reach its speed in time", "check the spindle, then reset"},
    GrblCode{15,
             "homing found only one of two switches of an axis",
             "check the travel, the search distance and the wiring"},
    GrblCode{16, "the power-on self-test failed", "switch the controller off and on again"},
    GrblCode{17, "a motor driver reports a fault", "check the motor drivers, then home"},
    GrblCode{18, "homing is configured incorrectly", "check $22 to $27 and $43 to $49"},
    GrblCode{19, "the serial connection to the spindle has failed", "check the spindle cable, then reset"},
};

// What FluidNC has beyond Grbl 1.1, or means otherwise.
constexpr std::array fluidnc_errors = {
    GrblCode{5, "homing is not configured", "add a homing section to an axis in the configuration"},
    GrblCode{18, "no axis has a homing cycle", "set homing/cycle in the configuration"},
    GrblCode{19, "this axis cannot be homed alone", "home all axes, or set allow_single_axis"},
    GrblCode{38, "a value is too large", "correct the number"},
    GrblCode{39, "P is too large", "correct the number"},
    GrblCode{40, "a control input is active", "release it"},
    GrblCode{60, "the SD card cannot be mounted", "check the card"},
    GrblCode{61, "the file cannot be read", "check the card"},
    GrblCode{62, "a folder cannot be opened", "check the card"},
    GrblCode{63, "the folder does not exist", "correct the name"},
    GrblCode{64, "the file is empty", "choose another file"},
    GrblCode{65, "there is no such file", "correct the name"},
    GrblCode{66, "the file cannot be opened", "check its name"},
    GrblCode{67, "the file system is busy", "wait"},
    GrblCode{80, "the number is outside the range of the setting", "correct the number"},
    GrblCode{81, "the value is not valid for the setting", "correct the value"},
    GrblCode{90, "a message could not be sent", "check the controller's network"},
    GrblCode{100, "the setting could not be saved", "check the controller's memory"},
    GrblCode{110, "a password is required", "log in at the controller"},
    GrblCode{113, "the controller was reset", "send the line again"},
    GrblCode{120, "another connection is using the controller", "close the other connection"},
    GrblCode{130, "the jog was cancelled", "jog again"},
    GrblCode{150, "a pin in the configuration is invalid", "correct the configuration"},
    GrblCode{151, "unknown setting", "check its name in the configuration"},
    GrblCode{152, "the configuration is invalid", "read the controller's startup messages"},
    GrblCode{162, "this setting is read-only", "change the configuration"},
};

constexpr std::array fluidnc_alarms = {
    GrblCode{10, "the spindle could not be controlled", "check the spindle, then reset"},
    GrblCode{11, "a control input was active at startup", "release it, then reset"},
    GrblCode{
        12, "homing found a switch that is shared by two axes", "move the axes off the switches, then home"},
    GrblCode{13, "a stop input interrupted the motion", "home before continuing"},
    GrblCode{14, "the machine must be homed", "home the machine"},
    GrblCode{15, "the controller could not start its machine", "read its startup messages"},
    GrblCode{16, "an I/O expander was reset", "home before continuing"},
    GrblCode{17, "a program on the controller contains an error", "check the program"},
    GrblCode{18, "a limit switch was triggered while probing", "move the axis off the switch, then home"},
};

/// The numbers of Grbl 1.1 with those of `others` in place of or behind them, by number.
std::vector<GrblCode> merged(std::span<const GrblCode> grbl, std::span<const GrblCode> others) {
    std::vector<GrblCode> all(others.begin(), others.end());
    for (const GrblCode& code : grbl) {
        if (std::ranges::find(others, code.number, &GrblCode::number) == others.end()) {
            all.push_back(code);
        }
    }
    std::ranges::sort(all, {}, &GrblCode::number);
    return all;
}

std::string
explain(std::string_view kind, std::span<const GrblCode> codes, int number, GrblFirmware firmware) {
    const auto found = std::ranges::find(codes, number, &GrblCode::number);
    if (found != codes.end()) {
        return fmt::format("{} {}: {} ({})", kind, number, found->meaning, found->remedy);
    }
    return firmware == GrblFirmware::grbl
               ? fmt::format("{} {}, which Grbl 1.1 does not define", kind, number)
               : fmt::format(
                     "{} {}, which is unknown to Millwright for {}", kind, number, facts_of(firmware).name);
}

} // namespace

std::span<const GrblCode> grbl_errors(GrblFirmware firmware) {
    static const std::vector<GrblCode> of_grblhal = merged(known_errors, grblhal_errors);
    static const std::vector<GrblCode> of_fluidnc = merged(known_errors, fluidnc_errors);
    switch (firmware) {
    case GrblFirmware::grblhal:
        return of_grblhal;
    case GrblFirmware::fluidnc:
        return of_fluidnc;
    case GrblFirmware::grbl:
        break;
    }
    return known_errors;
}

std::span<const GrblCode> grbl_alarms(GrblFirmware firmware) {
    static const std::vector<GrblCode> of_grblhal = merged(known_alarms, grblhal_alarms);
    static const std::vector<GrblCode> of_fluidnc = merged(known_alarms, fluidnc_alarms);
    switch (firmware) {
    case GrblFirmware::grblhal:
        return of_grblhal;
    case GrblFirmware::fluidnc:
        return of_fluidnc;
    case GrblFirmware::grbl:
        break;
    }
    return known_alarms;
}

std::string explain_grbl_error(int number, GrblFirmware firmware) {
    return explain("error", grbl_errors(firmware), number, firmware);
}

std::string explain_grbl_alarm(int number, GrblFirmware firmware) {
    return explain("alarm", grbl_alarms(firmware), number, firmware);
}

bool grbl_alarm_loses_position(int number, GrblFirmware firmware) {
    constexpr int soft_limit = 2; // Grbl brakes before it
    constexpr int probe_touches = 4;
    constexpr int probe_missed = 5;
    constexpr int homing_required_grblhal = 11; // reported at the start: what was known then is doubted there
    constexpr int homing_required_fluidnc = 14;
    const bool at_start = (firmware == GrblFirmware::grblhal && number == homing_required_grblhal) ||
                          (firmware == GrblFirmware::fluidnc && number == homing_required_fluidnc);
    return number != soft_limit && number != probe_touches && number != probe_missed && !at_start;
}

bool grbl_alarm_needs_reset(int number) {
    constexpr int hard_limit = 1;
    constexpr int soft_limit = 2;
    return number == hard_limit || number == soft_limit;
}

} // namespace millwright::drivers
