// Between the tables of settings and JSON: the same rows say what is read, what is refused, what is written.
#pragma once

#include "core/base/json.h"
#include "core/geometry/vectors.h"
#include "core/project/setting_tables.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::project {

using Json = nlohmann::ordered_json;

[[nodiscard]] inline Json point_json(const Vec3& p) {
    return Json::array({p.x(), p.y(), p.z()});
}

/// mm; throws Error unless `value` is three numbers within the largest distance.
[[nodiscard]] inline Vec3 point_of(const JsonValue& value) {
    const auto items = value.items(3);
    Vec3 p;
    for (std::size_t n = 0; n < 3; ++n) {
        p[static_cast<Eigen::Index>(n)] = items[n].number(-farthest_point_mm, farthest_point_mm);
    }
    return p;
}

template <class Value> Value choice(const JsonValue& value, std::span<const Choice<Value>> choices) {
    const std::string text = value.text();
    std::string known;
    for (const Choice<Value>& row : choices) {
        if (row.id == text) {
            return row.value;
        }
        known += (known.empty() ? "known: " : ", ") + std::string(row.id);
    }
    value.fail(fmt::format("'{}' is not a valid choice", text), known);
}

template <class Value>
void read_choice(const JsonValue& from,
                 std::string_view key,
                 std::span<const Choice<Value>> choices,
                 Value& to) {
    if (const auto value = from.find(key)) {
        to = choice(*value, choices);
    }
}

inline void read_flag(const JsonValue& from, std::string_view key, bool& to) {
    if (const auto value = from.find(key)) {
        to = value->flag();
    }
}

template <class Owner>
void read_numbers(const JsonValue& from, std::span<const NumberSetting<Owner>> settings, Owner& to) {
    for (const NumberSetting<Owner>& setting : settings) {
        if (const auto value = from.find(setting.id)) {
            const double number =
                setting.whole() ? value->integer(static_cast<int>(setting.min), static_cast<int>(setting.max))
                                : value->number(setting.min, setting.max);
            setting.set(to, number);
        }
    }
}

/// Refuses fields that are neither a number of the table nor one of `others`.
template <class Owner>
void expect_fields(const JsonValue& value,
                   std::span<const NumberSetting<Owner>> numbers,
                   std::initializer_list<std::string_view> others) {
    std::vector<std::string_view> keys;
    for (const NumberSetting<Owner>& setting : numbers) {
        keys.push_back(setting.id);
    }
    keys.insert(keys.end(), others);
    value.expect_only(keys);
}

template <class Owner>
void add_numbers(Json& json, std::span<const NumberSetting<Owner>> settings, const Owner& owner) {
    for (const NumberSetting<Owner>& setting : settings) {
        const double value = setting.value(owner);
        if (setting.whole()) {
            json[std::string(setting.id)] = static_cast<int>(value);
        } else {
            json[std::string(setting.id)] = value;
        }
    }
}

} // namespace millwright::project
