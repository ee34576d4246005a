#include "core/exchange/internal/cad_text.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace millwright::exchange {

bool names_no_number(std::string_view word) {
    constexpr std::array<std::string_view, 3> names{"nan", "inf", "infinity"};
    if (!word.empty() && (word.front() == '+' || word.front() == '-')) {
        word.remove_prefix(1);
    }
    return std::ranges::any_of(names, [&](std::string_view name) {
        return std::ranges::equal(
            word, name, {}, [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    });
}

void expect_usable_number(const std::string& word, bool coordinate, const NumberPlace& place) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    const auto refuse = [&](const std::string& why) {
        throw Error(Diagnostic{{place.file, place.line},
                               fmt::format("{}: \"{}\" {}", place.of, word, why),
                               "export the file again with the program that made it"});
    };
    const bool whole = end == word.c_str() + word.size();
    if (!std::isfinite(value) || (!whole && (coordinate || *end == '#'))) {
        refuse("is not a finite number");
    }
    if (coordinate && std::abs(value) > farthest_coordinate) {
        refuse(fmt::format("is not a valid part coordinate, the limit is {:.0f}", farthest_coordinate));
    }
}

namespace {

constexpr std::size_t section_column = 72; // from 0
constexpr std::size_t parameters_end = 64;

/// Between parameters and behind an entity. The first two of the global section tell others, as "1H|".
struct Marks {
    char between = ',';
    char behind = ';';
};

Marks marks_of(std::string_view global) {
    Marks marks;
    if (global.size() > 2 && global.starts_with("1H")) {
        marks.between = global[2];
        global.remove_prefix(3);
    }
    global.remove_prefix(global.empty() ? 0 : 1);
    if (global.size() > 2 && global.starts_with("1H")) {
        marks.behind = global[2];
    }
    return marks;
}

/// Curves, surfaces and their transformations are 100 to 199, 502 is a list of corners.
bool is_of_points(int entity) {
    constexpr int corners = 502;
    return (entity >= 100 && entity < 200) || entity == corners;
}

/// The parameters of all entities, line by line; texts ("3Habc") are passed over.
class IgesParameters {
public:
    explicit IgesParameters(const std::filesystem::path& file) : file_(file) {}

    void use(Marks marks) { marks_ = marks; }

    void take(std::string_view parameters, int line) {
        for (const char letter : parameters) {
            if (to_pass_ > 0) {
                --to_pass_;
            } else if (letter == marks_.between || letter == marks_.behind) {
                end_word(line);
                entity_ = letter == marks_.behind ? 0 : entity_;
            } else if ((letter == 'H' || letter == 'h') && begins_text()) {
                to_pass_ = std::atol(word_.c_str());
                word_.clear();
                text_ = true;
            } else if (std::isspace(static_cast<unsigned char>(letter)) == 0) {
                word_ += letter == 'D' || letter == 'd' ? 'E' : letter;
            }
        }
    }

private:
    [[nodiscard]] bool begins_text() const {
        return !word_.empty() &&
               std::ranges::all_of(word_, [](unsigned char c) { return std::isdigit(c) != 0; });
    }

    void end_word(int line) {
        const std::string word = std::exchange(word_, "");
        if (std::exchange(text_, false) || word.empty()) {
            return;
        }
        if (entity_ == 0) {
            entity_ = std::atoi(word.c_str());
            return;
        }
        const bool real = word.find_first_of(".eE") != std::string::npos;
        if (real || names_no_number(word)) {
            expect_usable_number(
                word, is_of_points(entity_), {file_, line, fmt::format("entity of type {}", entity_)});
        }
    }

    Marks marks_;
    const std::filesystem::path& file_;
    std::string word_;
    long to_pass_ = 0;
    bool text_ = false;
    int entity_ = 0; ///< its type; 0 before it is known
};

} // namespace

void check_iges_text(std::string_view text, const std::filesystem::path& file, const Progress& progress) {
    IgesParameters parameters(file);
    bool has_marks = false;
    const std::size_t size = text.size();
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view row = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const char section = row.size() > section_column ? row[section_column] : ' ';
        if (section == 'G' && !std::exchange(has_marks, true)) {
            parameters.use(marks_of(row));
        } else if (section == 'P') {
            parameters.take(row.substr(0, parameters_end), line);
        }
        constexpr int between_checks = 1000;
        if (line % between_checks == 0) {
            progress.check();
            progress.report(1.0 - static_cast<double>(text.size()) / static_cast<double>(size));
        }
    }
}

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
