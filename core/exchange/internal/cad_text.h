// What the text of a STEP or IGES file tells before the library makes anything of it. The library takes nan
// and 1e400 for coordinates, and may then never end.
#pragma once

#include "core/base/progress.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace millwright::exchange {

/// In the unit of the file; a million kilometres where that is the metre.
inline constexpr double farthest_coordinate = 1e9;

/// How many faces the text of a STEP file names, 0 and more. Throws Error with the line of the first invalid
/// number ("nan", "1.#INF", "1e400") or point beyond farthest_coordinate; Cancelled.
[[nodiscard]] int
checked_step_text(const std::string& text, const std::filesystem::path& file, const Progress& progress);

/// The same of the numbers of an IGES file; as a point counts every real number of a curve, a surface or a
/// list of corners.
void check_iges_text(std::string_view text, const std::filesystem::path& file, const Progress& progress);

/// Where a number stands, for what is said of it.
struct NumberPlace {
    std::filesystem::path file;
    int line = 1;
    std::string of; ///< "#12 CARTESIAN_POINT"
};

/// Throws Error if `word` begins with no finite number, or with one as "1.#INF" is written; of a coordinate
/// also if it is not a number to its end, or beyond farthest_coordinate.
void expect_usable_number(const std::string& word, bool coordinate, const NumberPlace& place);

/// Whether the word, sign and case aside, is how programs write what is no number: nan, inf, infinity.
[[nodiscard]] bool names_no_number(std::string_view word);

} // namespace millwright::exchange
