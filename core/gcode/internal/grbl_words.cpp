#include "core/gcode/internal/grbl_words.h"

#include "core/gcode/internal/cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

namespace millwright::gcode::internal {

namespace {

/// Of Grbl's line buffer: characters without blanks and comments.
constexpr std::size_t longest_grbl_line = 79;
constexpr int tenth = 10; // of the hundredths of a GrblCode

/// A number as Grbl takes codes apart: its whole part in eight bits, and what that lacks in hundredths.
struct GrblCode {
    int whole = 0;
    int hundredths = 0;
};

GrblCode grbl_code(double value) {
    constexpr double most = 1e9;
    value = std::clamp(value, -most, most);
    const auto whole = static_cast<std::uint8_t>(static_cast<std::int64_t>(value));
    return {whole, static_cast<std::uint16_t>(std::llround(100.0 * (value - whole)))};
}

struct CodeRule {
    int whole = 0;
    int group = 0;          ///< as Grbl numbers them, those of G and M apart
    bool uses_axes = false; ///< takes the axis words of its line
};

constexpr std::array g_rules = {
    CodeRule{0, 1, true},  CodeRule{1, 1, true},  CodeRule{2, 1, true},  CodeRule{3, 1, true},
    CodeRule{38, 1, true}, CodeRule{80, 1},       CodeRule{10, 0, true}, CodeRule{28, 0, true},
    CodeRule{30, 0, true}, CodeRule{92, 0, true}, CodeRule{4, 0},        CodeRule{53, 0},
    CodeRule{17, 2},       CodeRule{18, 2},       CodeRule{19, 2},       CodeRule{90, 3},
    CodeRule{91, 3},       CodeRule{93, 5},       CodeRule{94, 5},       CodeRule{20, 6},
    CodeRule{21, 6},       CodeRule{40, 7},       CodeRule{43, 8, true}, CodeRule{49, 8, true},
    CodeRule{54, 12},      CodeRule{55, 12},      CodeRule{56, 12},      CodeRule{57, 12},
    CodeRule{58, 12},      CodeRule{59, 12},      CodeRule{61, 13}};
constexpr std::array m_rules = {CodeRule{0, 4},
                                CodeRule{1, 4},
                                CodeRule{2, 4},
                                CodeRule{30, 4},
                                CodeRule{3, 7},
                                CodeRule{4, 7},
                                CodeRule{5, 7},
                                CodeRule{7, 8},
                                CodeRule{8, 8},
                                CodeRule{9, 8}};
constexpr int arc_distance_group = 4;

/// Codes that Grbl lacks and that the documents of grblHAL and FluidNC list (README of grblHAL/core; wiki of
/// FluidNC, supported G-codes).
constexpr std::array grblhal_g = {5,  7,  8,  10, 33, 43, 50, 51, 59, 65, 73, 76,
                                  81, 82, 83, 85, 86, 89, 92, 95, 96, 97, 98, 99};
constexpr std::array grblhal_m = {6,  48, 49, 50, 51, 53, 60, 61, 62, 63,
                                  64, 65, 66, 67, 68, 70, 71, 72, 73, 99};
constexpr std::array fluidnc_m = {6, 56, 61, 62, 63, 64, 65, 66, 67, 68};

bool has_beyond_grbl(std::string_view firmware, char letter, int code) {
    const auto among = [code](const auto& codes) { return std::ranges::find(codes, code) != codes.end(); };
    if (firmware == "grblHAL") {
        return letter == 'G' ? among(grblhal_g) : among(grblhal_m);
    }
    return firmware == "FluidNC" && letter == 'M' && among(fluidnc_m);
}

class FirstPass {
public:
    FirstPass(std::string_view line, const GrblController& controller, std::string& buffer)
        : line_(line), controller_(controller), buffer_(buffer) {}

    std::string_view run() {
        keep_characters();
        for (std::size_t n = 0; n < kept_.size();) {
            n = take_word(n);
        }
        if (sets_data_) {
            blank_fraction(p_word_);
        }
        return changed_ ? std::string_view(buffer_) : line_;
    }

private:
    struct Kept {
        char c = ' ';
        std::size_t at = 0; ///< in the line
    };
    struct Word {
        std::size_t first = 0, end = 0; ///< in kept_
    };

    std::string_view line_;
    const GrblController& controller_;
    std::string& buffer_;
    bool changed_ = false;
    std::vector<Kept> kept_;
    std::array<std::string, 16> g_groups_, m_groups_; ///< the code of each in this line
    std::string axis_user_;                           ///< the code that takes the axis words
    std::uint32_t letters_ = 0;                       ///< that came
    bool sets_data_ = false;                          ///< G10
    Word p_word_;

