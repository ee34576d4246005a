#include "core/hpgl/internal/lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace millwright::hpgl::internal {
namespace {

constexpr char escape = '\x1b';
constexpr double largest_number = 1073741824.0; // 2^30, HP-GL/2's range of coordinates

bool is_blank(char c) {
    return c >= '\0' && c <= ' ' && c != escape;
}
bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_line_end(char c) {
    return c == '\r' || c == '\n';
}
char capital(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

std::string shown(char c) {
    return c > ' ' && c < '\x7f' ? fmt::format("'{}'", c)
                                 : fmt::format("the byte {:02X}", static_cast<unsigned char>(c));
}

/// Every pair of capitals, so that a command's name need not be kept by anyone.
constexpr auto all_names = [] {
    std::array<char, 26 * 26 * 2> names{};
    for (std::size_t n = 0; n < 26 * 26; ++n) {
        names[2 * n] = static_cast<char>('A' + n / 26);
        names[2 * n + 1] = static_cast<char>('A' + n % 26);
    }
    return names;
}();

std::string_view name_of(char first, char second) {
    const auto n = static_cast<std::size_t>((first - 'A') * 26 + (second - 'A'));
    return {all_names.data() + 2 * n, 2};
}

} // namespace

std::optional<Command> Lexer::next() {
    for (;;) {
        skip_blanks();
        if (at_end()) {
            return std::nullopt;
        }
        const char c = look();
        if (c == escape) {
            skip_escape();
        } else if (bytes_.substr(at_).starts_with("@PJL")) {
            skip_line();
        } else if (c == ';') {
            separator();
        } else if (is_letter(c)) {
            return command();
        } else {
            return damaged(here(), fmt::format("{} does not start a command", shown(c)));
        }
    }
}

void Lexer::skip_blanks() {
    while (!at_end() && is_blank(look())) {
        ++at_;
    }
}

void Lexer::skip_line() {
    const auto end = bytes_.find('\n', at_);
    at_ = end == std::string_view::npos ? bytes_.size() : end + 1;
    after_command_ = true;
}

// The `;` of a command was taken with it; the sequences of the interface may have one behind them.
void Lexer::separator() {
    if (!after_command_) {
        problems_.add(here(), "empty command: ';' follows ';'");
    }
    after_command_ = false;
    ++at_;
}

void Lexer::skip_escape() {
    after_command_ = true;
    ++at_;
    if (at_end()) {
        return;
    }
    const char kind = bytes_[at_++];
    if (kind == '.') {
        skip_device_control();
    } else if (kind == '%' || kind == '&' || kind == '*' || kind == '(' || kind == ')') {
        // PCL: parameters, then a capital letter.
        while (!at_end() && !(look() >= 'A' && look() <= 'Z') && look() != escape && look() != ';') {
            ++at_;
        }
        at_ += !at_end() && is_letter(look()) ? 1U : 0U;
    }
}

// ESC . letter, and for some letters numbers that a colon ends.
void Lexer::skip_device_control() {
    if (at_end()) {
        return;
    }
    const char function = capital(bytes_[at_++]);
    if (std::string_view("@HIMNPQST").find(function) == std::string_view::npos) {
        return;
    }
    const auto belongs = [](char c) { return is_digit(c) || c == ';' || c == '-' || is_blank(c); };
    std::size_t end = at_;
    while (end < bytes_.size() && belongs(bytes_[end])) {
        ++end;
    }
    if (end < bytes_.size() && bytes_[end] == ':') {
        at_ = end + 1;
    }
}

Command Lexer::damaged(std::int64_t byte, std::string message) {
    const auto end = bytes_.find_first_of(";:", at_);
    at_ = end == std::string_view::npos ? bytes_.size() : end + 1;
    after_command_ = false;
    problems_.add(byte, std::move(message), "skipped up to the next ';'");
    return {.name = {}, .byte = byte, .arguments = {}};
}

std::optional<Command> Lexer::command() {
    const std::int64_t byte = here();
    const char first = capital(bytes_[at_++]);
    skip_blanks(); // wrapped listings cut commands in two
    if (at_end()) {
        return damaged(byte, fmt::format("the file ends after '{}', in the middle of a command", first));
    }
    if (!is_letter(look())) {
        return damaged(byte, fmt::format("'{}' and {} do not form a command", first, shown(look())));
    }
    const char second = capital(bytes_[at_++]);
    Command command{.name = name_of(first, second), .byte = byte, .arguments = {}, .arguments_byte = here()};
    read_arguments(command, arguments_of_(command.name));
    return command;
}

void Lexer::read_arguments(Command& command, Arguments kind) {
    after_command_ = true;
    switch (kind) {
    case Arguments::numbers:
        return read_numbers(command);
    case Arguments::label:
        return read_label(command);
    case Arguments::encoded:
        return read_until_semicolon(command);
    case Arguments::comment:
        return read_comment(command);
    case Arguments::character:
        return read_character(command);
    }
}

void Lexer::read_numbers(Command& command) {
    const std::size_t from = at_;
    while (!at_end() && look() != ';' && look() != escape && !is_letter(look())) {
        ++at_;
    }
    command.arguments = bytes_.substr(from, at_ - from);
    command.terminated = !at_end() || command.arguments.empty() || is_blank(command.arguments.back());
    if (!at_end() && is_stray(at_)) {
        command.stray = here();
        at_ = std::min(bytes_.find(';', at_), bytes_.size());
    }
    if (!at_end() && look() == ';') {
        ++at_;
        after_command_ = false;
    }
}

// 1x500 and 1O0 are damaged numbers, not a 1 and then something else.
bool Lexer::is_stray(std::size_t letter) const {
    if (!is_letter(bytes_[letter])) {
        return false;
    }
    const bool behind_digit = letter > 0 && (is_digit(bytes_[letter - 1]) || bytes_[letter - 1] == '.');
    if (behind_digit && capital(bytes_[letter]) == 'O') {
        return true;
    }
    const auto next =
        std::find_if_not(bytes_.begin() + static_cast<std::ptrdiff_t>(letter) + 1, bytes_.end(), is_blank);
    return next != bytes_.end() && !is_letter(*next);
}

void Lexer::read_until_semicolon(Command& command) {
    const auto end = bytes_.find(';', at_);
    command.terminated = end != std::string_view::npos;
    command.arguments = bytes_.substr(at_, command.terminated ? end - at_ : std::string_view::npos);
    at_ = command.terminated ? end + 1 : bytes_.size();
    after_command_ = false;
}

void Lexer::read_label(Command& command) {
    const auto end = bytes_.find(label_end_, at_);
    command.terminated = end != std::string_view::npos;
    const std::size_t count = (command.terminated ? end : bytes_.size()) - at_;
    const bool printed = command.terminated && label_end_printed_;
    command.arguments = bytes_.substr(at_, count + (printed ? 1 : 0));
    at_ += count + (command.terminated ? 1 : 0);
}

void Lexer::read_comment(Command& command) {
    skip_blanks();
    if (at_end() || look() != '"') {
        return read_until_semicolon(command);
    }
    const auto end = bytes_.find('"', at_ + 1);
    command.terminated = end != std::string_view::npos;
    at_ = command.terminated ? end + 1 : bytes_.size();
}

void Lexer::read_character(Command& command) {
    if (at_end()) {
        return;
    }
    const std::size_t from = at_;
    if (look() != ';') {
        ++at_; // whatever it is, also a letter
    }
    Command numbers;
    read_numbers(numbers);
    command.arguments = bytes_.substr(from,
                                      static_cast<std::size_t>(numbers.arguments.data() - bytes_.data()) -
                                          from + numbers.arguments.size());
}

namespace {

/// Goes over the arguments of a command, with or without their line ends.
class NumberReader {
public:
    NumberReader(const Command& command, bool join)
        : text_(command.arguments), byte_(command.arguments_byte) {
        if (join) {
            for (const char c : text_) {
                if (!is_line_end(c)) {
                    joined_ += c;
                }
            }
            original_ = text_;
            text_ = joined_;
        }
    }

