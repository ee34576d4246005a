#include "core/gcode/language.h"

#include "core/gcode/internal/cursor.h"
#include "core/gcode/program_text.h"

#include <algorithm>
#include <array>
#include <string>

namespace millwright::gcode {

namespace {

using internal::is_digit;

constexpr std::size_t longest_beginning = 80; ///< of a line by which a kind of file is known

bool is_capital(char c) {
    return c >= 'A' && c <= 'Z';
}

/// In capitals, single blanks between words, without comments and without the number before a block.
std::string plain_line(std::string_view line) {
    std::string text;
    bool in_comment = false;
    for (const char c : line) {
        if (c == ';') {
            break;
        }
        in_comment = in_comment || c == '(';
        if (!in_comment) {
            const bool blank = internal::is_blank(c);
            if (!blank || (!text.empty() && text.back() != ' ')) {
                text += blank ? ' ' : internal::to_upper(c);
            }
        }
        in_comment = in_comment && c != ')';
    }
    const std::size_t number = text.find_first_not_of("0123456789 ", text.starts_with('N') ? 1 : 0);
    return number == std::string::npos ? std::string() : text.substr(number);
}

/// The words that `text` begins with, as whole words.
template <std::size_t count>
bool begins_with_one(std::string_view text, const std::array<std::string_view, count>& words) {
    return std::ranges::any_of(words, [&](std::string_view word) {
        return text.starts_with(word) && (text.size() == word.size() || !is_capital(text[word.size()]));
    });
}

/// As a word of its own.
bool has_word(std::string_view text, std::string_view word) {
    for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !is_capital(text[at - 1])) && (end == text.size() || !is_capital(text[end]))) {
            return true;
        }
    }
    return false;
}

bool is_klartext(std::string_view text) {
    constexpr std::array<std::string_view, 14> begins{"BEGIN PGM",
                                                      "END PGM",
                                                      "TOOL CALL",
                                                      "TOOL DEF",
                                                      "CYCL DEF",
                                                      "CYCL CALL",
                                                      "BLK FORM",
                                                      "FUNCTION",
                                                      "PLANE SPATIAL",
                                                      "CALL LBL",
                                                      "LBL",
                                                      "CALL PGM",
                                                      "APPR",
                                                      "DEP"};
    // L X+10 Y-5 R0 FMAX, CC X+0 Y+0, C X+5 Y+0 DR+
    const bool is_path = text.starts_with("L ") || text.starts_with("CC ") || text.starts_with("C ");
    const bool has_signs =
        text.find("X+") != std::string_view::npos || text.find("Y+") != std::string_view::npos ||
        text.find("Z+") != std::string_view::npos || text.find("X-") != std::string_view::npos ||
        text.find("Y-") != std::string_view::npos || text.find("Z-") != std::string_view::npos ||
        has_word(text, "FMAX");
    return begins_with_one(text, begins) || (is_path && has_signs);
}

bool is_fanuc_macro(std::string_view text) {
    constexpr std::array<std::string_view, 9> begins{
        "IF", "WHILE", "GOTO", "DPRNT", "BPRNT", "POPEN", "PCLOS", "SETVN", "G65"};
    constexpr std::array<std::string_view, 3> ends{"END1", "END2", "END3"};
    return (begins_with_one(text, begins) && text.find('=') == std::string_view::npos) ||
           std::ranges::find(ends, text) != ends.end() || text.starts_with("IF[") || text.starts_with("IF [");
}

/// VC1=5, X=VC1, IF[VC1 EQ 5]N100, G15 H1
bool is_okuma(std::string_view text) {
    if (text.starts_with("G15 H") || text.starts_with("G15H")) { // the work system by its number
        return true;
    }
    for (const std::string_view name : {"VC", "VS", "VZOF"}) {
        for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
            const std::size_t end = at + name.size();
            const bool begins = at == 0 || !is_capital(text[at - 1]);
            const bool goes_on = end < text.size() && (is_digit(text[end]) || text[end] == '[' ||
                                                       (name == "VZOF" && is_capital(text[end])));
            if (begins && goes_on && (at > 0 || text.find('=') != std::string_view::npos)) {
                return true;
            }
        }
    }
    return false;
}

