// What is behind the addresses of a card that are no memory: flags of the channels, encoder table, status.
#include "core/pmac/emulator/internal/card.h"

#include <cmath>

namespace millwright::pmac::card {

namespace {

constexpr std::uint32_t writable = 0xFFFF; // of a channel's register; what is above is read
constexpr int compare_on = 12, compare_inverted = 13, compare_flag = 16;

/// -1: no channel's.
int channel_of_flags(int address) {
    constexpr int begin = 0xC000, step = 4, channels = 8;
    const int away = address - begin;
    return away >= 0 && away < step * channels && away % step == 0 ? away / step : -1;
}

/// From 0; -1: not of the row of `count` that begins there.
int in_row(int address, int begin, int step, int count) {
    const int away = address - begin;
    return away >= 0 && away % step == 0 && away / step < count ? away / step : -1;
}

/// Half of a position of a motor, which has 32 parts in `scaled` = counts times Ix08.
std::uint32_t position_word(char side, double scaled) {
    constexpr double parts = 32.0;
    constexpr int half_bits = 24;
    const std::int64_t all = std::llround(scaled * parts);
    return static_cast<std::uint32_t>(side == 'X' ? all >> half_bits : all) & word_mask;
}

} // namespace

bool Card::compare_output() const {
    const std::uint32_t word = flag_words_[0];
    const bool flag = (word >> compare_flag & 1U) != 0;
    const bool inverted = (word >> compare_inverted & 1U) != 0;
    return (word >> compare_on & 1U) != 0 && flag != inverted;
}

/// A converter's register, or memory in its place: 16 bits with a sign above 8 that are 0; nothing if no
/// motor has its output there.
std::optional<std::uint32_t> Card::output_word(int address) const {
    constexpr int output_address = 2, per_motor = 100, below = 8;
    for (int n = 0; n < motors; ++n) {
        const auto told = static_cast<int>(i(per_motor * (n + 1) + output_address)) & 0xFFFF;
        if (told == address) {
            const auto bits = static_cast<std::int32_t>(std::lround(motor(n).output()));
            return (static_cast<std::uint32_t>(bits) << below) & word_mask;
        }
    }
    return std::nullopt;
}

std::optional<std::uint32_t> Card::read(char side, int address) const {
    constexpr int motor_step = 0x3C, status_step = 0xC0, per_motor = 100, position_scale = 8;
    constexpr int commanded = 0x28, actual = 0x2B; // of motor 1
    if (const int n = channel_of_flags(address); side == 'X' && n >= 0) {
        std::uint32_t word = flag_words_[static_cast<std::size_t>(n)];
        if (n < channel_count()) {
            const Channel& one = channels_[static_cast<std::size_t>(n)];
            const auto bit = [](bool on, int place) { return on ? std::uint32_t{1} << place : 0U; };
            word |= bit(motor(n).enabled(), 14) | bit(one.home_flag(), 20) | bit(one.minus_limit_open(), 21) |
                    bit(one.plus_limit_open(), 22) | bit(one.fault, 23);
        }
        return word;
    }
    const int entry = in_row(address, encoder_table_address, 1, motors);
    if (entry >= 0 && side == 'Y') {
        return encoder_table_[static_cast<std::size_t>(entry)];
    }
    if (entry >= 0 && is_there(entry)) {
        constexpr double parts = 32.0;
        const double place = channels_[static_cast<std::size_t>(entry)].encoder() * parts;
        return static_cast<std::uint32_t>(std::llround(std::fmod(place, 8e6))) & word_mask;
    }
    if (const auto output = side == 'Y' ? output_word(address) : std::nullopt) {
        return output;
    }
    for (const int begin : {commanded, actual}) {
        if (const int n = in_row(address, begin, motor_step, motors); n >= 0) {
            const double counts = begin == commanded ? motor(n).command() : motor(n).actual();
            return position_word(side, counts * i(per_motor * (n + 1) + position_scale));
        }
    }
    if (side == 'X' && address == 0) { // servo cycles
        return static_cast<std::uint32_t>(cycles_) & word_mask;
    }
    if (const int n = in_row(address, 0x3D, motor_step, motors); side == 'X' && n >= 0) {
        return status_word_1(n);
    }
    if (const int n = in_row(address, 0x814, status_step, motors); side == 'Y' && n >= 0) {
        return status_word_2(n);
    }
    if (const int n = in_row(address, 0x818, status_step, systems); side == 'X' && n >= 0) {
        return system(n).status_word_1();
    }
    if (const int n = in_row(address, 0x817, status_step, systems); side == 'Y' && n >= 0) {
        return system(n).status_word_2();
    }
    return std::nullopt;
}

bool Card::write(char side, int address, std::uint32_t value) {
    if (const int entry = in_row(address, encoder_table_address, 1, motors); side == 'Y' && entry >= 0) {
        encoder_table_[static_cast<std::size_t>(entry)] = value & word_mask;
        load_settings();
        return true;
    }
    const int n = channel_of_flags(address);
    if (side != 'X' || n < 0) {
        return read(side, address).has_value(); // what is only read swallows it
    }
    const bool before = compare_output();
    auto& word = flag_words_[static_cast<std::size_t>(n)];
    word = (word & ~writable) | (value & writable);
    compare_pulses_ += n == 0 && !before && compare_output() ? 1 : 0;
    return true;
}

} // namespace millwright::pmac::card
