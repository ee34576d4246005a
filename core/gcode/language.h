// Programs in other languages than RS-274: what a refused line shows of its control.
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
    hpgl         ///< of plotters: PU, PD, PA, SP
};

/// What a line of RS-274 never has; nothing where there is no such thing. Blanks and comments do not count.
[[nodiscard]] std::optional<Language> language_of_line(std::string_view line);

/// Of the first line with more than a comment.
[[nodiscard]] std::optional<Language> language_of_first_line(std::string_view text);

/// Of the first line that shows one.
[[nodiscard]] std::optional<Language> language_of(std::string_view text);

/// "Sinumerik's language"
[[nodiscard]] std::string_view name_of(Language language);
/// What to do with such a program.
[[nodiscard]] std::string_view advice_for(Language language);

} // namespace millwright::gcode
