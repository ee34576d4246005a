#include "core/pmac/driver/internal/buffer_words.h"

#include "core/pmac/driver/card_words.h"
#include "core/pmac/driver/pmac_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace millwright::pmac::internal {

namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_blank(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

/// Adds `name` with what stands behind it. OPEN alone has arguments: behind the others a new part begins.
void add(std::vector<std::string>& parts, std::string_view name, std::string_view rest) {
    rest = trimmed(rest);
    if (name == "OPEN" && !rest.empty()) {
        parts.push_back(fmt::format("{} {}", name, rest));
        return;
    }
    for (const std::string_view part : {name, rest}) {
        if (!part.empty()) {
            parts.emplace_back(part);
        }
    }
}

} // namespace

std::vector<std::string> split_at_buffer_words(std::string_view line) {
    std::vector<std::string> parts;
    std::string name;
    std::size_t from = 0;
    for (const PlacedWord& word : placed_words(line)) {
        if (word.text == "OPEN" || word.text == "CLOSE" || word.text == "CLEAR") {
            add(parts, name, line.substr(from, word.begin - from));
            name = word.text;
            from = word.end;
        }
    }
    if (name.empty()) {
        return {std::string(line)};
    }
    add(parts, name, line.substr(from));
    return parts;
}

std::vector<std::string> split_at_buffer_words(const std::vector<std::string>& lines) {
    std::vector<std::string> all;
    for (const std::string& line : lines) {
        std::vector<std::string> parts = split_at_buffer_words(line);
        std::move(parts.begin(), parts.end(), std::back_inserter(all));
    }
    return all;
}

bool has_buffer_word(std::string_view line) {
    const std::vector<std::string> parts = split_at_buffer_words(line);
    return std::ranges::any_of(parts, [](const std::string& part) {
        return part == "CLOSE" || part == "CLEAR" || part == "OPEN" || part.starts_with("OPEN ");
    });
}

std::string at_once_message(std::string_view line) {
    return fmt::format(
        "'{}' is no line of a program: between OPEN and CLOSE the card would act on it at once", line);
}

std::string second_open_message(std::string_view line) {
    constexpr int buffer_in_use = 7;
    return fmt::format("'{}' is rejected: ERR{:03}, {}", line, buffer_in_use, pmac_error(buffer_in_use));
}

std::string second_open_hint(std::string_view open) {
    return fmt::format("write CLOSE before it: '{}' is not closed", open);
}

} // namespace millwright::pmac::internal
