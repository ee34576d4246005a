#include "core/pmac_service/pmac_wiring.h"

namespace millwright::pmac {

namespace {

constexpr auto confirmed = PinTrust::confirmed;
constexpr auto thesis = PinTrust::thesis;
constexpr auto conflict = PinTrust::conflict;

constexpr std::string_view supply_note = "the thesis has +5 V on 3 and 4 and GND on 1 and 2; a manual of a "
                                         "later card with the same signals has them reversed";

constexpr std::array<PmacPin, 18> pins{{
    {"+12...15 V", {59, 59, 59, 59}, thesis, "analog supply, 200 mA"},
    {"-12...15 V", {60, 60, 60, 60}, thesis, "analog supply, 200 mA"},
    {"DAC", {43, 44, 29, 30}, confirmed, "command to the amplifier"},
    {"AGND", {58, 58, 58, 58}, confirmed, "common of the analog signals"},
    {"DAC/", {45, 46, 31, 32}, confirmed, "never to ground with a single-ended amplifier"},
    {"FAULT", {49, 50, 35, 36}, thesis, ""},
    {"AENA", {47, 48, 33, 34}, thesis, "amplifier enable"},
    {"-LIM", {51, 52, 37, 38}, thesis, "stops motion in the positive direction"},
    {"+LIM", {53, 54, 39, 40}, thesis, "stops motion in the negative direction"},
    {"+5 V", {3, 4, 3, 4}, conflict, supply_note},
    {"CHA", {25, 26, 13, 14}, confirmed, "encoder"},
    {"CHA/", {27, 28, 15, 16}, confirmed, "open with a single-ended encoder"},
    {"CHB", {21, 22, 9, 10}, confirmed, "encoder"},
    {"CHB/", {23, 24, 11, 12}, confirmed, "open with a single-ended encoder"},
    {"CHC", {17, 18, 5, 6}, confirmed, "index"},
    {"CHC/", {19, 20, 7, 8}, confirmed, "open with a single-ended encoder"},
    {"GND", {1, 2, 1, 2}, conflict, supply_note},
    {"HMFL", {55, 0, 0, 0}, thesis, "home switch, between the limits; either type, set by I902"},
}};

constexpr std::array<PmacJumper, 8> jumpers{{
    {"E24-E27", "encoder of motor 4, 3, 2, 1: 1-2 single-ended, 2-3 differential", thesis},
    {"E40-E43", "number of the card; all on for a single card", confirmed},
    {"E44-E47",
     "serial baud rate; E44 and E47 on, E45 and E46 off: 9600. One manual prints E40-E43",
     conflict},
    {"E51", "on: factory values at reset; normally off", thesis},
    {"E54-E65", "equ and error signals that interrupt the host", thesis},
    {"E66-E71, E91-E92", "address of the host port, 528 (0x210)", confirmed},
    {"E85, E87, E88", "all off: external analog supply; all on: from the PC. Always together", thesis},
    {"E89, E90", "external +-15 V: both 1-2; internal: E90 2-3", thesis},
}};

} // namespace

std::span<const PmacPin> pmac_pins() {
    return pins;
}

PinTrust trust_of(const PmacPin& pin, int motor) {
    const bool of_first = pin.of_motor[static_cast<std::size_t>(motor - 1)] == pin.of_motor[0];
    return pin.trust == confirmed && !of_first ? thesis : pin.trust;
}

std::span<const PmacJumper> pmac_jumpers() {
    return jumpers;
}

std::string_view name_of(PinTrust trust) {
    switch (trust) {
    case PinTrust::confirmed:
        return "confirmed";
    case PinTrust::thesis:
        return "thesis only";
    case PinTrust::conflict:
        return "check before wiring";
    }
    return "";
}

} // namespace millwright::pmac
