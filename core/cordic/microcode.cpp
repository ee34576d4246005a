#include "core/cordic/microcode.h"

#include "core/base/text.h"
#include "core/cordic/line_words.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::cordic {
namespace {

constexpr std::array<std::string_view, 5> condition_names = {
    "never", "always", "bus_busy", "chords_left", "last_byte_left"};

constexpr std::array<std::string_view, control_count> control_names = {
    "read_program", "load_opcode", "shift_byte",  "store_register", "take_end",      "take_position",
    "publish",      "count_chord", "fold_radius", "fold_move",      "load_speed",    "rotate",
    "vector",       "rotate_both", "correct",     "correct_both",   "unfold_radius", "unfold_speed",
    "write_byte",   "halt",        "take_height", "fold_space",     "fold_rise",     "unfold_rise",
    "command",      "add_rise",    "next_page",   "take_address",   "read_data",     "shift_data",
    "write_data"};

/// Whether an operation says nothing without a condition.
bool tests_condition(MicroOp op) {
    switch (op) {
    case MicroOp::JZ:
    case MicroOp::JMAP:
    case MicroOp::RFCT:
    case MicroOp::RPCT:
    case MicroOp::LDCT:
    case MicroOp::CONT:
        return false;
    default:
        return true;
    }
}

/// Whether an operation uses the branch field.
bool has_branch(MicroOp op) {
    switch (op) {
    case MicroOp::CJS:
    case MicroOp::CJP:
    case MicroOp::CJV: // where its table begins
    case MicroOp::PUSH:
    case MicroOp::JSRP:
    case MicroOp::JRP:
    case MicroOp::RPCT:
    case MicroOp::CJPP:
    case MicroOp::LDCT:
    case MicroOp::TWB:
        return true;
    default:
        return false;
    }
}

/// A branch whose address is not known before all lines are read.
struct OpenBranch {
    int address = 0;
    LineWord word{};
    int line = 0;
};

struct OpenMap {
    int first = 0;
    int last = 0;
    LineWord label{};
    int line = 0;
};

class MicroAssembler {
public:
    MicroAssembler(std::filesystem::path name, std::span<const std::pair<std::string, int>> constants)
        : name_(std::move(name)), constants_(constants) {}

    AssembledMicroprogram assemble(std::string_view text) {
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
        close_branches();
        close_maps();
        if (result_.program.count == 0 && result_.errors.empty()) {
            fail(1, 1, "the microprogram has no words", "put the instruction fetch at address 0");
        }
        return std::move(result_);
    }

private:
    void fail(int line, int column, std::string message, std::string hint = {}) {
        result_.errors.push_back({{name_, line, column, -1}, std::move(message), std::move(hint)});
    }
    void fail(const LineWord& word, std::string message, std::string hint = {}) {
        fail(line_, word.column, std::move(message), std::move(hint));
    }
    [[nodiscard]] bool more() const { return at_ < words_.size(); }
    [[nodiscard]] bool next_is(std::string_view text) const { return more() && words_[at_].text == text; }
    LineWord take() { return words_[at_++]; }
    [[nodiscard]] int end_column() const {
        return words_.empty() ? 1 : words_.back().column + static_cast<int>(words_.back().text.size());
    }

    void read_line() {
        if (words_.size() >= 2 && words_[1].text == ":") {
            define_label(take());
            ++at_;
        }
        if (!more()) {
            return;
        }
        if (words_[at_].text == ".map") {
            read_map();
        } else {
            read_word();
        }
    }

    void define_label(const LineWord& word) {
        const std::string label(word.text);
        if (!is_name(word.text)) {
            fail(word,
                 fmt::format("\"{}\" is not a label", word.text),
                 "use a letter, followed by letters, digits and _");
        } else if (result_.program.count >= micro_rom_size) {
            fail(word, fmt::format("label {} is after the end of the ROM", label));
        } else if (!result_.program.labels.emplace(label, static_cast<std::uint8_t>(result_.program.count))
                        .second) {
            fail(word, fmt::format("label {} is already defined", label));
        }
    }

    /// .map OPCODE [OPCODE] LABEL
    void read_map() {
        take();
        OpenMap open{.line = line_};
        if (!read_opcode(open.first)) {
            return;
        }
        open.last = open.first;
        long long number = 0;
        if (more() && read_number(words_[at_].text, number) && !read_opcode(open.last)) {
            return;
        }
        if (!more() || !is_name(words_[at_].text)) {
            fail(line_, end_column(), ".map needs a label after the opcode");
            return;
        }
        open.label = take();
        refuse_rest();
        if (open.last < open.first) {
            fail(open.label, "the last opcode is below the first");
            return;
        }
        maps_.push_back(open);
    }
    bool read_opcode(int& opcode) {
        long long number = 0;
        if (!more() || !read_number(words_[at_].text, number) || number < 0 || number > 255) {
            fail(line_, more() ? words_[at_].column : end_column(), ".map needs an opcode from 0 to 255");
            return false;
        }
        opcode = static_cast<int>(number);
        ++at_;
        return true;
    }

