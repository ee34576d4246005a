// The memory of a PMAC as M-variables see it: words of 24 bits on two sides X and Y, those from $D000 shared
// with the host (dual-ported RAM), some of them registers.
#pragma once

#include "core/pmac/emulator/internal/lexer.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace millwright::pmac::card {

constexpr std::uint32_t word_mask = 0xFFFFFF;
constexpr int greatest_address = 0xFFFF;

/// Addresses behind which there is more than memory.
class Registers {
public:
    virtual ~Registers() = default;
    /// `side` is X or Y. Nothing: it is memory.
    [[nodiscard]] virtual std::optional<std::uint32_t> read(char side, int address) const = 0;
    /// Whether it was one.
    virtual bool write(char side, int address, std::uint32_t value) = 0;
};

/// M{n}->X:$C000,20,1,S
struct Pointer {
    enum class Kind { none, x, y, both, dual_ported };

    Kind kind = Kind::none; ///< none: a variable of its own, as after M{n}->*
    int address = 0;
    int bit = 0, width = 24;
    bool is_signed = false;
    std::string text = "*"; ///< as it is reported
};

/// Behind "->"; nullopt if it is no pointer.
[[nodiscard]] std::optional<Pointer> take_pointer(Words& words);

class MemoryMap {
public:
    static constexpr int dual_ported_begin = 0xD000, dual_ported_end = 0xE000;

    explicit MemoryMap(Registers& registers) : registers_(&registers), pointers_(1024), own_(1024) {}

    [[nodiscard]] std::uint32_t word(char side, int address) const;
    void set_word(char side, int address, std::uint32_t value);

    [[nodiscard]] const Pointer& pointer(int index) const {
        return pointers_[static_cast<std::size_t>(index)];
    }
    void point(int index, const Pointer& pointer) { pointers_[static_cast<std::size_t>(index)] = pointer; }
    [[nodiscard]] double value(int index) const;
    void set_value(int index, double value);

    // The host's side of the dual-ported RAM: offsets in bytes, words of 16 and 32 bits, low byte first.
    [[nodiscard]] std::uint16_t host_16(int offset) const;
    void set_host_16(int offset, std::uint16_t value);
    [[nodiscard]] std::int32_t host_32(int offset) const;
    void set_host_32(int offset, std::int32_t value);

private:
    Registers* registers_;
    std::unordered_map<int, std::array<std::uint32_t, 2>> words_; ///< X, Y
    std::vector<Pointer> pointers_;
    std::vector<double> own_;
};

} // namespace millwright::pmac::card
