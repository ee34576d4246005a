#include "core/exchange/internal/cad_text.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>

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

} // namespace millwright::exchange
