#include "core/exchange/internal/cad_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <utility>

namespace millwright::exchange {

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

} // namespace millwright::exchange
