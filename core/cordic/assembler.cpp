#include "core/cordic/assembler.h"

#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/cordic/arithmetic.h"
#include "core/cordic/internal/move_check.h"
#include "core/cordic/line_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace millwright::cordic {
namespace {

class Assembler {
public:
    Assembler(std::filesystem::path name, const NumberFormat& format, const MadeFor& made_for)
        : name_(std::move(name)) {
        result_.image.format = format;
        result_.image.made_for = made_for;
    }

    Assembled assemble(std::string_view text) {
        if (auto fault = wide_text_fault(text, name_)) {
            result_.errors.push_back(std::move(*fault));
            return std::move(result_);
        }
        text = without_byte_order_mark(text);
        while (!text.empty()) {
            ++line_;
            words_ = words_of(take_line(text));
            at_ = 0;
            read_line();
        }
        close_labels();
        if (const std::size_t size = result_.image.code.size(); size > most_code) {
            fail(0, fmt::format("the program has {} bytes, but the ROM holds {}", size, most_code));
        }
        return std::move(result_);
    }

private:
    struct OpenLabel {
        std::size_t at = 0; ///< of the immediate
        std::string name{};
        int line = 0;
        int column = 0;
    };

    [[nodiscard]] bool more() const { return at_ < words_.size(); }
    [[nodiscard]] int column() const {
        if (more()) {
            return words_[at_].column;
        }
        return words_.empty() ? 1 : words_.back().column + static_cast<int>(words_.back().text.size());
    }
    void fail(int at, std::string message, std::string hint = {}) {
        result_.errors.push_back({{name_, line_, at, -1}, std::move(message), std::move(hint)});
    }

    void read_line() {
        if (words_.size() >= 2 && words_[1].text == ":") {
            define_label();
            at_ = 2;
        }
        if (!more()) {
            return;
        }
        const LineWord word = words_[at_++];
        const std::string name = capital(word.text);
        const auto known = std::ranges::find(named_opcodes(), name, &NamedOpcode::name);
        if (known != named_opcodes().end()) {
            add({.opcode = known->opcode}, word.column);
        } else if (name == "MOV") {
            read_mov(word.column);
        } else if (name == "LD" || name == "ST") {
            read_transfer(name == "LD" ? Opcode::ld : Opcode::st, word.column);
        } else if (name == ".FORMAT" || name == ".ITERATIONS" || name == ".ROUNDING" ||
                   name == ".DIRECTION" || name == ".ZERO") {
            read_setting(name, word.text);
        } else if (name == ".BYTE") {
            read_byte(word.column);
        } else if (name == ".PAGE") {
            fill_page();
        } else {
            fail(word.column,
                 fmt::format("\"{}\" is not an instruction", word.text),
                 "use MOV, LD, ST, G00 to G04, G00Z to G03Z, M00 to M09, M30, MUSER, PAGE, NOP or HLT");
            return;
        }
        if (more() && (result_.errors.empty() || result_.errors.back().place.line != line_)) {
            fail(column(), fmt::format("unexpected \"{}\"", words_[at_].text));
        }
    }

    void define_label() {
        if (!is_name(words_[0].text)) {
            fail(words_[0].column, fmt::format("\"{}\" is not a label", words_[0].text));
        } else if (!labels_.emplace(std::string(words_[0].text), result_.image.code.size()).second) {
            fail(words_[0].column, fmt::format("label {} is already defined", words_[0].text));
        }
        moves_.forget();
    }

    /// What the whole program is made for.
    void read_setting(std::string_view name, std::string_view written) {
        if (!more()) {
            fail(column(), fmt::format("a value is missing after {}", written));
            return;
        }
        if (begun_) {
            fail(column(), fmt::format("{} must come before the first instruction", written));
            return;
        }
        MadeFor& made_for = result_.image.made_for;
        const std::string_view value = words_[at_].text;
        try {
            if (name == ".FORMAT") {
                result_.image.format = parse_number_format(value);
            } else if (name == ".ITERATIONS") {
                made_for.iterations = parse_iterations(value);
            } else if (name == ".ROUNDING") {
                made_for.rounding = parse_rounding(value);
            } else if (name == ".DIRECTION") {
                made_for.sense = parse_arc_sense(value);
            } else {
                made_for.zero = parse_sign_of_zero(value);
            }
        } catch (const Error& error) {
            fail(column(), error.diagnostic().message, error.diagnostic().hint);
        }
        ++at_;
    }

