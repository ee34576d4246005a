#include "core/cordic/instruction.h"

#include <algorithm>
#include <iterator>

namespace millwright::cordic {
namespace {

constexpr std::array<std::string_view, register_count> register_names = {"XI",
                                                                         "YJ",
                                                                         "Vmax",
                                                                         "Amax",
                                                                         "Dz",
                                                                         "N",
                                                                         "X0",
                                                                         "Y0",
                                                                         "Vx",
                                                                         "Vy",
                                                                         "Ax",
                                                                         "Ay",
                                                                         "PC",
                                                                         "Z",
                                                                         "Z0",
                                                                         "P",
                                                                         "Vz",
                                                                         "Az"};

constexpr std::array<NamedOpcode, 24> plain = {{
    {"NOP", Opcode::nop},   {"HLT", Opcode::hlt},   {"PAGE", Opcode::page}, {"G00", Opcode::g00},
    {"G01", Opcode::g01},   {"G02", Opcode::g02},   {"G03", Opcode::g03},   {"G04", Opcode::g04},
    {"G00Z", Opcode::g00z}, {"G01Z", Opcode::g01z}, {"G02Z", Opcode::g02z}, {"G03Z", Opcode::g03z},
    {"M00", Opcode::m00},   {"M01", Opcode::m01},   {"M02", Opcode::m02},   {"M03", Opcode::m03},
    {"M04", Opcode::m04},   {"M05", Opcode::m05},   {"M06", Opcode::m06},   {"M07", Opcode::m07},
    {"M08", Opcode::m08},   {"M09", Opcode::m09},   {"M30", Opcode::m30},   {"MUSER", Opcode::muser},
}};

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

} // namespace

std::string_view to_text(Register name) {
    return register_names[static_cast<std::size_t>(name)];
}

std::optional<Register> register_of(std::string_view name) {
    const auto same = [&](std::string_view known) {
        return std::ranges::equal(known, name, {}, lower, lower);
    };
    const auto* const found = std::ranges::find_if(register_names, same);
    return found == register_names.end()
               ? std::nullopt
               : std::optional(static_cast<Register>(found - register_names.begin()));
}

std::span<const NamedOpcode> named_opcodes() {
    return plain;
}

std::string_view to_text(Opcode opcode) {
    const auto* const found = std::ranges::find(plain, opcode, &NamedOpcode::opcode);
    if (found != plain.end()) {
        return found->name;
    }
    return opcode < Opcode::ld ? "MOV" : opcode < Opcode::st ? "LD" : "ST";
}

bool is_command(Opcode opcode) {
    return opcode == Opcode::g04 || (opcode >= Opcode::m00 && opcode <= Opcode::muser);
}

bool takes_parameter(Opcode opcode) {
    switch (opcode) {
    case Opcode::g04:
    case Opcode::m03:
    case Opcode::m04:
    case Opcode::m06:
    case Opcode::muser:
        return true;
    default:
        return false;
    }
}

int operand_bytes(Opcode opcode, const NumberFormat& format) {
    switch (opcode) {
    case Opcode::mov:
        return immediate_bytes(format);
    case Opcode::ld:
    case Opcode::st:
        return address_bytes;
    default:
        return 0;
    }
}

namespace {

bool is_number_for(const Instruction& mov, const NumberFormat& format) {
    return with_arithmetic(format, [&](const auto& arithmetic) {
        bool overflow = false;
        const double value =
            arithmetic.to_double(arithmetic.from_word(from_immediate(format, mov.immediate), overflow));
        return !overflow && (!is_limit(mov.target) || value > 0.0);
    });
}

} // namespace

bool is_possible(const Instruction& instruction, const NumberFormat& format) {
    const Word last = instruction.immediate + static_cast<Word>(immediate_bytes(format)) - 1;
    const bool in_one =
        last <= last_address &&
        !crosses_memories(static_cast<std::uint16_t>(instruction.immediate), immediate_bytes(format));
    switch (instruction.opcode) {
    case Opcode::mov:
        return is_whole(instruction.target) ? instruction.immediate <= most_of(instruction.target)
                                            : is_number_for(instruction, format);
    case Opcode::ld:
        return in_one;
    case Opcode::st:
        return in_one && instruction.immediate >= ram_begin;
    default:
        return true;
    }
}

void append(std::vector<std::uint8_t>& code, const Instruction& instruction, const NumberFormat& format) {
    const auto opcode = static_cast<std::uint8_t>(instruction.opcode);
    const int operand = operand_bytes(instruction.opcode, format);
    const unsigned row = operand > 0 ? static_cast<unsigned>(instruction.target) : 0U;
    code.push_back(static_cast<std::uint8_t>(opcode + row));
    for (int byte = 0; byte < operand; ++byte) {
        code.push_back(static_cast<std::uint8_t>(instruction.immediate >> (8 * byte)));
    }
}

Word little_endian(std::span<const std::uint8_t> bytes) {
    Word value = 0;
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        value |= Word{bytes[n]} << (8 * n);
    }
    return value;
}

std::optional<Decoded> decode(std::span<const std::uint8_t> code, const NumberFormat& format) {
    if (code.empty()) {
        return std::nullopt;
    }
    if (const auto target = register_in(code[0])) {
        const auto opcode = static_cast<Opcode>(code[0] - static_cast<unsigned>(*target));
        const auto size = static_cast<std::size_t>(operand_bytes(opcode, format));
        if (code.size() <= size) {
            return std::nullopt;
        }
        return Decoded{{opcode, *target, little_endian(code.subspan(1, size))}, 1 + static_cast<int>(size)};
    }
    for (const NamedOpcode& known : plain) {
        if (code[0] == static_cast<std::uint8_t>(known.opcode)) {
            return Decoded{{.opcode = known.opcode}, 1};
        }
    }
    return std::nullopt;
}

CodeLine line_at(std::span<const CodeLine> lines, CodeAddress address) {
    const auto after = std::ranges::upper_bound(lines, address, {}, &CodeLine::address);
    return after == lines.begin() ? CodeLine{} : *std::prev(after);
}

} // namespace millwright::cordic
