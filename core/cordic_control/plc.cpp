#include "core/cordic_control/plc.h"

#include "core/base/text.h"
#include "core/cordic/line_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
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

namespace {

constexpr PlcBit no_bit = -1;

PlcBit input_of(std::string_view name) {
    const PlcBit bit = plc_bit(name).value_or(no_bit);
    return bit != no_bit && plc_is_input(bit) ? bit : no_bit;
}

} // namespace

ReadInputs read_inputs(std::string_view text, const std::filesystem::path& name) {
    ReadInputs read;
    if (auto fault = wide_text_fault(text, name)) {
        read.errors.push_back(std::move(*fault));
        return read;
    }
    text = without_byte_order_mark(text);
    for (int line = 1; !text.empty(); ++line) {
        const std::vector<LineWord> words = words_of(take_line(text));
        const auto fail = [&](std::size_t at, std::string message) {
            const int column = at < words.size() ? words[at].column : words.back().column;
            read.errors.push_back({{name, line, column, -1}, std::move(message), "write SECONDS BIT 0 or 1"});
        };
        if (words.empty()) {
            continue;
        }
        InputChange change;
        const PlcBit bit = words.size() > 1 ? input_of(words[1].text) : no_bit;
        if (!read_real(words[0].text, change.seconds) || change.seconds < 0.0) {
            fail(0, fmt::format("\"{}\" is not a time in seconds", words[0].text));
        } else if (!read.changes.empty() && change.seconds < read.changes.back().seconds) {
            fail(0, fmt::format("{} is earlier than the line above", words[0].text));
        } else if (bit == no_bit) {
            fail(1, "an input, I0 to I31, is missing");
        } else if (words.size() != 3 || (words[2].text != "0" && words[2].text != "1")) {
            fail(2, "a 0 or 1 is missing");
        } else {
            change.bit = bit;
            change.value = words[2].text == "1";
            read.changes.push_back(change);
        }
    }
    return read;
}

} // namespace millwright::cordic
