// The lines that linuxcncrsh answers with, taken apart (man page linuxcncrsh, LinuxCNC 2.9).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::drivers::linuxcnc {

struct Reply {
    enum class Kind {
        hello,   ///< HELLO ACK
        refused, ///< HELLO NAK, SET ... NAK or GET ... NAK
        done,    ///< SET ... ACK
        value,   ///< of a get
        other    ///< an echo, or nothing that linuxcncrsh says
    };
    Kind kind = Kind::other;
    std::string subject; ///< in capitals: PROGRAM_LINE
    std::string text;    ///< of a value, as it came
};

/// Any bytes give a reply. `line` is without its end.
[[nodiscard]] Reply read_reply(std::string_view line);

/// Finite numbers in `text`, separated by blanks; nothing if there is anything else.
[[nodiscard]] std::optional<std::vector<double>> read_numbers(std::string_view text);

} // namespace millwright::drivers::linuxcnc