    std::optional<NumberFault> read(std::size_t most, std::vector<double>& numbers) {
        numbers.clear();
        skip_blanks();
        while (at_ < text_.size()) {
            if (numbers.size() == most) {
                return fault(at_, fmt::format("there are more than {} numbers", most));
            }
            if (auto fault = read_one(numbers)) {
                return fault;
            }
            if (auto fault = separator()) {
                return fault;
            }
        }
        return std::nullopt;
    }

private:
    void skip_blanks() {
        while (at_ < text_.size() && is_blank(text_[at_])) {
            ++at_;
        }
    }

    std::optional<NumberFault> read_one(std::vector<double>& numbers) {
        const std::size_t from = at_;
        if (text_[at_] == '+' || text_[at_] == '-') {
            ++at_;
        }
        const std::size_t digits = at_;
        while (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) {
            ++at_;
        }
        double value = 0.0;
        const auto [end, error] =
            std::from_chars(text_.data() + digits, text_.data() + at_, value, std::chars_format::fixed);
        if (error != std::errc() || end != text_.data() + at_) {
            return fault(from, fault_text(from, digits));
        }
        if (value > largest_number) {
            return fault(from,
                         fmt::format("{} exceeds HPGL's range of 2^30", text_.substr(from, at_ - from)));
        }
        numbers.push_back(text_[from] == '-' ? -value : value);
        return std::nullopt;
    }

    [[nodiscard]] std::string fault_text(std::size_t from, std::size_t digits) const {
        if (at_ > digits) {
            return fmt::format("'{}' is not a number", text_.substr(from, at_ - from));
        }
        return at_ < text_.size() ? fmt::format("{} is found where a number is expected", shown(text_[at_]))
                                  : std::string("a number is missing");
    }

    std::optional<NumberFault> separator() {
        skip_blanks();
        if (at_ < text_.size() && text_[at_] == ',') {
            ++at_;
            skip_blanks();
            if (at_ == text_.size()) {
                NumberFault last = fault(at_ - 1, "a number is missing after ','");
                last.behind_all = true;
                return last;
            }
        }
        return std::nullopt;
    }

    [[nodiscard]] NumberFault fault(std::size_t at, std::string message) const {
        std::size_t left = at;
        std::size_t n = joined_.empty() ? at : 0;
        while (!joined_.empty() && n < original_.size() && (left > 0 || is_line_end(original_[n]))) {
            left -= is_line_end(original_[n]) ? 0 : 1;
            ++n;
        }
        return {byte_ + static_cast<std::int64_t>(n), std::move(message), false};
    }

    std::string_view text_;
    std::string_view original_;
    std::string joined_;
    std::int64_t byte_;
    std::size_t at_ = 0;
};

} // namespace

std::optional<NumberFault>
read_numbers(const Command& command, bool join, std::size_t most, std::vector<double>& numbers) {
    return NumberReader(command, join).read(most, numbers);
}

} // namespace millwright::hpgl::internal
