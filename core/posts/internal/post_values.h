// Values of a post file that are checked while they are read: texts, choices, patterns with placeholders,
// lines.
#pragma once

#include "core/base/json.h"
#include "core/posts/post_format.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::posts::internal {

/// Printable ASCII, so that a file is the same in every code page; at most 200 characters.
std::string text_of(const JsonValue& value);

template <class Choice> using Names = std::initializer_list<std::pair<std::string_view, Choice>>;

template <class Choice> Choice choice(const JsonValue& value, Names<Choice> names) {
    const std::string text = value.text();
    std::vector<std::string_view> known;
    for (const auto& [name, meant] : names) {
        if (name == text) {
            return meant;
        }
        known.push_back(name);
    }
    value.fail(fmt::format("'{}' must be one of: {}", text, fmt::join(known, ", ")));
}

/// A text whose {words} are all in `allowed`, every brace belonging to one.
std::string pattern(const JsonValue& value, std::initializer_list<std::string_view> allowed);

/// At most 50 patterns, none empty.
Lines lines(const JsonValue& value, std::initializer_list<std::string_view> allowed = {});

/// Lines that are useless without `placeholder`, and may hold `optional_placeholder`.
Lines lines_with(const JsonValue& value,
                 std::string_view placeholder,
                 std::string_view optional_placeholder = {});

} // namespace millwright::posts::internal