    [[nodiscard]] int column(std::size_t n) const { return static_cast<int>(kept_[n].at) + 1; }

    void blank(std::size_t first, std::size_t end) {
        if (!std::exchange(changed_, true)) {
            buffer_ = line_;
        }
        std::fill(buffer_.begin() + static_cast<std::ptrdiff_t>(first),
                  buffer_.begin() + static_cast<std::ptrdiff_t>(end),
                  ' ');
    }

    /// A comment ends with the first ), or with the line.
    std::size_t skip_comment(std::size_t open) {
        const std::size_t close = line_.find(')', open);
        const std::size_t end = close == std::string_view::npos ? line_.size() : close + 1;
        if (close == std::string_view::npos ||
            line_.substr(open + 1, close - open - 1).find('(') != std::string_view::npos) {
            blank(open, end);
        }
        return end;
    }

    void keep_characters() {
        for (std::size_t n = 0; n < line_.size() && line_[n] != ';';) {
            const char c = line_[n];
            if (c == '(') {
                n = skip_comment(n);
                continue;
            }
            if (c == '/' && !kept_.empty()) {
                blank(n, n + 1);
            } else if (!is_blank(c) && c != '/') {
                kept_.push_back({to_upper(c), n});
            }
            ++n;
            if (kept_.size() > longest_grbl_line) {
                refuse(column(longest_grbl_line),
                       fmt::format("a line for Grbl may have at most {} characters (error 11)",
                                   longest_grbl_line));
            }
        }
    }

    /// Returns where the next word begins.
    std::size_t take_word(std::size_t n) {
        const char letter = kept_[n].c;
        if (letter < 'A' || letter > 'Z') {
            if (letter < ' ' || letter > '~') {
                return n + 1; // no character of a program, whoever reads it
            }
            refuse(
                column(n),
                fmt::format("{} does not support '{}' in a program (error 1)", controller_.firmware, letter));
        }
        std::size_t end = n + 1;
        end += end < kept_.size() && (kept_[end].c == '-' || kept_[end].c == '+') ? 1 : 0;
        bool digits = false;
        for (bool point = false; end < kept_.size(); ++end) {
            const char c = kept_[end].c;
            if (!is_digit(c) && (c != '.' || std::exchange(point, true))) {
                break;
            }
            digits = digits || is_digit(c);
        }
        if (!digits) {
            refuse(column(n),
                   fmt::format("{} is followed by no number that Grbl can read (error 2)", letter));
        }
        take(letter, {n, end});
        return end;
    }

    [[nodiscard]] std::string text_of(const Word& word) const {
        std::string text;
        for (std::size_t n = word.first; n < word.end; ++n) {
            text += kept_[n].c;
        }
        return text;
    }

    void take(char letter, const Word& word) {
        const std::string text = text_of(word);
        const double value = std::strtod(text.c_str() + 1, nullptr);
        if (letter == 'G') {
            take_g(grbl_code(value), text, column(word.first));
        } else if (letter == 'M') {
            take_m(grbl_code(value), text, column(word.first));
        } else {
            take_value(letter, value, word);
        }
    }

    [[noreturn]] void
    refuse_code(const GrblCode& code, const std::string& text, int column, int error) const {
        if (has_beyond_grbl(controller_.firmware, text.front(), code.whole)) {
            refuse(column,
                   fmt::format(
                       "{} is not a code of Grbl 1.1: {} may support it, but Millwright cannot simulate it",
                       text,
                       controller_.firmware),
                   "post-process the program for Grbl, with cycles as single moves and one tool per program");
        }
        refuse(column, fmt::format("{} does not support {} (error {})", controller_.firmware, text, error));
    }

    static void enter(std::string& group, const std::string& text, int column) {
        if (!group.empty()) {
            refuse(column,
                   fmt::format(
                       "{} and {} belong to the same modal group and cannot be in the same line (error 21)",
                       group,
                       text));
        }
        group = text;
    }

    void use_axes(const std::string& text, int column) {
        if (!axis_user_.empty()) {
            refuse(
                column,
                fmt::format("{} and {} both use axis words and cannot be in the same line in Grbl (error 24)",
                            axis_user_,
                            text),
                "write them in separate lines");
        }
        axis_user_ = text;
    }

