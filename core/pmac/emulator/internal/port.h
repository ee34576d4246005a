// The port of a PMAC: characters that make lines, control characters that act at once, and what is answered
// in the handshake of I3 with the errors of I6 and the checksums of I4.
#pragma once

#include "core/pmac/emulator/internal/commands.h"

#include <optional>
#include <string>
#include <string_view>

namespace millwright::pmac::card {

class Port {
public:
    explicit Port(Card& card) : card_(card), commands_(card), of_programs_(card) {}

    void receive(std::string_view characters);
    [[nodiscard]] std::string take_output();
    /// What programs said and asked.
    void serve_programs();
    /// The card was switched off and on.
    void reset();

private:
    void take(char character);
    void control(char character);
    void control_systems(char character); ///< what acts on the programs of all coordinate systems
    [[nodiscard]] std::optional<std::string> report(char character) const;
    void enter(const std::string& line);
    void answer(const std::vector<std::string>& lines, bool closes);
    void refuse(int error, bool of_program);
    void put_line(const std::string& text);
    [[nodiscard]] int mode(int index) const { return static_cast<int>(card_.i(index)); }

    Card& card_;
    Commands commands_;
    Commands of_programs_; ///< with addresses of their own
    std::string line_, last_line_, output_;
    bool overrun_ = false, bad_character_ = false;
    bool echoes_ = false; ///< full duplex: it repeats what it gets
};

} // namespace millwright::pmac::card
