// Motions of a program that lead nowhere or have no speed, found by following its loads from instruction to
// instruction. Where another way may lead in - a label, a jump, bytes - nothing is known any more.
#pragma once

#include "core/cordic/instruction.h"

#include <array>
#include <optional>
#include <string_view>

namespace millwright::cordic::internal {

class MoveCheck {
public:
    /// All registers are 0 after reset.
    MoveCheck() { known_.fill(Word{0}); }

    void forget() { known_.fill(std::nullopt); }
    /// The next instruction: why its motion leads nowhere or is none; empty if it does, or may.
    [[nodiscard]] std::string_view idle(const Instruction& next);

private:
    [[nodiscard]] std::optional<Word>& at(Register name) { return known_[static_cast<std::size_t>(name)]; }
    [[nodiscard]] bool are_equal(Register a, Register b) { return at(a) && at(a) == at(b); }
    [[nodiscard]] bool is_zero(Register name) { return at(name) == Word{0}; }
    [[nodiscard]] std::string_view with_speed(std::string_view found);
    [[nodiscard]] std::string_view line(bool in_space);
    [[nodiscard]] std::string_view arc(bool rises);

    std::array<std::optional<Word>, register_count> known_{};
};

} // namespace millwright::cordic::internal