/// G450, G500, G505 to G599, G601, G641, G710: of three digits, and those of no other control.
bool has_long_g_of_sinumerik(std::string_view text) {
    constexpr std::array<std::string_view, 13> codes{
        "450", "451", "460", "461", "601", "602", "603", "641", "642", "643", "645", "700", "710"};
    for (std::size_t at = text.find('G'); at != std::string_view::npos; at = text.find('G', at + 1)) {
        const std::size_t end = std::min(text.find_first_not_of("0123456789", at + 1), text.size());
        const std::string_view digits = text.substr(at + 1, end - at - 1);
        const bool begins = at == 0 || !is_capital(text[at - 1]);
        if (begins &&
            ((digits.size() == 3 && digits[0] == '5') || std::ranges::find(codes, digits) != codes.end())) {
            return true;
        }
    }
    return false;
}

/// What a printer or plotter takes before the plot: PJL, which holds words of any language, escapes of PCL,
/// and a comment of HPGL.
bool begins_a_plot(std::string_view line) {
    const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
    line.remove_prefix(first);
    return line.starts_with('\x1B') || line.starts_with("@PJL") || line.starts_with("CO\"");
}

/// <svg width="10">, </g>, <!-- -->, <?xml ?>
bool is_xml(std::string_view line) {
    const std::string_view behind = line.substr(std::min<std::size_t>(1, line.size()), 1);
    return line.starts_with('<') && !behind.empty() &&
           (std::string_view("?!/").find(behind[0]) != std::string_view::npos ||
            is_capital(internal::to_upper(behind[0])));
}

/// Of files that are no programs, by how a line of theirs begins.
std::optional<Language> kind_of_file(std::string_view line) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    line.remove_prefix(line.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const std::string text = plain_line(line.substr(0, longest_beginning));
    if (is_xml(line)) {
        return Language::xml;
    }
    if (line.starts_with("%PDF-") || line.starts_with("%!PS")) {
        return Language::document;
    }
    if (line.starts_with('{') || line.starts_with("[{")) {
        return Language::json;
    }
    if (text == "SOLID" || text.starts_with("SOLID ") || text.starts_with("FACET NORMAL ")) {
        return Language::mesh;
    }
    if (text.starts_with("ISO-10303-21")) {
        return Language::step;
    }
    return text == "SECTION" ? std::optional(Language::dxf) : std::nullopt;
}

/// IN, SP1, PU0,0, PA100,200: a command of two letters and its numbers.
bool is_hpgl(std::string_view text) {
    constexpr std::array<std::string_view, 9> commands{"IN", "DF", "SP", "PU", "PD", "PA", "PR", "IP", "SC"};
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view command = text.substr(at, 2);
        const std::size_t end = std::min(text.find_first_not_of("0123456789+-., ", at + 2), text.size());
        const bool takes_numbers = command != "IN" && command != "DF";
        const bool ends = end == text.size() || end > at + 2 || !takes_numbers;
        if (command.size() < 2 || std::ranges::find(commands, command) == commands.end() || !ends) {
            return false;
        }
        at = end;
    }
    return !text.empty();
}

/// R1=5, X=R1, CR=10, S1=1000: a letter or a name with =.
bool assigns_by_letter(std::string_view text) {
    const std::size_t at = text.find('=');
    if (at == std::string_view::npos || at == 0 || text.find('#') < at) {
        return false;
    }
    std::size_t begin = at;
    while (begin > 0 &&
           (is_digit(text[begin - 1]) || is_capital(text[begin - 1]) || text[begin - 1] == '_')) {
        --begin;
    }
    return begin < at && is_capital(text[begin]);
}

bool is_sinumerik(std::string_view text) {
    constexpr std::array<std::string_view, 24> begins{
        "DEF",   "PROC",   "EXTERN", "MSG",    "CYCLE",  "POCKET",    "TRANS", "ATRANS",
        "ROT",   "AROT",   "MIRROR", "SCALE",  "TRAORI", "TRAFOOF",   "MCALL", "GOTOF",
        "GOTOB", "STOPRE", "DIAMON", "DIAMOF", "SUPA",   "WORKPIECE", "RET",   "ENDPROC"};
    constexpr std::array<std::string_view, 4> inside{"GOTOF", "GOTOB", "SUPA", "FNORM"};
    const bool has_name = text.find("$P_") != std::string_view::npos ||
                          text.find("$A") != std::string_view::npos || text.starts_with("%_N_");
    return begins_with_one(text, begins) || has_name || assigns_by_letter(text) ||
           has_long_g_of_sinumerik(text) ||
           std::ranges::any_of(inside, [&](std::string_view word) { return has_word(text, word); });
}