    void read_word() {
        const LineWord name = take();
        const auto op = micro_op_of(name.text);
        if (!op) {
            fail(name, fmt::format("\"{}\" is not a micro-operation", name.text));
            return;
        }
        MicroWord word{.op = *op};
        if (tests_condition(*op) && !read_condition(word)) {
            return;
        }
        if (has_branch(*op) && !read_branch()) {
            return;
        }
        if (next_is("|") && !read_controls(word)) {
            return;
        }
        refuse_rest();
        if (result_.program.count >= micro_rom_size) {
            fail(name, fmt::format("the ROM only holds {} words", micro_rom_size));
            return;
        }
        const auto at = static_cast<std::size_t>(result_.program.count++);
        result_.program.words[at] = word;
        result_.program.lines[at] = line_;
    }
    bool read_condition(MicroWord& word) {
        const auto* found = condition_names.end();
        if (more()) {
            found = std::ranges::find(condition_names, words_[at_].text);
        }
        if (found == condition_names.end()) {
            fail(line_,
                 more() ? words_[at_].column : end_column(),
                 fmt::format("{} needs a condition", to_text(word.op)),
                 "use never, always, bus_busy, chords_left or last_byte_left");
            return false;
        }
        ++at_;
        word.condition = static_cast<Condition>(found - condition_names.begin());
        return true;
    }
    bool read_branch() {
        if (!more() || next_is("|")) {
            fail(line_, more() ? words_[at_].column : end_column(), "a branch address or count is missing");
            return false;
        }
        branches_.push_back({result_.program.count, take(), line_});
        return true;
    }
    bool read_controls(MicroWord& word) {
        take();
        do {
            const auto* found = control_names.end();
            if (more()) {
                found = std::ranges::find(control_names, words_[at_].text);
            }
            if (found == control_names.end()) {
                fail(line_,
                     more() ? words_[at_].column : end_column(),
                     more() ? fmt::format("\"{}\" is not a control signal", words_[at_].text)
                            : std::string("a control signal is missing"));
                return false;
            }
            ++at_;
            word.controls |= bit_of(static_cast<Control>(found - control_names.begin()));
        } while (next_is(",") && ++at_ != 0);
        return true;
    }
    void refuse_rest() {
        if (more()) {
            fail(words_[at_], fmt::format("unexpected \"{}\"", words_[at_].text));
        }
    }

    void close_branches() {
        for (const OpenBranch& open : branches_) {
            if (open.address >= micro_rom_size) {
                continue; // said already
            }
            std::uint8_t& branch = result_.program.words[static_cast<std::size_t>(open.address)].branch;
            const auto label = result_.program.labels.find(std::string(open.word.text));
            const auto constant =
                std::ranges::find(constants_, open.word.text, &std::pair<std::string, int>::first);
            long long number = 0;
            if (label != result_.program.labels.end()) {
                branch = label->second;
            } else if (constant != constants_.end()) {
                branch = static_cast<std::uint8_t>(constant->second);
            } else if (!read_number(open.word.text, number)) {
                fail(open.line, open.word.column, fmt::format("label {} is not defined", open.word.text));
            } else if (number < 0 || number > 255) {
                fail(open.line, open.word.column, fmt::format("{} must be from 0 to 255", open.word.text));
            } else {
                branch = static_cast<std::uint8_t>(number);
            }
        }
    }
    void close_maps() {
        for (const OpenMap& open : maps_) {
            const auto label = result_.program.labels.find(std::string(open.label.text));
            if (label == result_.program.labels.end()) {
                fail(open.line, open.label.column, fmt::format("label {} is not defined", open.label.text));
                continue;
            }
            for (int opcode = open.first; opcode <= open.last; ++opcode) {
                auto& entry = result_.program.map[static_cast<std::size_t>(opcode)];
                if (entry) {
                    fail(open.line,
                         open.label.column,
                         fmt::format("opcode {:#04x} is already mapped", opcode));
                }
                entry = label->second;
            }
        }
    }

    std::filesystem::path name_;
    std::span<const std::pair<std::string, int>> constants_;
    AssembledMicroprogram result_;
    std::vector<LineWord> words_;
    std::size_t at_ = 0;
    int line_ = 0;
    std::vector<OpenBranch> branches_;
    std::vector<OpenMap> maps_;
};

} // namespace

std::string_view to_text(Condition condition) {
    return condition_names[static_cast<std::size_t>(condition)];
}

std::string_view to_text(Control control) {
    return control_names[static_cast<std::size_t>(control)];
}

AssembledMicroprogram assemble_microprogram(std::string_view text,
                                            const std::filesystem::path& name,
                                            std::span<const std::pair<std::string, int>> constants) {
    return MicroAssembler(name, constants).assemble(text);
}

std::string listing(const Microprogram& program) {
    std::string text;
    for (int address = 0; address < program.count; ++address) {
        const MicroWord& word = program.words[static_cast<std::size_t>(address)];
        std::string label;
        for (const auto& [name, at] : program.labels) {
            if (at == address) {
                label = fmt::format("{}:", name);
            }
        }
        text += fmt::format("{:02x}  {:<10} {:<5}{:<15}{:<4}",
                            address,
                            label,
                            to_text(word.op),
                            tests_condition(word.op) ? to_text(word.condition) : "",
                            has_branch(word.op) ? fmt::format("{:02x}", word.branch) : "");
        for (int n = 0; n < control_count; ++n) {
            if ((word.controls & bit_of(static_cast<Control>(n))) != 0) {
                text += fmt::format(" {}", control_names[static_cast<std::size_t>(n)]);
            }
        }
        text += '\n';
    }
    return text;
}

} // namespace millwright::cordic
