#include "core/posts/internal/post_values.h"

#include <algorithm>

namespace millwright::posts::internal {

namespace {

constexpr std::size_t longest_text = 200;
constexpr int most_lines = 50;

/// Throws unless each {word} of `text` is in `allowed` and every brace belongs to one.
void check_placeholders(const JsonValue& value,
                        const std::string& text,
                        std::initializer_list<std::string_view> allowed) {
    for (std::size_t at = text.find_first_of("{}"); at != std::string::npos;
         at = text.find_first_of("{}", at)) {
        const std::size_t end = text[at] == '{' ? text.find('}', at) : std::string::npos;
        if (end == std::string::npos) {
            value.fail(fmt::format("the braces of '{}' do not match", text));
        }
        const std::string word = text.substr(at + 1, end - at - 1);
        if (std::find(allowed.begin(), allowed.end(), word) == allowed.end()) {
            const std::string known = allowed.size() == 0
                                          ? std::string("no placeholders are allowed here")
                                          : fmt::format("allowed here: {}", fmt::join(allowed, ", "));
            value.fail(fmt::format("unknown placeholder {{{}}}", word), known);
        }
        at = end + 1;
    }
}

} // namespace

std::string text_of(const JsonValue& value) {
    std::string text = value.text();
    const auto printable = [](char c) { return c >= ' ' && c <= '~'; };
    if (!std::all_of(text.begin(), text.end(), printable)) {
        value.fail("a program text must consist of printable ASCII characters");
    }
    if (text.size() > longest_text) {
        value.fail(fmt::format("a text can have at most {} characters", longest_text));
    }
    return text;
}

std::string pattern(const JsonValue& value, std::initializer_list<std::string_view> allowed) {
    std::string text = text_of(value);
    check_placeholders(value, text, allowed);
    return text;
}

Lines lines(const JsonValue& value, std::initializer_list<std::string_view> allowed) {
    Lines result;
    for (const JsonValue& item : value.items()) {
        result.push_back(pattern(item, allowed));
        if (result.back().empty()) {
            item.fail("a line must not be empty");
        }
    }
    if (std::ssize(result) > most_lines) {
        value.fail(fmt::format("at most {} lines are allowed", most_lines));
    }
    return result;
}

Lines lines_with(const JsonValue& value,
                 std::string_view placeholder,
                 std::string_view optional_placeholder) {
    Lines result =
        lines(value, {placeholder, optional_placeholder.empty() ? placeholder : optional_placeholder});
    const auto holds = [&](const std::string& line) {
        return line.find(fmt::format("{{{}}}", placeholder)) != std::string::npos;
    };
    if (!result.empty() && std::none_of(result.begin(), result.end(), holds)) {
        value.fail(fmt::format("{{{}}} is missing", placeholder));
    }
    return result;
}

} // namespace millwright::posts::internal
