// The words of a PMAC's commands and programs: blanks mean nothing, letters have no case. Of keywords the
// longest that fits is meant.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::pmac::card {

struct Token {
    enum class Kind { number, word, symbol, quoted, end };

    Kind kind = Kind::end;
    std::string text;       ///< upper case, keywords in their long form; what is quoted as it stands
    std::string_view brief; ///< of a keyword: its short form
    double value = 0.0;     ///< of a number
    bool touching = false;  ///< no blank stands before it
};

/// Nothing if `line` has a character that no word begins with, a quotation without end, or a number that is
/// none.
[[nodiscard]] std::optional<std::vector<Token>> words_of(std::string_view line);

/// The words again, keywords in their long or short form, as a card lists them.
[[nodiscard]] std::string listing_of(const std::vector<Token>& words, bool long_form);

/// A place in a row of words; at its end it stands before one of the kind `end`.
class Words {
public:
    explicit Words(const std::vector<Token>& words) : words_(&words) {}

    [[nodiscard]] const Token& now() const;
    [[nodiscard]] const Token& next(std::size_t ahead = 1) const;
    [[nodiscard]] bool ended() const { return at_ >= words_->size(); }
    [[nodiscard]] bool at(std::string_view text) const;
    [[nodiscard]] bool at_number() const { return now().kind == Token::Kind::number; }
    [[nodiscard]] std::size_t place() const { return at_; }
    void go_to(std::size_t place) { at_ = place; }
    void skip() { ++at_; }
    /// Whether it stood before `text`; then it stands behind it.
    bool take(std::string_view text);
    /// A number with or without sign.
    std::optional<double> take_number();
    /// A whole number from 0 to `most`.
    std::optional<int> take_index(int most);

private:
    const std::vector<Token>* words_;
    std::size_t at_ = 0;
};

} // namespace millwright::pmac::card
