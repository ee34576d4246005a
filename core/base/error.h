// How things fail, the same everywhere: Error when the world is wrong, Defect when we are, Cancelled when the
// user said stop. A normal answer of the field (unreachable, folded, not converged) is a value, never thrown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace millwright {

/// Where something was found. Lines and columns count from 1; 0 and -1 mean not known.
struct Place {
    std::filesystem::path file;
    int line = 0;
    int column = 0;
    std::int64_t byte = -1;

    friend bool operator==(const Place&, const Place&) = default;
};

/// What is wrong, quoting the text at fault, and what to do about it.
struct Diagnostic {
    Place place;
    std::string message;
    std::string hint;

    friend bool operator==(const Diagnostic&, const Diagnostic&) = default;
};

/// What a file or a controller says, fit for a terminal: bytes that would control it, or are no text, as
/// \xNN.
[[nodiscard]] std::string printable(std::string_view text);

/// `file:line:column: message (hint)`, without what is not known; bytes that are no text as \xNN.
[[nodiscard]] std::string to_text(const Diagnostic& diagnostic);

/// The world is wrong: a file, a value, a port, a display. Ends the request, never the program.
class Error : public std::runtime_error {
public:
    explicit Error(Diagnostic found);
    /// An error of a whole file, or of no place at all.
    explicit Error(std::string message, std::filesystem::path file = {}, std::string hint = {});

    [[nodiscard]] const Diagnostic& diagnostic() const noexcept { return diagnostic_; }

private:
    Diagnostic diagnostic_;
};

/// We are wrong: a promise of the code did not hold.
class Defect : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

/// The user said stop. Not a std::exception, so that no handler swallows it.
class Cancelled final {};

/// Throws Defect with `sentence` and the caller's place unless `promise` holds. On in every build.
void expects(bool promise,
             std::string_view sentence,
             const char* file = __builtin_FILE(),
             int line = __builtin_LINE());

} // namespace millwright