    void take_g(const GrblCode& code, const std::string& text, int column) {
        const auto* const rule = std::ranges::find(g_rules, code.whole, &CodeRule::whole);
        if (rule == g_rules.end()) {
            refuse_code(code, text, column, 20);
        }
        // G28.1, G30.1 and G92.1 leave the axis words to a motion.
        const bool may_have_tenth = code.whole == 28 || code.whole == 30 || code.whole == 92;
        if (rule->uses_axes && !(rule->group == 0 && code.hundredths != 0)) {
            use_axes(text, column);
        }
        if (const int error = error_of_fraction(code, may_have_tenth); error != 0) {
            refuse_code(code, text, column, error);
        }
        const bool arc_distance = code.whole == 91 && code.hundredths != 0;
        enter(g_groups_[static_cast<std::size_t>(arc_distance ? arc_distance_group : rule->group)],
              text,
              column);
        sets_data_ = sets_data_ || code.whole == 10;
    }

    /// Grbl checks the fractions of some codes by themselves; of G49 none at all.
    static int error_of_fraction(const GrblCode& code, bool may_have_tenth) {
        const int rest = code.hundredths;
        switch (code.whole) {
        case 38:
            return rest == 2 * tenth || rest == 3 * tenth || rest == 4 * tenth || rest == 5 * tenth ? 0 : 20;
        case 43:
            return rest == tenth ? 0 : 20;
        case 49:
            return 0;
        case 61:
        case 90:
            return rest == 0 ? 0 : 20;
        case 91:
            return rest == 0 || rest == tenth ? 0 : 20;
        default:
            return rest == 0 || (may_have_tenth && rest == tenth) ? 0 : may_have_tenth ? 20 : 23;
        }
    }

    void take_m(const GrblCode& code, const std::string& text, int column) {
        if (code.hundredths != 0) {
            refuse_code(code, text, column, 23);
        }
        const auto* const rule = std::ranges::find(m_rules, code.whole, &CodeRule::whole);
        constexpr int mist_on = 7;
        if (code.whole == mist_on && !controller_.mist) {
            refuse(column,
                   "this Grbl does not support mist coolant, M7 (error 20)",
                   "use M8, or build Grbl with ENABLE_M7");
        }
        if (rule == m_rules.end()) {
            refuse_code(code, text, column, 20);
        }
        enter(m_groups_[static_cast<std::size_t>(rule->group)], text, column);
    }

    void take_value(char letter, double value, const Word& word) {
        constexpr std::string_view known = "FIJKLNPRST";
        constexpr std::string_view all_axes = "XYZABCUVW";
        constexpr std::string_view not_negative = "FNPST";
        constexpr double last_tool = 255.0;
        constexpr double last_line_number = 10'000'000.0;
        const int place = column(word.first);
        const bool is_axis = all_axes.find(letter) != std::string_view::npos;
        if (is_axis && controller_.axes.find(letter) == std::string_view::npos) {
            refuse(place,
                   fmt::format("this Grbl has the axes {} and does not support {} words (error 20)",
                               controller_.axes,
                               letter),
                   "generate the program for these axes, or connect a controller that has all axes");
        }
        if (!is_axis && known.find(letter) == std::string_view::npos) {
            refuse(place,
                   fmt::format("{} does not support {} words (error 20)", controller_.firmware, letter),
                   letter == 'E' ? "write numbers without an exponent (not 1e5)" : "");
        }
        if (letter == 'T' && value > last_tool) {
            refuse(place, "the highest tool number in Grbl is 255 (error 38)");
        }
        const std::uint32_t bit = 1U << static_cast<unsigned>(letter - 'A');
        if ((letters_ & bit) != 0) {
            refuse(place, fmt::format("a line may have only one {} word (error 25)", letter));
        }
        letters_ |= bit;
        if (value < 0.0 && not_negative.find(letter) != std::string_view::npos) {
            refuse(place, fmt::format("{} must not be negative (error 4)", letter));
        }
        if (letter == 'N' && value > last_line_number) {
            refuse(place,
                   fmt::format("the highest line number in Grbl is {:.0f} (error 27)", last_line_number));
        }
        if (letter == 'N') {
            blank(kept_[word.first].at, kept_[word.end - 1].at + 1);
        } else if (letter == 'T' || letter == 'L') {
            blank_fraction(word);
        } else if (letter == 'P') {
            p_word_ = word;
        }
    }

    /// Grbl takes the whole part only.
    void blank_fraction(const Word& word) {
        for (std::size_t n = word.first; n < word.end; ++n) {
            if (kept_[n].c == '.') {
                const bool leads = n == word.first + 1;
                blank(kept_[n].at, kept_[word.end - 1].at + 1);
                if (leads) {
                    buffer_[kept_[n].at] = '0';
                }
                return;
            }
        }
    }
};

} // namespace

std::string_view grbl_words(std::string_view line, const GrblController& controller, std::string& buffer) {
    return FirstPass(line, controller, buffer).run();
}

} // namespace millwright::gcode::internal
