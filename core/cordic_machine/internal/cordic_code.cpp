#include "core/cordic_machine/internal/cordic_code.h"

#include "core/cordic/arithmetic.h"
#include "core/gcode/word_column.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace millwright::cordic_machine::internal {

using cordic::Opcode;
using cordic::Register;
using cordic::Word;

CordicCode::CordicCode(std::filesystem::path file, const CordicProgramSettings& settings)
    : file_(std::move(file)), settings_(settings) {
    result_.image.format = settings.format;
}

Place CordicCode::place_of(const FaultyWord& word) const {
    if (word.source != now_.place) {
        return {file_, word.source.line, 0, -1}; // asked for by an earlier line, whose text is gone
    }
    const int column = gcode::column_of_word(now_.text, word.letter, word.code);
    return {file_, word.source.line, column > 0 ? column : gcode::first_column(now_.text), -1};
}

bool CordicCode::has_word(gcode::SourcePlace source, char letter, double code) const {
    return source == now_.place && gcode::column_of_word(now_.text, letter, code) > 0;
}

void CordicCode::fault(const FaultyWord& word, std::string message, std::string hint) {
    if (const auto known = times_.find(message); known != times_.end()) {
        ++known->second;
    } else if (result_.faults.size() < settings_.most_faults) {
        times_.emplace(message, 1);
        result_.faults.push_back({place_of(word), std::move(message), std::move(hint)});
    }
}

CordicProgram CordicCode::take() {
    for (Diagnostic& fault : result_.faults) {
        if (const std::int64_t times = times_.at(fault.message); times > 1) {
            fault.message += fmt::format(" (the first of {} times)", times);
        }
    }
    return std::move(result_);
}

void CordicCode::warn(const FaultyWord& word, std::string message, std::string hint) {
    result_.warnings.push_back({place_of(word), std::move(message), std::move(hint)});
}

std::optional<Word> CordicCode::number(double value, std::string_view what, const FaultyWord& word) {
    bool overflow = false;
    const Word bits = cordic::with_arithmetic(settings_.format, [&](const auto& arithmetic) {
        return arithmetic.to_word(arithmetic.from_double(value, overflow));
    });
    if (overflow) {
        fault(word,
              fmt::format("{} {} does not fit into {}", what, value, cordic::to_text(settings_.format)),
              "choose a number format with more integer bits");
        return std::nullopt;
    }
    return bits;
}

double CordicCode::as_held(Word word) const {
    return cordic::with_arithmetic(settings_.format, [&](const auto& arithmetic) {
        return arithmetic.to_double(arithmetic.from_word(word));
    });
}

void CordicCode::add(const cordic::Instruction& instruction) {
    const bool loads = instruction.opcode == Opcode::mov;
    const int size = loads ? 1 + cordic::immediate_bytes(settings_.format) : 1;
    const auto used = static_cast<int>(result_.image.code.size() % cordic::rom_size);
    if (used + size + 1 > cordic::rom_size) { // one byte stays for PAGE
        put({.opcode = Opcode::page});
        result_.image.code.resize(cordic::page_count(result_.image.code.size()) * cordic::rom_size, 0xff);
    }
    put(instruction);
}

/// A program that is too long is not kept for ever.
void CordicCode::put(const cordic::Instruction& instruction) {
    if (result_.image.code.size() <= cordic::most_code) {
        const int column = now_.text.empty() ? 0 : gcode::first_column(now_.text);
        result_.code_lines.push_back(
            {cordic::code_address_at(result_.image.code.size()), now_.place.line, column});
        cordic::append(result_.image.code, instruction, settings_.format);
    }
}

void CordicCode::op(Opcode opcode) {
    add({.opcode = opcode});
}

void CordicCode::mov(Register target, Word word) {
    auto& loaded = loaded_[static_cast<std::size_t>(target)];
    if (loaded != word) {
        const Word immediate = cordic::is_whole(target) ? word : cordic::to_immediate(settings_.format, word);
        add({Opcode::mov, target, immediate});
        loaded = word;
    }
}

void CordicCode::set_loaded(Register target, std::optional<Word> word) {
    loaded_[static_cast<std::size_t>(target)] = word;
}

} // namespace millwright::cordic_machine::internal
