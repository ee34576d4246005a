#include "core/base/error.h"
#include "core/exchange/internal/cad_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace millwright::exchange {

namespace {

bool is_digit(char letter) {
    return letter >= '0' && letter <= '9';
}

bool of_a_word(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

bool of_a_number(char letter) {
    return of_a_word(letter) || letter == '.' || letter == '+' || letter == '-' || letter == '#';
}

/// One walk through the text (ISO 10303-21): strings, comments and enumerations are passed over.
class StepText {
public:
    StepText(const std::string& text, const std::filesystem::path& file) : text_(text), file_(file) {}

    /// False at the end.
    bool step() {
        const char letter = now();
        if (at_ >= text_.size()) {
            return false;
        }
        if (letter == '\'' || letter == '"') {
            pass_behind(std::string_view(&letter, 1), at_ + 1);
        } else if (letter == '/' && next() == '*') {
            pass_behind("*/", at_ + 2);
        } else if (letter == '.' && std::isalpha(static_cast<unsigned char>(next())) != 0) {
            pass_behind(".", at_ + 1);
        } else if (letter == '#') {
            take_name();
        } else if (is_digit(letter) || letter == '-' || letter == '+' || letter == '.') {
            take_number();
        } else if (of_a_word(letter)) {
            take_word();
        } else {
            take_mark();
        }
        return true;
    }

    [[nodiscard]] std::size_t at() const { return at_; }
    [[nodiscard]] int faces() const { return faces_; }

private:
    [[nodiscard]] char now() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    /// The next that is no blank.
    [[nodiscard]] char following() const {
        const std::size_t found = text_.find_first_not_of(" \t\r\n", at_);
        return found == std::string::npos ? '\0' : text_[found];
    }
    [[nodiscard]] char next() const { return at_ + 1 < text_.size() ? text_[at_ + 1] : '\0'; }

    void pass_behind(std::string_view mark, std::size_t from) {
        const std::size_t found = text_.find(mark, from);
        const std::size_t end = found == std::string::npos ? text_.size() : found + mark.size();
        line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                             text_.begin() + static_cast<std::ptrdiff_t>(end),
                                             '\n'));
        at_ = end;
    }

    /// Takes the letters that belong together.
    template <typename Belongs> std::string taken(Belongs belongs) {
        const std::size_t from = at_++;
        while (at_ < text_.size() && belongs(text_[at_])) {
            ++at_;
        }
        return text_.substr(from, at_ - from);
    }

    void take_name() {
        const std::string name = taken(is_digit);
        if (following() == '=') {
            entity_ = name;
            keyword_.clear();
        }
    }

    void take_number() {
        const std::string word = taken(of_a_number);
        if (depth_ > 0) {
            expect_usable_number(word, keyword_ == "CARTESIAN_POINT", place());
        }
    }

    void take_mark() {
        const char mark = text_[at_++];
        line_ += mark == '\n' ? 1 : 0;
        depth_ = mark == ';' ? 0 : depth_ + (mark == '(' ? 1 : 0) - (mark == ')' ? 1 : 0);
    }

    void take_word() {
        const std::string word = taken(of_a_word);
        if (following() == '(') {
            keyword_ = word;
            constexpr std::array faces{"ADVANCED_FACE", "FACE_SURFACE"};
            faces_ += std::ranges::find(faces, word) != faces.end() ? 1 : 0;
        } else if (depth_ > 0 && names_no_number(word)) {
            expect_usable_number(word, false, place());
        }
    }

    [[nodiscard]] NumberPlace place() const {
        return {file_, line_, fmt::format("{} {}", entity_, keyword_)};
    }

    const std::string& text_;
    const std::filesystem::path& file_;
    std::size_t at_ = 0;
    int line_ = 1;
    int depth_ = 0; ///< of parentheses; the marks of begin and end outside of them hold no numbers
    int faces_ = 0;
    std::string entity_;
    std::string keyword_;
};

} // namespace

int checked_step_text(const std::string& text, const std::filesystem::path& file, const Progress& progress) {
    StepText walk(text, file);
    for (std::size_t n = 0; walk.step(); ++n) {
        constexpr std::size_t between_checks = 10'000;
        if (n % between_checks == 0) {
            progress.check();
            progress.report(static_cast<double>(walk.at()) / static_cast<double>(text.size()));
        }
    }
    return walk.faces();
}

} // namespace millwright::exchange
