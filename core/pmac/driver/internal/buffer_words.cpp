#include "core/pmac/driver/internal/buffer_words.h"

#include "core/pmac/driver/pmac_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace millwright::pmac::internal {

namespace {

struct Word {
    std::string_view written, name;
};

constexpr std::array<Word, 5> buffer_words{
    {{"OPEN", "OPEN"}, {"CLOSE", "CLOSE"}, {"CLS", "CLOSE"}, {"CLEAR", "CLEAR"}, {"CLR", "CLEAR"}}};

char upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

/// Where `word` ends that begins at `at`; npos if it does not.
std::size_t end_of(std::string_view word, std::string_view line, std::size_t at) {
    for (const char expected : word) {
        while (at < line.size() && is_blank(line[at])) {
            ++at;
        }
        if (at == line.size() || upper(line[at]) != expected) {
            return std::string_view::npos;
        }
        ++at;
    }
    return at;
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
    std::string_view name;
    std::size_t from = 0;
    bool quoted = false;
    for (std::size_t at = 0; at < line.size();) {
        quoted = quoted != (line[at] == '"');
        const auto* const word = quoted || is_blank(line[at])
                                     ? buffer_words.end()
                                     : std::ranges::find_if(buffer_words, [&](const Word& one) {
                                           return end_of(one.written, line, at) != std::string_view::npos;
                                       });
        if (word == buffer_words.end()) {
            ++at;
            continue;
        }
        add(parts, name, line.substr(from, at - from));
        name = word->name;
        at = from = end_of(word->written, line, at);
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

std::string second_open_message(std::string_view line) {
    constexpr int buffer_in_use = 7;
    return fmt::format("'{}' is rejected: ERR{:03}, {}", line, buffer_in_use, pmac_error(buffer_in_use));
}

std::string second_open_hint(std::string_view open) {
    return fmt::format("write CLOSE before it: '{}' is not closed", open);
}

} // namespace millwright::pmac::internal
