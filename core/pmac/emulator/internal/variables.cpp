#include "core/pmac/emulator/internal/variables.h"

#include "core/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::pmac::card {

namespace {

constexpr int count = 1024;
constexpr int first_motor = 100, last_motor = 899;
constexpr int first_encoder = 900, last_encoder = 939, encoder_step = 5;

struct Factory {
    int index;
    double value;
    double range; ///< whole numbers from 0 below it; 0: any number
};

constexpr double word = 16'777'216.0; // 24 bits

constexpr std::array<Factory, 11> globals{{{1, 0, 4},
                                           {3, 1, 4},
                                           {4, 0, 4},
                                           {5, 0, 4},
                                           {6, 3, 4},
                                           {7, 0, 256},
                                           {8, 2, 256},
                                           {9, 2, 4},
                                           {10, 3'713'707, 8'388'608},
                                           {12, 10, 0},
                                           {13, 0, 0}}};

// Ixx of a motor and of the coordinate system with its number.
constexpr std::array<Factory, 29> of_motor{
    {{0, 0, 2},          {1, 0, 2},     {8, 96, 0},    {9, 96, 0},    {11, 32000, 0},     {12, 16000, 0},
     {13, 0, 0},         {14, 0, 0},    {15, 0.25, 0}, {16, 32, 0},   {17, 0.015625, 0},  {19, 0.015625, 0},
     {20, 0, 0},         {21, 50, 0},   {22, 32, 0},   {23, 32, 0},   {26, 0, 0},         {28, 160, 0},
     {30, 2000, 0},      {31, 1280, 0}, {32, 1280, 0}, {34, 1, 2},    {63, 4'194'304, 0}, {67, 4'194'304, 0},
     {69, 20480, 32768}, {80, 0, 4},    {88, 50, 0},   {89, 1000, 0}, {90, 1000, 0}}};
constexpr double slew = 1644.0; // Ix94, Ix95: full speed in a second
constexpr std::array<double, 4> outputs{0xC003, 0xC002, 0xC00B, 0xC00A};

const Factory* entry(int index) {
    const bool motor = index >= first_motor && index <= last_motor;
    const Factory* const begin = motor ? of_motor.data() : globals.data();
    const Factory* const end = begin + (motor ? of_motor.size() : globals.size());
    const Factory* const found = std::find_if(begin, end, [&](const Factory& one) {
        return one.index == (motor ? index % variables_per_motor : index);
    });
    return found == end ? nullptr : found;
}

double factory_of_motor(int motor, int index) {
    constexpr int channels_of_a_gate = 4, gate_step = 16, flag_step = 4;
    const int gate = (motor - 1) / channels_of_a_gate;
    const int place = (motor - 1) % channels_of_a_gate;
    switch (index) {
    case 0:
        return motor == 1 ? 1.0 : 0.0;
    case 2:
        return outputs[static_cast<std::size_t>(place)] + gate_step * gate;
    case 3:
    case 4:
        return 0x720 + motor - 1;
    case 25:
        return 0xC000 + gate_step * gate + flag_step * place;
    case 94:
    case 95:
        return slew;
    default: {
        const Factory* const found = entry(motor * variables_per_motor + index);
        return found == nullptr ? 0.0 : found->value;
    }
    }
}

/// Ix that are whole words of the card, with a sign.
bool is_signed_word(int index) {
    constexpr std::array<int, 12> words{8, 9, 11, 12, 30, 31, 32, 33, 34, 35, 63, 67};
    return index >= first_motor && index <= last_motor &&
           std::find(words.begin(), words.end(), index % variables_per_motor) != words.end();
}

} // namespace

IVariables::IVariables() : values_(count) {
    for (int n = 0; n < count; ++n) {
        reset(n);
    }
}

double IVariables::factory(int index) {
    if (index >= first_motor && index <= last_motor) {
        return factory_of_motor(index / variables_per_motor, index % variables_per_motor);
    }
    if (index >= first_encoder && index <= last_encoder) {
        constexpr double times_four = 7.0;
        constexpr double index_pulse = 1.0;
        switch ((index - first_encoder) % encoder_step) {
        case 0:
            return times_four;
        case 2:
            return index_pulse;
        default:
            return 0.0;
        }
    }
    const Factory* const found = entry(index);
    return found == nullptr ? 0.0 : found->value;
}

bool IVariables::is_address(int index) {
    constexpr int first_gathered = 20, last_gathered = 44; // the mask of the sources, then those
    const int own = index % variables_per_motor;
    return (index >= first_gathered && index <= last_gathered) ||
           (index >= first_motor && index <= last_motor && (own == 2 || own == 3 || own == 4 || own == 25));
}

void IVariables::set(int index, double value) {
    const Factory* const found = entry(index);
    double range = found == nullptr ? 0.0 : found->range;
    if (index >= first_encoder && index <= last_encoder) {
        constexpr double nibble = 16.0;
        range = nibble;
    } else if (is_address(index)) {
        range = word;
    }
    if (range > 0.0) {
        value = std::floor(value + 0.5);
        value -= range * std::floor(value / range);
    } else if (is_signed_word(index)) {
        value -= word * std::floor(value / word + 0.5);
    }
    constexpr double most = 1e12;
    values_[static_cast<std::size_t>(index)] = std::clamp(value, -most, most);
}

std::string number_text(double value) {
    constexpr double most = 1e15;
    constexpr double decimals = 1e9;
    const double shown = std::clamp(value, -most, most);
    const double rounded = std::abs(shown) < 1e6 ? std::round(shown * decimals) / decimals : shown;
    std::string text = fixed(rounded, 9);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) {
        text.pop_back();
    }
    return text;
}

std::string tenths_text(double value) {
    constexpr double ten = 10.0;
    return number_text(std::round(value * ten) / ten);
}

} // namespace millwright::pmac::card
