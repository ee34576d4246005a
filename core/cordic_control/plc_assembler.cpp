#include "core/cordic_control/plc_assembler.h"

#include "core/base/text.h"
#include "core/cordic/line_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::cordic {
namespace {

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

bool writes(PlcOp op) {
    return op == PlcOp::store || op == PlcOp::store_not || op == PlcOp::set || op == PlcOp::reset;
}

class PlcAssembler {
public:
    explicit PlcAssembler(std::filesystem::path name) : name_(std::move(name)) {}

    PlcProgram assemble(std::string_view text) {
        if (auto fault = wide_text_fault(text, name_)) {
            made_.errors.push_back(std::move(*fault));
            return std::move(made_);
        }
        text = without_byte_order_mark(text);
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
            fail(1, fmt::format("there are more than {} instructions", most_plc_instructions));
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
                fmt::format("\"{}\" is not an instruction", word.text),
                "LD, LDN, AND, ANDN, OR, ORN, XOR, NOT, AND(, OR(, ), ST, STN, S, R, TON, TOF, TP, CTU");
        }
        PlcInstruction made{.op = known->op};
        if (!nest(made.op, word) || !read_operand(made)) {
            return;
        }
        if (at_ < words_.size()) {
            return fail(column(), fmt::format("unexpected \"{}\"", words_[at_].text));
        }
        made_.instructions.push_back(made);
    }

    bool nest(PlcOp op, const LineWord& word) {
        if (op == PlcOp::and_open || op == PlcOp::or_open) {
            open_.push_back({word, line_});
            if (open_.size() > plc_nesting) {
                fail(word.column, fmt::format("parentheses are nested more than {} deep", plc_nesting));
                return false;
            }
        } else if (op == PlcOp::close) {
            if (open_.empty()) {
                fail(word.column, "there is no open parenthesis to close");
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
                 at_ < words_.size() ? fmt::format("\"{}\" is not a bit", words_[at_].text)
                                     : "a bit is missing",
                 "use I0 to I31, Q0 to Q31, M0 to M63, T0 to T15, C0 to C15, U100 to U199, or a name");
            return false;
        }
        made.bit = *bit;
        const bool counter_reset = made.op == PlcOp::reset && plc_is_counter(*bit);
        if (writes(made.op) && !plc_writes(*bit) && !counter_reset) {
            fail(column(), fmt::format("{} cannot be set by the logic", plc_name(*bit)));
            return false;
        }
        if (is_timer(made.op) && !plc_is_timer(*bit)) {
            fail(column(), fmt::format("{} is not a timer", plc_name(*bit)));
            return false;
        }
        if (made.op == PlcOp::count_up && !plc_is_counter(*bit)) {
            fail(column(), fmt::format("{} is not a counter", plc_name(*bit)));
            return false;
        }
        ++at_;
        return is_timer(made.op) || made.op == PlcOp::count_up ? read_preset(made) : true;
    }

    /// Behind a comma: ms of a timer, or a count.
    bool read_preset(PlcInstruction& made) {
        constexpr double us_per_ms = 1000.0;
        constexpr double most = 1e9;
        const bool timer = is_timer(made.op);
        const bool there = at_ + 1 < words_.size() && words_[at_].text == ",";
        at_ += there ? 1 : 0;
        double value = 0.0;
        const std::string_view text = at_ < words_.size() ? words_[at_].text : std::string_view();
        const bool in_range = read_real(text, value) && value >= 0.0 && value <= most;
        const bool whole = timer || !(std::floor(value) < value);
        if (!there || !in_range || !whole) {
            fail(column(),
                 timer ? "a comma and a time in ms are expected" : "a comma and a count are expected");
            return false;
        }
        made.preset = std::llround(timer ? us_per_ms * value : value);
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

PlcProgram assemble_plc(std::string_view text, const std::filesystem::path& name) {
    return PlcAssembler(name).assemble(text);
}

} // namespace millwright::cordic
