// Numbers of the core as they are shown to people: rows of settings for members at any depth.
#pragma once

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/project/setting_tables.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace millwright::project::internal {

/// How a number of the core is shown to people.
enum class As { it_is, degrees, mm_per_min };

template <As as> double from_people(double value) {
    return as == As::degrees ? from_degrees(value) : as == As::mm_per_min ? from_mm_per_min(value) : value;
}

/// A number that from_people() turns into exactly this one, and what a person typed before any other.
template <As as> double to_people(double value) {
    if (as == As::it_is) {
        return value;
    }
    const double turned = as == As::degrees ? to_degrees(value) : to_mm_per_min(value);
    constexpr double digits = 1e9;
    const double typed = std::round(turned * digits) / digits;
    const auto is_it = [&](double people) { return exactly_equal(from_people<as>(people), value); };
    if (is_it(typed)) {
        return typed;
    }
    constexpr int neighbours = 4;
    constexpr double far = std::numeric_limits<double>::infinity();
    double up = turned;
    double down = turned;
    for (int n = 0; n < neighbours; ++n) {
        if (is_it(up) || is_it(down)) {
            return is_it(up) ? up : down;
        }
        up = std::nextafter(up, far);
        down = std::nextafter(down, -far);
    }
    return turned;
}

/// The member at the end of a chain of members.
template <auto first, auto... rest> auto& reach(auto& owner) {
    if constexpr (sizeof...(rest) == 0) {
        return owner.*first;
    } else {
        return reach<rest...>(owner.*first);
    }
}

template <auto first> using OwnerOf = decltype(owner_of(first));

template <As as, auto first, auto... rest>
inline constexpr NumberField<OwnerOf<first>> number{
    [](const OwnerOf<first>& owner) { return to_people<as>(reach<first, rest...>(owner)); },
    [](OwnerOf<first>& owner, double value) { reach<first, rest...>(owner) = from_people<as>(value); },
    false};

template <auto first, auto... rest>
inline constexpr NumberField<OwnerOf<first>> count{
    [](const OwnerOf<first>& owner) { return static_cast<double>(reach<first, rest...>(owner)); },
    [](OwnerOf<first>& owner, double value) {
        reach<first, rest...>(owner) = static_cast<int>(std::round(value));
    },
    true};

/// People say 0 for none.
template <auto first, auto... rest>
inline constexpr NumberField<OwnerOf<first>> maybe{
    [](const OwnerOf<first>& owner) { return reach<first, rest...>(owner).value_or(0.0); },
    [](OwnerOf<first>& owner, double value) {
        reach<first, rest...>(owner) = value > 0.0 ? std::optional(value) : std::nullopt;
    },
    false};

/// The row called `id`. Throws Defect if there is none.
template <class Owner>
const NumberSetting<Owner>& number_row(std::span<const NumberSetting<Owner>> rows, std::string_view id) {
    for (const NumberSetting<Owner>& setting : rows) {
        if (setting.id == id) {
            return setting;
        }
    }
    throw Defect("there is no setting '" + std::string(id) + "'");
}

} // namespace millwright::project::internal