/// G1 X10 Y20 E0.5: a blank before E, or it is a number with an exponent.
bool is_printer(std::string_view text) {
    constexpr std::array<std::string_view, 12> begins{
        "M82", "M83", "M104", "M106", "M107", "M109", "M140", "M190", "M84", "M117", "M204", "M205"};
    const bool heats = std::ranges::any_of(begins, [&](std::string_view word) {
        return text.starts_with(word) && (text.size() == word.size() || !is_digit(text[word.size()]));
    });
    const std::size_t at = text.find(" E");
    const bool extrudes = at != std::string_view::npos && at + 2 < text.size() &&
                          std::string_view("0123456789.-+").find(text[at + 2]) != std::string_view::npos;
    constexpr std::array<std::string_view, 5> moves{"G0", "G1", "G00", "G01", "G92"};
    const bool moves_straight = std::ranges::any_of(moves, [&](std::string_view word) {
        return text.starts_with(word) && text.size() > word.size() && text[word.size()] == ' ';
    });
    return heats || (extrudes && moves_straight);
}

} // namespace

std::optional<Language> language_of_line(std::string_view line) {
    if (begins_a_plot(line)) {
        return Language::hpgl;
    }
    if (const auto kind = kind_of_file(line)) {
        return kind;
    }
    const std::string text = plain_line(line);
    if (is_klartext(text)) {
        return Language::klartext;
    }
    if (is_okuma(text)) {
        return Language::okuma;
    }
    if (is_fanuc_macro(text)) {
        return Language::fanuc_macro;
    }
    if (is_sinumerik(text)) {
        return Language::sinumerik;
    }
    if (is_printer(text)) {
        return Language::printer;
    }
    return is_hpgl(text) ? std::optional(Language::hpgl) : std::nullopt;
}

std::optional<Language> language_of_first_line(std::string_view text) {
    text = program_text(text);
    while (!text.empty()) {
        const std::string_view line = text.substr(0, end_of_line(text));
        if (const auto found = language_of_line(line); found || !plain_line(line).empty()) {
            return found;
        }
        text.remove_prefix(next_line(text, 0));
    }
    return std::nullopt;
}

std::optional<LineLanguage> first_language(std::string_view text) {
    text = program_text(text);
    for (int line = 1; !text.empty(); ++line) {
        if (const auto found = language_of_line(text.substr(0, end_of_line(text)))) {
            return LineLanguage{*found, line};
        }
        text.remove_prefix(next_line(text, 0));
    }
    return std::nullopt;
}

std::optional<Language> language_of(std::string_view text) {
    const std::optional<LineLanguage> found = first_language(text);
    return found ? std::optional(found->language) : std::nullopt;
}

std::string_view name_of(Language language) {
    switch (language) {
    case Language::klartext:
        return "Heidenhain Klartext";
    case Language::fanuc_macro:
        return "Fanuc custom macro B";
    case Language::sinumerik:
        return "the Siemens Sinumerik language";
    case Language::okuma:
        return "the language of Okuma OSP controls";
    case Language::printer:
        return "a program for a 3D printer";
    case Language::hpgl:
        return "HPGL, a plot";
    case Language::xml:
        return "an XML file (an SVG drawing is one)";
    case Language::mesh:
        return "an STL mesh";
    case Language::step:
        return "a STEP file";
    case Language::dxf:
        return "a DXF drawing";
    case Language::json:
        return "a JSON file (projects and machine files are)";
    case Language::document:
        return "a PDF or PostScript document";
    }
    return "another language";
}

std::string_view advice_for(Language language) {
    switch (language) {
    case Language::klartext:
        return "only 'millwright gcode check' can read it, as written by our post-processors; otherwise "
               "post-process the part for LinuxCNC or Grbl";
    case Language::fanuc_macro:
        return "use the O-words of LinuxCNC instead: o1 if, o1 while, o1 repeat, o<name> call";
    case Language::sinumerik:
    case Language::okuma:
        return "post-process the part for LinuxCNC or Grbl";
    case Language::hpgl:
        return "show it with 'millwright plot info', or convert it to a program with 'millwright plot "
               "toolpath'";
    case Language::printer:
        return "use a program without extruder and heater commands";
    case Language::xml:
    case Language::dxf:
    case Language::document:
        return "save a drawing as HPGL: 'millwright plot toolpath' makes a program of it";
    case Language::mesh:
    case Language::step:
        return "use 'millwright import' to read it";
    case Language::json:
        return "use 'millwright plan' to make the program of a project";
    }
    return "";
}

} // namespace millwright::gcode
