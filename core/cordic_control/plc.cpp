#include "core/cordic_control/plc.h"

#include "core/cordic/line_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace millwright::cordic {
namespace {

struct Area {
    char letter;
    PlcBit begin;
    int first; ///< number of the first bit
    int count;
    bool written;
};

constexpr std::array<Area, 6> areas{{
    {'I', 0, 0, 32, false},
    {'Q', 32, 0, 32, true},
    {'M', 64, 0, 64, true},
    {'T', 128, 0, 16, false},
    {'C', 144, 0, 16, false},
    {'U', plc_first_user_command, 100, 100, false},
}};

constexpr std::array<std::string_view, plc_bit_count - plc_moving> bit_names{
    "MOVING", "SPINDLE", "COOLANT", "WAITING", "ENDED", "HOLD", "START", "FIN", "STOP"};

bool is_in(PlcBit bit, char letter) {
    const auto* const area = std::ranges::find(areas, letter, &Area::letter);
    return bit >= area->begin && bit < area->begin + area->count;
}

} // namespace

std::optional<PlcBit> plc_bit(std::string_view name) {
    const std::string wanted = capital(name);
    const auto* const named = std::ranges::find(bit_names, wanted);
    if (named != bit_names.end()) {
        return plc_moving + static_cast<PlcBit>(named - bit_names.begin());
    }
    const auto* const area =
        wanted.empty() ? areas.end() : std::ranges::find(areas, wanted[0], &Area::letter);
    int number = 0;
    const char* const end = wanted.data() + wanted.size();
    if (area == areas.end()) {
        return std::nullopt;
    }
    const auto [stop, fault] = std::from_chars(wanted.data() + 1, end, number);
    const bool inside = number >= area->first && number < area->first + area->count;
    return fault == std::errc{} && stop == end && inside ? std::optional(area->begin + number - area->first)
                                                         : std::nullopt;
}

std::string plc_name(PlcBit bit) {
    if (bit >= plc_moving) {
        return std::string(bit_names[static_cast<std::size_t>(bit - plc_moving)]);
    }
    const auto* const area = std::ranges::find_if(
        areas, [&](const Area& candidate) { return bit < candidate.begin + candidate.count; });
    return fmt::format("{}{}", area->letter, bit - area->begin + area->first);
}

bool plc_is_timer(PlcBit bit) {
    return is_in(bit, 'T');
}

bool plc_is_counter(PlcBit bit) {
    return is_in(bit, 'C');
}

bool plc_writes(PlcBit bit) {
    return is_in(bit, 'Q') || is_in(bit, 'M') || bit >= plc_hold;
}

bool plc_is_input(PlcBit bit) {
    return is_in(bit, 'I');
}

namespace {

/// What the instructions without memory make of the result so far and a bit.
bool combined(PlcOp op, bool result, bool bit) {
    switch (op) {
    case PlcOp::load:
        return bit;
    case PlcOp::load_not:
        return !bit;
    case PlcOp::and_:
        return result && bit;
    case PlcOp::and_not:
        return result && !bit;
    case PlcOp::or_:
        return result || bit;
    case PlcOp::or_not:
        return result || !bit;
    case PlcOp::xor_:
        return result != bit;
    case PlcOp::not_:
        return !result;
    default:
        return result;
    }
}

} // namespace

Plc::Plc(PlcProgram program) : program_(std::move(program)) {
    expects(program_.errors.empty(), "logic that is executed has no errors");
}

bool Plc::timed(const PlcInstruction& at, bool input, std::int64_t now_us) {
    Timer& timer = timers_[static_cast<std::size_t>(at.bit)];
    const bool rises = input && !timer.input;
    if (at.op == PlcOp::count_up) {
        timer.count += rises ? 1 : 0;
        timer.input = input;
        return timer.count >= at.preset;
    }
    if (at.op == PlcOp::pulse) {
        if (rises && !timer.pulsing) {
            timer.pulsing = true;
            timer.since_us = now_us;
        }
        timer.pulsing = timer.pulsing && now_us - timer.since_us < at.preset;
        timer.input = input;
        return timer.pulsing;
    }
    if (input != timer.input) {
        timer.since_us = now_us;
        timer.input = input;
        timer.pulsing = true; // there was a change: an off-delay is false before the first
    }
    const bool over = now_us - timer.since_us >= at.preset;
    return at.op == PlcOp::on_delay ? input && over : input || (timer.pulsing && !over);
}

void Plc::scan(std::int64_t now_us) {
    bool result = false;
    std::array<std::pair<bool, PlcOp>, plc_nesting> waiting{};
    std::size_t depth = 0;
    for (const PlcInstruction& at : program_.instructions) {
        const bool bit = get(at.bit);
        switch (at.op) {
        case PlcOp::and_open:
        case PlcOp::or_open:
            waiting[depth++] = {result, at.op};
            result = bit;
            break;
        case PlcOp::close: {
            const auto [before, op] = waiting[--depth];
            result = op == PlcOp::and_open ? before && result : before || result;
            break;
        }
        case PlcOp::store:
        case PlcOp::store_not:
            set(at.bit, result == (at.op == PlcOp::store));
            break;
        case PlcOp::set:
        case PlcOp::reset:
            if (result) {
                set(at.bit, at.op == PlcOp::set);
                timers_[static_cast<std::size_t>(at.bit)].count = 0;
            }
            break;
        case PlcOp::on_delay:
        case PlcOp::off_delay:
        case PlcOp::pulse:
        case PlcOp::count_up:
            result = timed(at, result, now_us);
            set(at.bit, result);
            break;
        default:
            result = combined(at.op, result, bit);
        }
    }
}

} // namespace millwright::cordic
