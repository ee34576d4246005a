// The on-line commands of a PMAC: what a line does and what is answered.
#pragma once

#include "core/pmac/emulator/internal/card.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::pmac::card {

/// The error numbers of the manual.
namespace error_code {
constexpr int program_running = 1;
constexpr int unknown_command = 3;
constexpr int bad_character = 4;
constexpr int needs_buffer = 5;
constexpr int no_room = 6;
constexpr int buffer_in_use = 7;
constexpr int bad_structure = 9;
} // namespace error_code

struct Answer {
    std::vector<std::string> lines;
    int error = 0; ///< 0: accepted
};

class Commands {
public:
    explicit Commands(Card& card) : card_(card) {}

    /// Done up to the first command that is refused.
    [[nodiscard]] Answer execute(std::string_view line);
    /// Forgets addresses and closes the buffer, as a reset does.
    void reset();

    // What control characters ask, of all motors or coordinate systems.
    [[nodiscard]] std::string positions() const;
    [[nodiscard]] std::string velocities() const;
    [[nodiscard]] std::string following_errors() const;
    [[nodiscard]] std::string motor_states() const;
    [[nodiscard]] std::string system_states() const;
    [[nodiscard]] std::string global_state() const;
    /// The words whose addresses are I21 to I44, as far as I20 chooses them: in bytes, the highest first.
    [[nodiscard]] std::string gathered() const;
    /// The line that the host has put into the dual-ported RAM.
    [[nodiscard]] std::string shared_line() const;

private:
    enum class Buffer { none, program, rotary, plc };
    using Code = int;

    Code one(Words& words);
    Code symbol(Words& words);
    Code letter(Words& words);
    Code address_motor(Words& words);
    Code define_axis(Words& words, int motor);
    Code dollar(Words& words);

    // commands_motion.cpp
    Code jog(Words& words);
    Code motor_command(Words& words, char letter);
    Code system_command(Words& words, char letter);
    Code begin_at(Words& words);
    Code home(bool zero);
    [[nodiscard]] bool program_has_motor() const;

    // commands_variables.cpp
    Code variable(Words& words);
    Code assign(char kind, int first, int last, Words& words);
    void report(char kind, int index);
    Code pointer(Words& words, int index);
    Code memory(Words& words);

    // commands_buffers.cpp
    std::optional<Code> store(const std::vector<Token>& words);
    Code keyword(Words& words);
    Code undefine(bool all);
    Code home_all_here();
    Code open(Words& words);
    Code clear();
    Code close();
    Code list(Words& words);
    Code plcs(Words& words, bool on);
    Code modal(Words& words);
    [[nodiscard]] bool is_running(int program) const;

    void say(std::string text) { answer_.lines.push_back(std::move(text)); }
    [[nodiscard]] StoredProgram* buffer();
    [[nodiscard]] CoordinateSystem& system() { return card_.system(system_); }
    [[nodiscard]] Motor& motor() { return card_.motor(motor_); }

    Card& card_;
    Answer answer_;
    int motor_ = 0, system_ = 0; ///< addressed, from 0
    Buffer buffer_ = Buffer::none;
    int open_number_ = 0;
};

} // namespace millwright::pmac::card