    void add(const Instruction& instruction, int column) {
        std::vector<std::uint8_t>& code = result_.image.code;
        const std::size_t at = code.size();
        append(code, instruction, result_.image.format);
        if (const auto idle = moves_.idle(instruction); !idle.empty()) {
            result_.warnings.push_back({{name_, line_, column, -1}, std::string(idle), {}});
        }
        if (at / rom_size != (code.size() - 1) / rom_size) {
            fail(column,
                 "the instruction crosses the end of a program ROM page",
                 "insert PAGE and .page before it");
        }
        result_.lines.push_back({code_address_at(at), line_, column});
        begun_ = true;
    }

    /// As an erased ROM is.
    void fill_page() {
        std::vector<std::uint8_t>& code = result_.image.code;
        if (code.size() < most_code) { // else there are errors enough
            code.resize((code.size() / rom_size + 1) * rom_size, 0xff);
        }
        begun_ = true;
    }

    void read_byte(int byte_column) {
        long long number = 0;
        if (!more() || !read_number(words_[at_].text, number) || number < 0 || number > 255) {
            fail(column(), ".byte needs a number from 0 to 255");
            return;
        }
        ++at_;
        begun_ = true;
        moves_.forget();
        result_.lines.push_back({code_address_at(result_.image.code.size()), line_, byte_column});
        result_.image.code.push_back(static_cast<std::uint8_t>(number));
    }

    /// REGISTER and comma; something stands behind them.
    std::optional<Register> read_register(bool is_loaded) {
        const auto target = more() ? register_of(words_[at_].text) : std::nullopt;
        if (!target) {
            fail(column(),
                 more() ? fmt::format("\"{}\" is not a register", words_[at_].text)
                        : "a register is missing");
            return std::nullopt;
        }
        if (is_loaded && static_cast<int>(*target) >= loaded_register_count) {
            fail(column(), fmt::format("{} is a computed register and cannot be loaded", to_text(*target)));
            return std::nullopt;
        }
        ++at_;
        if (!more() || words_[at_].text != ",") {
            fail(column(), "a comma is missing after the register");
            return std::nullopt;
        }
        ++at_;
        if (!more()) {
            fail(column(), "a number is missing");
            return std::nullopt;
        }
        return target;
    }
    void read_mov(int mov_column) {
        const auto target = read_register(true);
        const auto immediate = target ? immediate_of(*target, words_[at_]) : std::nullopt;
        if (!immediate) {
            return;
        }
        const Instruction instruction{Opcode::mov, *target, *immediate};
        if (is_possible(instruction, result_.image.format)) {
            ++at_;
            add(instruction, mov_column);
        } else if (is_limit(*target)) {
            fail(column(), fmt::format("{} must be above 0", to_text(*target)));
        } else {
            fail(
                column(),
                fmt::format("\"{}\" is not a number in {}", words_[at_].text, to_text(result_.image.format)));
        }
    }
    /// LD or ST of a register at an address.
    void read_transfer(Opcode opcode, int opcode_column) {
        const auto target = read_register(opcode == Opcode::ld);
        const auto address = target ? address_of(opcode, words_[at_]) : std::nullopt;
        if (!address) {
            return;
        }
        const Instruction instruction{opcode, *target, *address};
        if (!is_possible(instruction, result_.image.format)) {
            const int size = immediate_bytes(result_.image.format);
            const bool crosses = crosses_memories(static_cast<std::uint16_t>(*address), size) &&
                                 (opcode == Opcode::ld || *address >= ram_begin);
            fail(column(),
                 fmt::format("{} bytes at \"{}\" {}",
                             size,
                             words_[at_].text,
                             crosses ? "cross the border between two memories"
                             : opcode == Opcode::ld
                                 ? "are not all on the bus"
                                 : "are not all in the RAM or the motion controller's port"));
            return;
        }
        ++at_;
        add(instruction, opcode_column);
    }
    /// A number; of LD also a label of this page.
    std::optional<Word> address_of(Opcode opcode, const LineWord& word) {
        if (is_name(word.text) && opcode == Opcode::ld) { // labels lie in the ROM
            open_.push_back({result_.image.code.size() + 1, std::string(word.text), line_, word.column});
            return Word{0};
        }
        long long number = 0;
        if (!read_number(word.text, number) || number < 0 || number > 0xffff) {
            fail(word.column, fmt::format("\"{}\" is not an address from 0 to 65535", word.text));
            return std::nullopt;
        }
        return static_cast<Word>(number);
    }

