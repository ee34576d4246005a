// Enumerators by their names in our JSON files.
#pragma once

#include "core/base/json.h"

#include <array>
#include <cstddef>
#include <string>

namespace millwright::jobs::internal {

/// The one of `all` whose to_text() is the text of `value`. Throws Error with its place for any other.
template <class Enum, std::size_t count>
[[nodiscard]] Enum named(const JsonValue& value, const std::array<Enum, count>& all) {
    const std::string name = value.text();
    for (const Enum one : all) {
        if (to_text(one) == name) {
            return one;
        }
    }
    value.fail("\"" + name + "\" is not a valid value");
}

} // namespace millwright::jobs::internal
