#include "core/cordic/plc.h"

#include "core/cordic/internal/line_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
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

struct NamedOp {
    std::string_view name;
    PlcOp op;
};

constexpr std::array<NamedOp, 19> ops{{
    {"LD", PlcOp::load},       {"LDN", PlcOp::load_not}, {"AND", PlcOp::and_},     {"ANDN", PlcOp::and_not},
    {"OR", PlcOp::or_},        {"ORN", PlcOp::or_not},   {"XOR", PlcOp::xor_},     {"AND(", PlcOp::and_open},
    {"OR(", PlcOp::or_open},   {")", PlcOp::close},      {"NOT", PlcOp::not_},     {"ST", PlcOp::store},
    {"STN", PlcOp::store_not}, {"S", PlcOp::set},        {"R", PlcOp::reset},      {"TON", PlcOp::on_delay},
    {"TOF", PlcOp::off_delay}, {"TP", PlcOp::pulse},     {"CTU", PlcOp::count_up},
}};

bool has_operand(PlcOp op) {
    return op != PlcOp::not_ && op != PlcOp::close;
}

bool is_timer(PlcOp op) {
    return op == PlcOp::on_delay || op == PlcOp::off_delay || op == PlcOp::pulse;
}

bool is_in(PlcBit bit, char letter) {
    const auto* const area = std::ranges::find(areas, letter, &Area::letter);
    return bit >= area->begin && bit < area->begin + area->count;
}

bool writes(PlcOp op) {
    return op == PlcOp::store || op == PlcOp::store_not || op == PlcOp::set || op == PlcOp::reset;
}

std::string capital(std::string_view text) {
    std::string made(text);
    std::ranges::transform(made, made.begin(), [](char c) {
        return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    });
    return made;
}

class PlcAssembler {
public:
    explicit PlcAssembler(std::filesystem::path name) : name_(std::move(name)) {}

    PlcProgram assemble(std::string_view text) {
        while (!text.empty()) {
            ++line_;
            words_ = words_of(take_line(text));
            at_ = 0;
            if (!words_.empty()) {
                read_line();
            }
        }
        for (const Open& open : open_) {
            line_ = open.line;
            fail(open.word.column, fmt::format("{} is not closed", open.word.text));
        }
        if (made_.instructions.size() > most_plc_instructions) {
            fail(1, fmt::format("more than {} instructions", most_plc_instructions));
        }
        return std::move(made_);
    }

private:
    struct Open {
        LineWord word;
        int line = 0;
    };

    [[nodiscard]] int column() const {
        const LineWord& last = words_.back();
        return at_ < words_.size() ? words_[at_].column : last.column + static_cast<int>(last.text.size());
    }
    void fail(int column, std::string message, std::string hint = {}) {
        made_.errors.push_back({{name_, line_, column, -1}, std::move(message), std::move(hint)});
    }

    void read_line() {
        const LineWord word = words_[at_++];
        const auto* const known = std::ranges::find(ops, capital(word.text), &NamedOp::name);
        if (known == ops.end()) {
            return fail(
                word.column,
                fmt::format("\"{}\" is no instruction", word.text),
                "LD, LDN, AND, ANDN, OR, ORN, XOR, NOT, AND(, OR(, ), ST, STN, S, R, TON, TOF, TP, CTU");
        }
        PlcInstruction made{.op = known->op};
        if (!nest(made.op, word) || !read_operand(made)) {
            return;
        }
        if (at_ < words_.size()) {
            return fail(column(), fmt::format("\"{}\" is too much", words_[at_].text));
        }
        made_.instructions.push_back(made);
    }

    bool nest(PlcOp op, const LineWord& word) {
        if (op == PlcOp::and_open || op == PlcOp::or_open) {
            open_.push_back({word, line_});
            if (open_.size() > plc_nesting) {
                fail(word.column, fmt::format("more than {} parentheses in one another", plc_nesting));
                return false;
            }
        } else if (op == PlcOp::close) {
            if (open_.empty()) {
                fail(word.column, "nothing is open that could be closed");
                return false;
            }
            open_.pop_back();
        }
        return true;
    }

    bool read_operand(PlcInstruction& made) {
        if (!has_operand(made.op)) {
            return true;
        }
        const auto bit = at_ < words_.size() ? plc_bit(words_[at_].text) : std::nullopt;
        if (!bit) {
            fail(column(),
                 at_ < words_.size() ? fmt::format("\"{}\" is no bit", words_[at_].text) : "a bit is missing",
                 "I0 to I31, Q0 to Q31, M0 to M63, T0 to T15, C0 to C15, U100 to U199, or one with a name");
            return false;
        }
        made.bit = *bit;
        const bool counter_reset = made.op == PlcOp::reset && is_in(*bit, 'C');
        if (writes(made.op) && !plc_writes(*bit) && !counter_reset) {
            fail(column(), fmt::format("{} is not for the logic to set", plc_name(*bit)));
            return false;
        }
        if (is_timer(made.op) && !is_in(*bit, 'T')) {
            fail(column(), fmt::format("{} is no timer", plc_name(*bit)));
            return false;
        }
        if (made.op == PlcOp::count_up && !is_in(*bit, 'C')) {
            fail(column(), fmt::format("{} is no counter", plc_name(*bit)));
            return false;
        }
        ++at_;
        return is_timer(made.op) || made.op == PlcOp::count_up ? read_preset(made) : true;
    }

    /// Behind a comma: ms of a timer, or a count.
    bool read_preset(PlcInstruction& made) {
        constexpr double us_a_ms = 1000.0;
        constexpr double most = 1e9;
        const bool timer = is_timer(made.op);
        const bool there = at_ + 1 < words_.size() && words_[at_].text == ",";
        at_ += there ? 1 : 0;
        double value = 0.0;
        const std::string_view text = at_ < words_.size() ? words_[at_].text : std::string_view();
        const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = timer || !(std::floor(value) < value);
        if (!there || fault != std::errc{} || stop != text.data() + text.size() || !(value >= 0.0) ||
            !(value <= most) || !whole) {
            fail(column(),
                 timer ? "a comma and a time in ms are missing" : "a comma and a count are missing");
            return false;
        }
        made.preset = std::llround(timer ? us_a_ms * value : value);
        ++at_;
        return true;
    }

    std::filesystem::path name_;
    PlcProgram made_;
    std::vector<LineWord> words_;
    std::size_t at_ = 0;
    int line_ = 0;
    std::vector<Open> open_;
};

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

bool plc_writes(PlcBit bit) {
    return is_in(bit, 'Q') || is_in(bit, 'M') || bit >= plc_hold;
}

bool plc_is_input(PlcBit bit) {
    return is_in(bit, 'I');
}

PlcProgram assemble_plc(std::string_view text, const std::filesystem::path& name) {
    return PlcAssembler(name).assemble(text);
}

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
        case PlcOp::load:
            result = bit;
            break;
        case PlcOp::load_not:
            result = !bit;
            break;
        case PlcOp::and_:
            result = result && bit;
            break;
        case PlcOp::and_not:
            result = result && !bit;
            break;
        case PlcOp::or_:
            result = result || bit;
            break;
        case PlcOp::or_not:
            result = result || !bit;
            break;
        case PlcOp::xor_:
            result = result != bit;
            break;
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
        case PlcOp::not_:
            result = !result;
            break;
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
        }
    }
}

} // namespace millwright::cordic
