#include "core/pmac/emulator/internal/lexer.h"

#include "core/base/text.h"
#include "core/pmac/driver/card_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace millwright::pmac::card {

namespace {

constexpr std::array<std::string_view, 9> long_symbols{
    "$$$***", "$$$", "???", "??", "->", "..", "!=", "!>", "!<"};
constexpr std::string_view symbols = "#&@%$?=<>!~+-*/|^(),:\\.";

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool is_hex(char c) {
    return is_digit(c) || (c >= 'A' && c <= 'F');
}

/// Upper case without blanks, as far as it is not quoted; `gaps` tells before which characters blanks stood.
struct Bare {
    std::string text;
    std::vector<bool> gaps;
};

Bare bare(std::string_view line) {
    Bare result;
    bool quoted = false, gap = false;
    for (const char c : line) {
        if (!quoted && (c == ' ' || c == '\t' || c == '\n')) {
            gap = true;
            continue;
        }
        quoted = c == '"' ? !quoted : quoted;
        result.text += !quoted && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        result.gaps.push_back(gap);
        gap = false;
    }
    return result;
}

class Lexer {
public:
    explicit Lexer(std::string_view line) : bare_(bare(line)), rest_(bare_.text) {}

    std::optional<std::vector<Token>> run() {
        while (!rest_.empty()) {
            const bool gap = bare_.gaps[bare_.text.size() - rest_.size()];
            if (!take()) {
                return std::nullopt;
            }
            words_.back().touching = !gap;
        }
        return std::move(words_);
    }

private:
    Bare bare_;
    std::string_view rest_;
    std::vector<Token> words_;

    bool take() { return rest_.front() == '"' ? quoted() : number() || symbol() || word(); }
    void add(Token::Kind kind, std::string_view text, std::size_t length, std::string_view brief = {}) {
        words_.push_back({kind, std::string(text), brief, 0.0, false});
        rest_.remove_prefix(length);
    }

    bool quoted() {
        const std::size_t end = rest_.find('"', 1);
        if (end == std::string_view::npos) {
            return false;
        }
        add(Token::Kind::quoted, rest_.substr(1, end - 1), end + 1);
        return true;
    }

    bool number() {
        const bool hex = rest_.size() > 1 && rest_[0] == '$' && is_hex(rest_[1]);
        const bool point = rest_.size() > 1 && rest_[0] == '.' && is_digit(rest_[1]);
        return hex ? hexadecimal() : (is_digit(rest_[0]) || point) && decimal();
    }
    bool hexadecimal() {
        std::size_t end = 1;
        double value = 0.0;
        for (; end < rest_.size() && is_hex(rest_[end]); ++end) {
            constexpr double base = 16.0;
            const char c = rest_[end];
            value = value * base + (is_digit(c) ? c - '0' : c - 'A' + 10);
        }
        constexpr std::size_t longest = 13; // $ and 48 bits
        if (end > longest) {
            return false;
        }
        add(Token::Kind::number, rest_.substr(0, end), end);
        words_.back().value = value;
        return true;
    }
    bool decimal() {
        std::size_t end = 0;
        bool point = false;
        for (; end < rest_.size(); ++end) {
            const bool range = rest_[end] == '.' && end + 1 < rest_.size() && rest_[end + 1] == '.';
            if (!is_digit(rest_[end]) && (rest_[end] != '.' || point || range)) {
                break;
            }
            point = point || rest_[end] == '.';
        }
        double value = 0.0;
        const auto read = std::from_chars(rest_.data(), rest_.data() + end, value);
        if (read.ec != std::errc{} || !std::isfinite(value)) {
            return false;
        }
        add(Token::Kind::number, rest_.substr(0, end), end);
        words_.back().value = value;
        return true;
    }

    bool symbol() {
        for (const std::string_view one : long_symbols) {
            if (rest_.starts_with(one)) {
                add(Token::Kind::symbol, one, one.size());
                return true;
            }
        }
        if (symbols.find(rest_.front()) == std::string_view::npos) {
            return false;
        }
        add(Token::Kind::symbol, rest_.substr(0, 1), 1);
        return true;
    }

    bool word() {
        if (const auto known = card_word(rest_)) {
            add(Token::Kind::word, known->full, known->length, known->brief);
            return true;
        }
        if (rest_.front() < 'A' || rest_.front() > 'Z') {
            return false;
        }
        add(Token::Kind::word, rest_.substr(0, 1), 1);
        return true;
    }
};

} // namespace

std::optional<std::vector<Token>> words_of(std::string_view line) {
    return Lexer(line).run();
}

std::string listing_of(const std::vector<Token>& words, bool long_form) {
    std::string text;
    for (const Token& word : words) {
        if (word.kind == Token::Kind::quoted) {
            text += '"' + word.text + '"';
        } else {
            text += word.brief.empty() || long_form ? word.text : std::string(word.brief);
        }
    }
    return text;
}

const Token& Words::next(std::size_t ahead) const {
    static const Token end{};
    return at_ + ahead < words_->size() ? (*words_)[at_ + ahead] : end;
}

const Token& Words::now() const {
    return next(0);
}

bool Words::at(std::string_view text) const {
    const Token& word = now();
    return (word.kind == Token::Kind::word || word.kind == Token::Kind::symbol) && word.text == text;
}

bool Words::take(std::string_view text) {
    const bool found = at(text);
    at_ += found ? 1 : 0;
    return found;
}

std::optional<double> Words::take_number() {
    const std::size_t sign = at("-") || at("+") ? 1 : 0;
    if (next(sign).kind != Token::Kind::number) {
        return std::nullopt;
    }
    const double value = at("-") ? -next(sign).value : next(sign).value;
    at_ += sign + 1;
    return value;
}

std::optional<int> Words::take_index(int most) {
    const double value = at_number() ? now().value : -1.0;
    if (!(value >= 0.0 && value <= most) || std::trunc(value) < value) {
        return std::nullopt;
    }
    skip();
    return static_cast<int>(value);
}

} // namespace millwright::pmac::card
