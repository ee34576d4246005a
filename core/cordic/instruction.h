// The processor's instructions as bytes. The thesis names them (Mov, G00 to G03) and leaves their bits open;
// the encoding is ours: docs/reference/cordic.md#instructions.
#pragma once

#include "core/cordic/arithmetic.h"
#include "core/cordic/bus.h"
#include "core/cordic/number_format.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace millwright::cordic {

/// The thirteen registers of the thesis, and ours behind them: Z, where a line in space ends or what a
/// helix's chord rises; Z0, where the
/// third axis is; P, the parameter of commands; Vz and Az. N, PC and P hold whole numbers, the others numbers
/// of the format.
enum class Register : std::uint8_t {
    XI,
    YJ,
    Vmax,
    Amax,
    Dz,
    N,
    X0,
    Y0,
    Vx,
    Vy,
    Ax,
    Ay,
    PC,
    Z,
    Z0,
    P,
    Vz,
    Az
};

inline constexpr int register_count = 18;
inline constexpr int loaded_register_count = 16; ///< those that Mov can load

[[nodiscard]] std::string_view to_text(Register name);
/// Upper and lower case alike.
[[nodiscard]] std::optional<Register> register_of(std::string_view name);
[[nodiscard]] constexpr bool is_whole(Register name) {
    return name == Register::N || name == Register::PC || name == Register::P;
}
/// Whether a motion needs it above 0.
[[nodiscard]] constexpr bool is_limit(Register name) {
    return name == Register::Vmax || name == Register::Amax;
}
/// The greatest number of a register of whole numbers.
[[nodiscard]] constexpr Word most_of(Register name) {
    return name == Register::PC ? 0xffffU : 0xffffffffU;
}

enum class Opcode : std::uint8_t {
    nop = 0x00,
    hlt = 0x01,
    page = 0x02, ///< goes on at the start of the next page of the program ROM
    mov = 0x10,  ///< + register number; the immediate follows, lowest byte first
    g00 = 0x20,
    g01 = 0x21,
    g02 = 0x22,
    g03 = 0x23,
    g04 = 0x24,  ///< dwell of P microseconds
    g00z = 0x28, ///< line in space to (XI, YJ, Z)
    g01z = 0x29,
    g02z = 0x2a, ///< helix: N chords of Dz about (XI, YJ), each of which rises by Z
    g03z = 0x2b,
    m00 = 0x40, ///< program stop; the M-codes are 0x40 + their number
    m01 = 0x41,
    m02 = 0x42, ///< end: hands the command over and stops
    m03 = 0x43, ///< spindle clockwise at P rpm
    m04 = 0x44,
    m05 = 0x45,
    m06 = 0x46, ///< tool P
    m07 = 0x47,
    m08 = 0x48,
    m09 = 0x49,
    m30 = 0x5e,   ///< as m02
    muser = 0x60, ///< machine-specific command M P, P from 100 to 199
    ld = 0x80,    ///< + register number: from memory; two bytes of address follow, lowest first
    st = 0xa0,    ///< + register number: into memory
};

/// The register that an opcode byte of Mov, Ld or St names; nothing for other bytes.
[[nodiscard]] constexpr std::optional<Register> register_in(std::uint8_t opcode) {
    const auto in_row = [&](Opcode row, int count) {
        const int number = opcode - static_cast<int>(row);
        return number >= 0 && number < count ? std::optional(static_cast<Register>(number)) : std::nullopt;
    };
    const auto loaded = in_row(Opcode::mov, loaded_register_count);
    if (loaded) {
        return loaded;
    }
    const auto from_memory = in_row(Opcode::ld, loaded_register_count);
    return from_memory ? from_memory : in_row(Opcode::st, register_count);
}

/// Name and opcode of every instruction that names no register.
struct NamedOpcode {
    std::string_view name;
    Opcode opcode = Opcode::nop;
};
[[nodiscard]] std::span<const NamedOpcode> named_opcodes();
[[nodiscard]] std::string_view to_text(Opcode opcode);
/// Whether an instruction hands a command to the motion controller, and whether P goes along.
[[nodiscard]] bool is_command(Opcode opcode);
[[nodiscard]] bool takes_parameter(Opcode opcode);

struct Instruction {
    Opcode opcode = Opcode::nop;
    Register target = Register::XI; ///< of mov, ld and st
    Word immediate = 0;             ///< mov: as it stands in the program, not sign-extended; ld, st: address

    friend bool operator==(const Instruction&, const Instruction&) = default;
};

/// 4, or 8 for words of more than 32 bits.
[[nodiscard]] constexpr int immediate_bytes(const NumberFormat& format) {
    return format.word() > 32 ? 8 : 4;
}

inline constexpr int address_bytes = 2; ///< of LD and ST
inline constexpr int command_bytes = 5; ///< opcode and P, as they go over the bus

/// A word as an immediate: its lowest bytes; and back, sign-extended for fixed point.
[[nodiscard]] constexpr Word to_immediate(const NumberFormat& format, Word word) {
    return immediate_bytes(format) == 8 ? word : word & 0xffffffffU;
}
[[nodiscard]] constexpr Word from_immediate(const NumberFormat& format, Word immediate) {
    if (format.kind != NumberKind::fixed || immediate_bytes(format) == 8) {
        return immediate;
    }
    return static_cast<Word>(static_cast<std::int64_t>(static_cast<std::int32_t>(immediate)));
}

/// Bytes behind the opcode.
[[nodiscard]] int operand_bytes(Opcode opcode, const NumberFormat& format);

/// Whether the processor can do what it says: the bits of Mov are a number of the register, of Vmax and Amax
/// above 0, and all bytes of an address are there in one memory, of St outside of the ROM.
[[nodiscard]] bool is_possible(const Instruction& instruction, const NumberFormat& format);

/// At most 8 bytes, lowest first.
[[nodiscard]] Word little_endian(std::span<const std::uint8_t> bytes);

void append(std::vector<std::uint8_t>& code, const Instruction& instruction, const NumberFormat& format);

struct Decoded {
    Instruction instruction;
    int size = 1; ///< bytes
};

/// The instruction at the front of `code`; nullopt if there is no valid one, or not all of it.
[[nodiscard]] std::optional<Decoded> decode(std::span<const std::uint8_t> code, const NumberFormat& format);

/// All pages of the ROM.
inline constexpr std::size_t most_code = std::size_t{rom_size} * most_pages;

/// Where an instruction lies: the page of the ROM above 16 bits of address.
using CodeAddress = std::uint32_t;
[[nodiscard]] constexpr CodeAddress code_address(std::uint8_t page, Word address) {
    return static_cast<CodeAddress>(page) << 16U | static_cast<CodeAddress>(address & 0xffffU);
}
/// Of the byte at `offset` in an image's code.
[[nodiscard]] constexpr CodeAddress code_address_at(std::size_t offset) {
    return code_address(static_cast<std::uint8_t>(offset / rom_size), offset % rom_size);
}
/// How many pages so many bytes of code need.
[[nodiscard]] constexpr std::size_t page_count(std::size_t bytes) {
    return (bytes + rom_size - 1) / rom_size;
}

/// An instruction in memory and the line of the program that it comes from, 0: none.
struct CodeLine {
    CodeAddress address = 0;
    int line = 0;
    int column = 0; ///< from 1; 0: not known
};

/// What the instruction at `address` comes from; nothing known of those in front of the first line. `lines`
/// by ascending address.
[[nodiscard]] CodeLine line_at(std::span<const CodeLine> lines, CodeAddress address);

} // namespace millwright::cordic