    /// Bits (0x...), a number of the format, a whole number for N, PC and P, or a label for PC.
    std::optional<Word> immediate_of(Register target, const LineWord& word) {
        const bool bits = word.text.starts_with("0x") || word.text.starts_with("0X");
        if (bits && !is_whole(target)) {
            return bits_of(word);
        }
        if (target == Register::PC && is_name(word.text)) {
            open_.push_back({result_.image.code.size() + 1, std::string(word.text), line_, word.column});
            return Word{0};
        }
        if (is_whole(target)) {
            long long number = 0;
            const auto most = static_cast<long long>(most_of(target));
            if (!read_number(word.text, number) || number < 0 || number > most) {
                fail(word.column, fmt::format("\"{}\" is not a whole number from 0 to {}", word.text, most));
                return std::nullopt;
            }
            return static_cast<Word>(number);
        }
        double value = 0.0;
        if (!read_real(word.text, value)) {
            fail(word.column, fmt::format("\"{}\" is not a number", word.text));
            return std::nullopt;
        }
        bool overflow = false;
        bool vanishes = false;
        const Word number = with_arithmetic(result_.image.format, [&](const auto& arithmetic) {
            const auto held = arithmetic.from_double(value, overflow);
            vanishes = !exactly_equal(value, 0.0) && exactly_equal(arithmetic.to_double(held), 0.0);
            return arithmetic.to_word(held);
        });
        if (vanishes) {
            fail(word.column,
                 fmt::format("{} is below the resolution of {}", word.text, to_text(result_.image.format)),
                 "choose a number format with more fraction bits, or write 0");
            return std::nullopt;
        }
        if (overflow) {
            fail(word.column,
                 fmt::format("{} does not fit into {}", word.text, to_text(result_.image.format)));
            return std::nullopt;
        }
        return to_immediate(result_.image.format, number);
    }
    std::optional<Word> bits_of(const LineWord& word) {
        Word bits = 0;
        const char* const end = word.text.data() + word.text.size();
        const auto [stop, fault] = std::from_chars(word.text.data() + 2, end, bits, 16);
        const bool wide = immediate_bytes(result_.image.format) == 4 && bits > 0xffffffffU;
        if (fault != std::errc{} || stop != end || wide) {
            fail(word.column,
                 fmt::format("\"{}\" is not a hexadecimal number of {} bytes",
                             word.text,
                             immediate_bytes(result_.image.format)));
            return std::nullopt;
        }
        return bits;
    }

    void close_labels() {
        for (const OpenLabel& open : open_) {
            const auto found = labels_.find(open.name);
            line_ = open.line;
            if (found == labels_.end()) {
                fail(open.column, fmt::format("label {} is not defined", open.name));
            } else if (found->second / rom_size != open.at / rom_size) {
                fail(open.column,
                     fmt::format("label {} is in another page of the program ROM", open.name),
                     "use PAGE to continue in the next page");
            } else {
                const std::size_t target = found->second % rom_size;
                result_.image.code[open.at] = static_cast<std::uint8_t>(target);
                result_.image.code[open.at + 1] = static_cast<std::uint8_t>(target >> 8U);
            }
        }
    }

    std::filesystem::path name_;
    Assembled result_;
    std::vector<LineWord> words_;
    std::size_t at_ = 0;
    int line_ = 0;
    bool begun_ = false;
    internal::MoveCheck moves_;
    std::map<std::string, std::size_t> labels_;
    std::vector<OpenLabel> open_;
};

} // namespace

Assembled assemble(std::string_view text,
                   const std::filesystem::path& name,
                   const NumberFormat& format,
                   const MadeFor& made_for) {
    return Assembler(name, format, made_for).assemble(text);
}

} // namespace millwright::cordic
