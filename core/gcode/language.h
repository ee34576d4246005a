// Programs in other languages than RS-274, and files that are no programs: what a refused line shows of its
// control, or of its kind.
#pragma once

#include <optional>
#include <string_view>

namespace millwright::gcode {

enum class Language {
    klartext,    ///< Heidenhain's conversational blocks
    fanuc_macro, ///< Fanuc's custom macro B: IF, GOTO, WHILE ... DO
    sinumerik,   ///< Siemens: R parameters, X=..., keywords
    okuma,       ///< Okuma's OSP: variables VC1, VS1
    printer,     ///< of 3D printers: E words, heaters
    hpgl,        ///< of plotters: PU, PD, PA, SP
    xml,         ///< SVG among it
    mesh,        ///< STL as text
    step,        ///< STEP
    dxf,         ///< DXF as text
    json,        ///< a project, a machine file
    document     ///< PDF, PostScript
};

/// Where a language shows.
struct LineLanguage {
    Language language = Language::klartext;
    int line = 0; ///< from 1
};

/// What a line of RS-274 never has; nothing where there is no such thing. Blanks and comments do not count.
[[nodiscard]] std::optional<Language> language_of_line(std::string_view line);

/// Of the first line with more than a comment.
[[nodiscard]] std::optional<Language> language_of_first_line(std::string_view text);

/// The first line that shows one.
[[nodiscard]] std::optional<LineLanguage> first_language(std::string_view text);
/// The same without its line.
[[nodiscard]] std::optional<Language> language_of(std::string_view text);

/// "the Sinumerik language of Siemens", behind "this is"
[[nodiscard]] std::string_view name_of(Language language);
/// What to do with such a program.
[[nodiscard]] std::string_view advice_for(Language language);

} // namespace millwright::gcode
