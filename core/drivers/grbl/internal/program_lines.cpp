#include "core/drivers/grbl/internal/program_lines.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/drivers/grbl/internal/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <optional>

namespace millwright::drivers::grbl {

namespace {

[[noreturn]] void fail(const Place& place, std::string message, std::string hint) {
    throw Error(Diagnostic{place, std::move(message), std::move(hint)});
}

/// A file that is no plain text is one fault, not one for each of its characters.
void expect_text(const program::Listing& listing, const std::filesystem::path& file) {
    const std::string_view text = listing.text;
    if (const std::string_view encoding = wide_encoding(text); !encoding.empty()) {
        fail({file, 1, 1, -1}, fmt::format("the file is {}", encoding), "save it as plain text");
    }
    if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
        const auto line = std::ranges::upper_bound(listing.line_starts, zero) - listing.line_starts.begin();
        const std::size_t begin = listing.line_starts[static_cast<std::size_t>(line - 1)];
        fail({file, static_cast<int>(line), static_cast<int>(zero - begin) + 1, -1},
             "byte 0x00 found: this is a binary file",
             "choose a G-code file");
    }
}

/// Takes off blanks and comments and looks at every character that remains.
std::string bare_text(std::string_view line, Place place) {
    std::string text;
    bool comment = false;
    for (std::size_t n = 0; n < line.size(); ++n) {
        const char c = line[n];
        place.column = static_cast<int>(n) + 1;
        if (c == '\x18' || c == '!' || c == '~' || c == '?' || static_cast<unsigned char>(c) > '~') {
            // Also within comments: Grbl acts upon these before it looks at the line.
            if (comment) {
                continue; // it is not sent
            }
            fail(place, "this character is a real-time command in Grbl", "remove it from the program");
        }
        if (comment) {
            comment = c != ')';
        } else if (c == ';') {
            break;
        } else if (c == '(') {
            comment = true;
        } else if (c == '$') {
            fail(place, "$ commands are not allowed in a program", "send them separately");
        } else if (c > ' ' && c != '/') {
            text += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        } else if (c < ' ' && c != '\t' && c != '\r') {
            fail(place, "this character is not allowed in a program", "check that it is a text file");
        }
    }
    return text == "%" ? std::string() : text;
}

std::string without_line_number(std::string_view text) {
    if (!text.starts_with('N')) {
        return std::string(text);
    }
    const std::size_t end = text.find_first_not_of("0123456789.", 1);
    return std::string(text.substr(std::min(end, text.size())));
}

/// Follows the modes just far enough to say "this surely moves". What it does not follow makes it forget.
class SureMoves {
public:
    bool surely_moves(const std::vector<Word>& words) {
        bool understood = true;
        for (const Word& word : words) {
            understood = understood && (word.letter != 'G' || take_mode(word.value)) && word.letter != 'M';
        }
        if (!understood) {
            *this = {};
            return false;
        }
        bool moves = false;
        for (const Word& word : words) {
            moves = take_axis(word) || moves;
        }
        return moves && motion_;
    }

private:
    bool absolute_ = true;
    bool motion_ = false;                     ///< G0 to G3 is in force, for all that is known
    std::array<std::optional<double>, 6> at_; ///< X Y Z A B C

    bool take_mode(double code) {
        const int tenths = static_cast<int>(std::lround(std::clamp(code, 0.0, 1000.0) * 10.0));
        constexpr std::array harmless = {170, 180, 190, 400, 610, 911, 930, 940};
        if (tenths == 0 || tenths == 10 || tenths == 20 || tenths == 30) {
            motion_ = true;
        } else if (tenths == 900 || tenths == 910) {
            absolute_ = tenths == 900;
            at_ = {};
        } else {
            return std::ranges::find(harmless, tenths) != harmless.end();
        }
        return true;
    }

