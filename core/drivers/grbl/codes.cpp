#include "core/drivers/grbl/codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace millwright::drivers {

namespace {

constexpr std::array known_errors = {
    GrblCode{1, "a word does not begin with a letter", "write each word as a letter and a number"},
    GrblCode{2, "a word has no number, or one that cannot be read", "correct the number"},
    GrblCode{3, "this $ command does not exist", "look it up; $ alone lists the commands"},
    GrblCode{4, "a value is negative that cannot be", "F, N, P, S and T are not negative"},
    GrblCode{5, "homing is switched off", "switch it on with $22=1 if the machine has limit switches"},
    GrblCode{6, "the step pulse is too short", "$0 needs more than 3 microseconds"},
    GrblCode{7, "the stored settings could not be read and were set back", "check all settings with $$"},
    GrblCode{8, "this command works only while the machine is idle", "wait for its end, or stop it"},
    GrblCode{9, "G-code is locked during an alarm and while jogging", "unlock or home, or end the jog"},
    GrblCode{10, "soft limits need homing", "switch homing on first, $22=1"},
    GrblCode{11, "the line is too long", "Grbl takes 79 characters; leave out blanks and comments"},
    GrblCode{12,
             "the setting asks for more steps per second than Grbl can give",
             "lower the rate or the steps per mm"},
    GrblCode{13, "the safety door is open", "close it, then resume"},
    GrblCode{14, "the startup line or build text is too long to be stored", "shorten it"},
    GrblCode{15, "the jog would leave the machine's travel", "jog less far"},
    GrblCode{16,
             "the jog has no '=' or words that a jog does not take",
             "a jog takes X Y Z F and G20 G21 G53 G90 G91"},
    GrblCode{17, "laser mode needs a spindle output with variable speed", "build Grbl with it, or set $32=0"},
    GrblCode{20, "Grbl does not know this command", "make the program for Grbl"},
    GrblCode{21, "two commands of one modal group stand in a line", "put them in two lines"},
    GrblCode{22, "there is no feed", "put an F word in this line or before it"},
    GrblCode{23, "this command needs a whole number", "correct the number"},
    GrblCode{24, "two commands of the line both want its axis words", "put them in two lines"},
    GrblCode{25, "a word stands twice in the line", "leave one out"},
    GrblCode{26, "this command needs axis words and there are none", "add X, Y or Z"},
    GrblCode{27, "the line number is out of range", "N goes from 1 to 9999999"},
    GrblCode{28, "a word is missing that this command needs", "G4 needs P, G10 needs P and L"},
    GrblCode{29, "there are only the offsets G54 to G59", "choose one of these six"},
    GrblCode{30, "G53 needs G0 or G1", "put one of them in force first"},
    GrblCode{31, "there are axis words but motion is cancelled by G80", "put G0 or G1 in force first"},
    GrblCode{32, "an arc has no axis word in its plane", "name an axis of the plane"},
    GrblCode{
        33, "the motion cannot go where it should", "check end and center of the arc, or the probe's target"},
    GrblCode{34, "an arc of this radius does not reach its end", "use a larger R, or I J K"},
    GrblCode{35, "an arc has neither R nor an I J K word of its plane", "add one"},
    GrblCode{36, "the line has words that nothing in it uses", "leave them out"},
    GrblCode{37, "G43.1 offsets the tool's axis only", "name Z alone"},
    GrblCode{38, "the tool number is too large", "T goes up to 255"},
};

constexpr std::array known_alarms = {
    GrblCode{1,
             "a limit switch was hit and the machine stopped dead; its position is lost",
             "free the axis, then home"},
    GrblCode{2,
             "the program would leave the machine's travel; the position is still right",
             "check offsets and program"},
    GrblCode{3, "a reset stopped the motion; the position may be lost", "home before going on"},
    GrblCode{
        4, "the probe was not in its starting state", "look whether it touches already, or at its wiring"},
    GrblCode{5, "the probe touched nothing", "start nearer, or probe farther"},
    GrblCode{6, "homing was reset", "home again"},
    GrblCode{7, "the safety door was opened while homing", "close it and home again"},
    GrblCode{8, "homing could not clear the limit switch", "pull off farther ($27), check the wiring"},
    GrblCode{9, "homing found no limit switch", "check travel ($130 to $132), search and wiring"},
};

// What grblHAL has beyond Grbl 1.1.
constexpr std::array grblhal_errors = {
    GrblCode{18, "a reset is asserted", "release the reset input"},
    GrblCode{19, "a value must be greater than zero", "correct the number"},
    GrblCode{39, "a value is out of range", "correct the number"},
    GrblCode{40, "a tool change is pending", "change the tool and resume first"},
    GrblCode{41, "the spindle does not turn, and this motion follows it", "start the spindle before it"},
    GrblCode{42, "threading needs the plane ZX", "put G18 in force first"},
    GrblCode{43, "the feed is more than the machine reaches", "lower it"},
    GrblCode{44, "the spindle speed is out of range", "choose one between $31 and $30"},
    GrblCode{45, "a limit switch is hit, and only homing is allowed", "home the machine"},
    GrblCode{46, "the machine has to be homed first", "home it"},
    GrblCode{47, "the tool in the spindle is not known", "set it with M61 Q"},
    GrblCode{48, "two values of the line contradict each other", "leave one out"},
    GrblCode{49, "the self-test at power on failed", "switch the controller off and on"},
    GrblCode{50, "the emergency stop is pressed", "release it, then reset"},
    GrblCode{51, "a motor driver reports a fault", "look at the motor drivers, then reset"},
    GrblCode{52, "the value is out of the setting's range", "$ES lists the ranges"},
    GrblCode{53, "this setting is not available on this board", "see the board's documentation"},
    GrblCode{54, "the retract height is below the drilling depth", "correct R or Z"},
    GrblCode{
        55, "two axes that square themselves are homed at once", "home them in separate passes ($44 ...)"},
    GrblCode{56, "this coordinate system is locked", "unlock it ($486)"},
    GrblCode{57, "% is not at the beginning or end of a file", "take it out"},
    GrblCode{58, "this auxiliary port is not available", "use another P"},
    GrblCode{60, "the SD card cannot be mounted", "look at the card"},
    GrblCode{61, "the SD card cannot be read", "look at the card"},
    GrblCode{62, "a folder of the SD card cannot be opened", "look at the card"},
    GrblCode{63, "there is no such folder", "correct its name"},
    GrblCode{64, "the SD card is not mounted", "mount it with $FM"},
    GrblCode{65, "the file system is not mounted", "mount it with $FM"},
    GrblCode{66, "the file system can only be read", "choose another"},
    GrblCode{70, "Bluetooth could not be started", "see the board's documentation"},
    GrblCode{71, "an expression has an unknown operation", "correct the expression"},
    GrblCode{72, "an expression divides by zero", "correct the expression"},
    GrblCode{73, "a value in an expression is too large or too small", "correct the expression"},
    GrblCode{74, "a value does not suit the operation of its expression", "correct the expression"},
    GrblCode{75, "an expression cannot be read", "correct the expression"},
    GrblCode{76, "an expression has no finite result", "correct the expression"},
    GrblCode{77, "a password is needed", "log in at the controller"},
    GrblCode{78, "access is denied", "log in at the controller"},
    GrblCode{79, "this is not allowed while the machine is in a critical alarm", "reset it first"},
    GrblCode{80, "this flow statement works only in a macro on the controller", "take it out"},
    GrblCode{81, "a flow statement is not known", "correct it"},
    GrblCode{82, "flow statements are nested too deep", "nest them less"},
    GrblCode{83, "the controller ran out of memory in a flow statement", "shorten the macro"},
    GrblCode{84, "the file cannot be opened", "correct its name"},
    GrblCode{253, "a macro on the controller reports an error of its own", "look at the macro"},
};

constexpr std::array grblhal_alarms = {
    GrblCode{10, "the emergency stop is pressed", "release it, then reset"},
    GrblCode{11, "the machine has to be homed", "home it"},
    GrblCode{12, "a limit switch is hit", "free the axis, then reset"},
    GrblCode{13, "the probe touched while the machine moved without probing", "free the probe, then home"},
    GrblCode{14, "the spindle did not come to its speed in time", "look at the spindle, then reset"},
    GrblCode{15, "homing found only one of two switches of an axis", "check travel, search and wiring"},
    GrblCode{16, "the self-test at power on failed", "switch the controller off and on"},
    GrblCode{17, "a motor driver reports a fault", "look at the motor drivers, then home"},
    GrblCode{18, "homing is set up wrongly", "check $22 to $27 and $43 to $49"},
    GrblCode{19, "the serial link to the spindle is broken", "look at the spindle's cable, then reset"},
};

// What FluidNC has beyond Grbl 1.1, or means otherwise.
constexpr std::array fluidnc_errors = {
    GrblCode{5, "homing is not set up", "give an axis a homing section in the configuration"},
    GrblCode{18, "no axis has a homing cycle", "set homing/cycle in the configuration"},
    GrblCode{19, "this axis cannot be homed alone", "home all, or set allow_single_axis"},
    GrblCode{38, "a value is too large", "correct the number"},
    GrblCode{39, "P is too large", "correct the number"},
    GrblCode{40, "a control input is on", "release it"},
    GrblCode{60, "the SD card cannot be mounted", "look at the card"},
    GrblCode{61, "the file cannot be read", "look at the card"},
    GrblCode{62, "a folder cannot be opened", "look at the card"},
    GrblCode{63, "there is no such folder", "correct its name"},
    GrblCode{64, "the file is empty", "choose another"},
    GrblCode{65, "there is no such file", "correct its name"},
    GrblCode{66, "the file cannot be opened", "correct its name"},
    GrblCode{67, "the file system is busy", "wait"},
    GrblCode{80, "the number is out of the setting's range", "correct the number"},
    GrblCode{81, "the value does not suit the setting", "correct the value"},
    GrblCode{90, "a message could not be sent", "look at the controller's network"},
    GrblCode{100, "the setting could not be stored", "look at the controller's memory"},
    GrblCode{110, "a password is needed", "log in at the controller"},
    GrblCode{113, "the controller was reset", "send the line again"},
    GrblCode{120, "another connection has the controller", "end the other connection"},
    GrblCode{130, "the jog was cancelled", "jog again"},
    GrblCode{150, "a pin of the configuration is wrong", "correct the configuration"},
    GrblCode{151, "there is no such setting", "look it up in the configuration"},
    GrblCode{152, "the configuration is invalid", "read the controller's messages at start"},
    GrblCode{162, "this setting can only be read", "change the configuration"},
};

constexpr std::array fluidnc_alarms = {
    GrblCode{10, "the spindle could not be controlled", "look at the spindle, then reset"},
    GrblCode{11, "a control input was on at the start", "release it, then reset"},
    GrblCode{12, "homing found a switch that two axes could have hit", "free the axes, then home"},
    GrblCode{13, "a stop input cut the motion off", "home before going on"},
    GrblCode{14, "the machine has to be homed", "home it"},
    GrblCode{15, "the controller could not start its machine", "read its messages at start"},
    GrblCode{16, "an input and output expander was reset", "home before going on"},
    GrblCode{17, "a program on the controller is wrong", "look at the program"},
    GrblCode{18, "a limit switch was hit while probing", "free the axis, then home"},
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
               ? fmt::format("{} {}, which Grbl 1.1 does not have", kind, number)
               : fmt::format(
                     "{} {}, which Millwright does not know of {}", kind, number, facts_of(firmware).name);
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
