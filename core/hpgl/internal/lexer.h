// Cuts the bytes of an HPGL file into commands: two letters and what belongs to them. Escape sequences of the
// interface, PJL lines and PCL's switches are passed over.
#pragma once

#include "core/base/text.h"
#include "core/hpgl/internal/problems.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace millwright::hpgl::internal {

/// What follows the two letters of a command.
enum class Arguments {
    numbers,   ///< to `;`, the next letter or the end of the file
    label,     ///< to the label terminator
    encoded,   ///< bytes to `;`
    comment,   ///< quoted, or to `;`
    character, ///< one byte and numbers after it
};

struct Command {
    std::string_view name;      ///< two capital letters; empty: a token that is no command, already reported
    std::int64_t byte = 0;      ///< where it begins
    std::string_view arguments; ///< as they stand in the file
    std::int64_t arguments_byte = 0;
    bool terminated = true;                 ///< false: the file ends in the middle of it
    std::optional<std::int64_t> stray = {}; ///< a letter among its numbers that begins no command
};

class Lexer {
public:
    using ArgumentsOf = Arguments (*)(std::string_view name);

    Lexer(std::string_view bytes, ArgumentsOf arguments_of, Problems& problems)
        : bytes_(bytes), arguments_of_(arguments_of), problems_(problems),
          at_(bytes.size() - without_byte_order_mark(bytes).size()) {}

    [[nodiscard]] std::optional<Command> next();

    /// DT: the byte that ends labels, and whether it is drawn itself.
    void end_labels_with(char terminator, bool printed) {
        label_end_ = terminator;
        label_end_printed_ = printed;
    }

private:
    [[nodiscard]] bool at_end() const { return at_ >= bytes_.size(); }
    [[nodiscard]] char look() const { return bytes_[at_]; }
    [[nodiscard]] std::int64_t here() const { return static_cast<std::int64_t>(at_); }
    void skip_blanks();
    void skip_escape();
    void skip_device_control();
    void skip_line();
    void separator();
    Command damaged(std::int64_t byte, std::string message);
    std::optional<Command> command();
    void read_arguments(Command& command, Arguments kind);
    void read_label(Command& command);
    void read_until_semicolon(Command& command);
    void read_comment(Command& command);
    void read_character(Command& command);
    void read_numbers(Command& command);
    [[nodiscard]] bool is_stray(std::size_t letter) const;

    std::string_view bytes_;
    ArgumentsOf arguments_of_;
    Problems& problems_;
    std::size_t at_;
    bool after_command_ = true; ///< a `;` that follows ends something
    char label_end_ = '\x03';
    bool label_end_printed_ = false;
};

/// What is wrong with the numbers of a command.
struct NumberFault {
    std::int64_t byte = 0;
    std::string message;
    bool behind_all = false; ///< a comma with nothing behind it: the numbers before it are whole
};

/// Reads the numbers of a command into `numbers`: signs, digits, a point; blanks, one comma or a sign between
/// them. A line end is a separator, or with `join` nothing. Numbers are within +-2^30, HPGL's range.
/// More than `most` of them are a fault, too.
[[nodiscard]] std::optional<NumberFault>
read_numbers(const Command& command, bool join, std::size_t most, std::vector<double>& numbers);

} // namespace millwright::hpgl::internal
