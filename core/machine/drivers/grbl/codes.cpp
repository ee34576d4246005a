#include "core/machine/drivers/grbl/codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace millwright::machine {

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
             "the setting asks for more steps a second than Grbl can give",
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

std::string explain(std::string_view kind, std::span<const GrblCode> codes, int number) {
    const auto found = std::ranges::find(codes, number, &GrblCode::number);
    return found == codes.end() ? fmt::format("{} {}, which Grbl 1.1 does not have", kind, number)
                                : fmt::format("{} {}: {} ({})", kind, number, found->meaning, found->remedy);
}

} // namespace

std::span<const GrblCode> grbl_errors() {
    return known_errors;
}

std::span<const GrblCode> grbl_alarms() {
    return known_alarms;
}

std::string explain_grbl_error(int number) {
    return explain("error", known_errors, number);
}

std::string explain_grbl_alarm(int number) {
    return explain("alarm", known_alarms, number);
}

bool grbl_alarm_loses_position(int number) {
    constexpr int soft_limit = 2; // Grbl brakes before it
    constexpr int probe_touches = 4;
    constexpr int probe_missed = 5;
    return number != soft_limit && number != probe_touches && number != probe_missed;
}

} // namespace millwright::machine