    bool take_axis(const Word& word) {
        constexpr double enough = 0.1; // mm, inch or degree: more than a step of any machine
        constexpr std::string_view letters = "XYZABC";
        const std::size_t axis = letters.find(word.letter);
        if (axis == std::string_view::npos) {
            return false;
        }
        auto& at = at_[axis];
        if (!absolute_) {
            return std::abs(word.value) > enough;
        }
        const bool moves = at && std::abs(*at - word.value) > enough;
        at = word.value;
        return moves;
    }
};

bool has_code(const std::vector<Word>& words, char letter, std::initializer_list<int> tenths) {
    return std::ranges::any_of(words, [&](const Word& word) {
        constexpr double greatest_code = 1000.0;
        const long code = std::lround(std::clamp(word.value, 0.0, greatest_code) * 10.0);
        return word.letter == letter && std::ranges::find(tenths, code) != tenths.end();
    });
}

double dwell_in(const std::vector<Word>& words) {
    double seconds = 0.0;
    bool dwells = false;
    for (const Word& word : words) {
        dwells = dwells || (word.letter == 'G' && std::abs(word.value - 4.0) < 1e-6);
        seconds = word.letter == 'P' ? std::max(0.0, word.value) : seconds;
    }
    return dwells ? seconds : 0.0;
}

/// G10, G28.1, G30.1 and settings; in Grbl's interface documentation under "EEPROM Issues".
bool writes_eeprom(const std::vector<Word>& words) {
    return has_code(words, 'G', {100, 281, 301});
}

/// What Grbl brings to rest before it: G54 to G59.3, G92, tool lengths (G43 and its kin, G49, M6), G10, and
/// the end of a program.
bool moves_zero(const std::vector<Word>& words) {
    return has_code(
               words,
               'G',
               {100, 430, 431, 432, 490, 540, 550, 560, 570, 580, 590, 591, 592, 593, 920, 921, 922, 923}) ||
           has_code(words, 'M', {20, 60, 300});
}

void classify(ProgramLine& line) {
    if (line.is_setting()) {
        line.writes_eeprom = line.text.find('=') != std::string::npos;
        line.moves_zero = line.writes_eeprom; // $N0= executes what it stores
    } else if (const auto words = words_of(line.text)) {
        line.writes_eeprom = writes_eeprom(*words);
        line.moves_zero = moves_zero(*words);
    }
}

/// Why a $ command is not taken as a line; empty if it is.
std::string_view why_not(std::string_view text) {
    const bool asks = text == "$$" || text == "$#" || text == "$G" || text == "$N" || text == "$I" ||
                      text == "$I+" || text == "$" ||
                      (text.starts_with("$/") && text.find('=') == std::string_view::npos);
    const bool sets = text.size() > 2 && text.find('=') != std::string_view::npos &&
                      (text[1] == 'N' || (text[1] >= '0' && text[1] <= '9'));
    if (asks || sets) {
        return {};
    }
    if (text.starts_with("$H")) {
        return "use homing instead";
    }
    if (text.starts_with("$J")) {
        return "use a jog instead, which stops when it is no longer renewed";
    }
    return text.starts_with("$X") ? "use reset instead" : "it affects the whole controller";
}

/// Column of the first character of `line` that Grbl would not take any more.
int column_beyond(std::string_view line, const Place& place, std::size_t longest) {
    std::size_t within = 0;
    for (std::size_t beyond = line.size(); beyond - within > 1;) {
        const std::size_t half = within + (beyond - within) / 2;
        const bool fits = without_line_number(bare_text(line.substr(0, half), place)).size() <= longest;
        (fits ? within : beyond) = half;
    }
    return static_cast<int>(within) + 1;
}

void check_length(std::string_view text, std::string_view whole, Place place, std::size_t longest) {
    if (text.size() > longest) {
        place.column = whole.find('$') == std::string_view::npos ? column_beyond(whole, place, longest) : 1;
        fail(place,
             fmt::format("the line has {} characters, but Grbl accepts only {}", text.size(), longest),
             "split it into two lines");
    }
}

} // namespace

int ProgramLines::blocks_before(int count) const {
    return count < static_cast<int>(lines.size()) ? lines[static_cast<std::size_t>(count)].block : blocks;
}

ProgramLines
program_lines(const program::Listing& listing, const std::filesystem::path& file, std::size_t longest) {
    expect_text(listing, file);
    ProgramLines result;
    result.blocks = static_cast<int>(listing.line_of_block.size());
    SureMoves sure;
    for (int number = 1; number <= listing.line_count(); ++number) {
        const Place place{file, number, 0, -1};
        std::string text = without_line_number(bare_text(listing.line(number), place));
        if (text.empty()) {
            continue;
        }
        check_length(text, listing.line(number), place, longest);
        ProgramLine line{.text = std::move(text), .line = number};
        line.block = listing.block_at_line(number);
        classify(line);
        if (const auto words = words_of(line.text)) {
            line.surely_moves = sure.surely_moves(*words);
            line.dwell = dwell_in(*words);
        } else {
            sure = {};
        }
        result.lines.push_back(std::move(line));
    }
    return result;
}

ProgramLines command_lines(std::string_view text, std::size_t longest) {
    ProgramLines result;
    for (Place place{{}, 1, 0, -1}; !text.empty(); ++place.line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t first = line.find_first_not_of(" \t");
        const bool setting = first != std::string_view::npos && line[first] == '$';
        std::string bare = (setting ? "$" : "") + bare_text(setting ? line.substr(first + 1) : line, place);
        if (const std::string_view why = setting ? why_not(bare) : std::string_view(); !why.empty()) {
            fail(place, fmt::format("{} cannot be sent as a line", bare), std::string(why));
        }
        if (!bare.empty()) {
            check_length(bare, line, place, longest);
            result.lines.push_back({.text = std::move(bare), .line = place.line});
            result.lines.back().block = result.blocks++;
            classify(result.lines.back());
        }
    }
    if (result.lines.empty()) {
        throw Error("the command is empty");
    }
    return result;
}

} // namespace millwright::drivers::grbl
