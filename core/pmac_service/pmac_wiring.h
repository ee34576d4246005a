// The pins of connector JMACH1 of a PMAC-Lite, and its jumpers, as Saengsasri, Nittayachin 1996, KMITL,
// chapter 2 and appendix tell them, with how far other sources agree. Some disagree: those are to be checked
// with a meter or the card's own manual before anything is wired.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace millwright::pmac {

enum class PinTrust {
    confirmed, ///< by a manual of Delta Tau for the same connector; pins of motor 1 and those of all motors
    thesis,    ///< by the thesis alone
    conflict   ///< another source says otherwise: check before wiring
};

struct PmacPin {
    std::string_view signal;
    std::array<int, 4> of_motor; ///< pin of motor 1 to 4; 0: not given
    PinTrust trust = PinTrust::thesis;
    std::string_view note;
};

[[nodiscard]] std::span<const PmacPin> pmac_pins();

/// Of the pin of one motor, 1 to 4: what the manual confirms of motor 1 is the thesis's alone of the others.
[[nodiscard]] PinTrust trust_of(const PmacPin& pin, int motor);

struct PmacJumper {
    std::string_view jumper;
    std::string_view meaning;
    PinTrust trust = PinTrust::thesis;
};

[[nodiscard]] std::span<const PmacJumper> pmac_jumpers();

/// "confirmed", "thesis only", "check before wiring".
[[nodiscard]] std::string_view name_of(PinTrust trust);

} // namespace millwright::pmac
