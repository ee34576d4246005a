#include "core/cordic/disassembler.h"

#include "core/base/text.h"
#include "core/cordic/arithmetic.h"
#include "core/cordic/instruction.h"
#include "core/cordic/line_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace millwright::cordic {
namespace {

/// The shortest number that assembles to these bits, else the bits.
std::string immediate_text(const Instruction& instruction, const NumberFormat& format) {
    std::string bits = fmt::format("{:#x}", instruction.immediate);
    if (is_whole(instruction.target)) {
        return fmt::format("{}", instruction.immediate);
    }
    return with_arithmetic(format, [&](const auto& arithmetic) {
        bool overflow = false;
        const auto number = arithmetic.from_word(from_immediate(format, instruction.immediate));
        const double value = arithmetic.to_double(number);
        const std::string text = format.kind == NumberKind::binary32
                                     ? fmt::format("{}", static_cast<float>(value))
                                     : shortest(value);
        double again = 0.0;
        const bool reads_back =
            read_real(text, again) &&
            to_immediate(format, arithmetic.to_word(arithmetic.from_double(again, overflow))) ==
                instruction.immediate;
        return reads_back && !overflow ? text : bits;
    });
}

std::string instruction_text(const Instruction& instruction, const NumberFormat& format) {
    if (instruction.opcode == Opcode::mov) {
        return fmt::format("MOV {}, {}", to_text(instruction.target), immediate_text(instruction, format));
    }
    const std::string name(to_text(instruction.opcode));
    return operand_bytes(instruction.opcode, format) == 0
               ? name
               : fmt::format("{} {}, {:#06x}", name, to_text(instruction.target), instruction.immediate);
}

/// A page of the ROM, or what there is of the last one, which begins at `offset` of the code.
std::string page_text(std::span<const std::uint8_t> page, std::size_t offset, const NumberFormat& format) {
    std::size_t end = page.size();
    while (page.size() == rom_size && end > 0 && page[end - 1] == 0xff) {
        --end;
    }
    std::string text;
    for (std::size_t at = 0; at < end;) {
        auto found = decode(page.subspan(at, end - at), format);
        if (found && !is_possible(found->instruction, format)) {
            found.reset(); // as bytes, which is what the assembler would take
        }
        const std::string line =
            found ? instruction_text(found->instruction, format) : fmt::format(".byte {:#04x}", page[at]);
        text += fmt::format("        {:<32}; {:04x}\n", line, code_address_at(offset + at));
        at += static_cast<std::size_t>(found ? found->size : 1);
    }
    return end < page.size() ? text + "        .page\n" : text;
}

/// All of them: what is left out would be taken from the options that the text is assembled with.
std::string settings_text(const Image& image) {
    const MadeFor& made_for = image.made_for;
    std::string text;
    const auto add = [&](std::string_view name, std::string_view value) {
        text += fmt::format("        {} {}\n", name, value);
    };
    add(".format", to_text(image.format));
    add(".iterations", made_for.iterations == 0 ? "thesis" : std::to_string(made_for.iterations));
    add(".rounding", to_text(made_for.rounding));
    add(".direction", to_text(made_for.sense));
    add(".zero", to_text(made_for.zero));
    return text;
}

} // namespace

std::string disassemble(const Image& image) {
    std::string text = settings_text(image);
    const std::span<const std::uint8_t> code(image.code);
    for (std::size_t begin = 0; begin < code.size(); begin += rom_size) {
        const std::size_t size = std::min<std::size_t>(rom_size, code.size() - begin);
        text += page_text(code.subspan(begin, size), begin, image.format);
    }
    return text;
}

} // namespace millwright::cordic
