#include "core/base/text_search.h"

#include "core/base/error.h"

#include <algorithm>
#include <utility>

namespace millwright {

namespace {

unsigned char small(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 'A' && byte <= 'Z' ? static_cast<unsigned char>(byte + ('a' - 'A')) : byte;
}

bool is_of_word(char c) {
    const unsigned char byte = small(c);
    constexpr unsigned char last_of_ascii = 127;
    return (byte >= 'a' && byte <= 'z') || (byte >= '0' && byte <= '9') || byte == '_' ||
           byte > last_of_ascii;
}

} // namespace

TextPattern::TextPattern(std::string_view text, TextMatching matching) : matching_(matching) {
    expects(!text.empty(), "there is something to look for");
    std::ranges::transform(
        text, std::back_inserter(text_), [this](char c) { return static_cast<char>(folded(c)); });
    skip_.fill(text_.size());
    for (std::size_t n = 0; n + 1 < text_.size(); ++n) {
        skip_[static_cast<unsigned char>(text_[n])] = text_.size() - 1 - n;
    }
}

unsigned char TextPattern::folded(char c) const {
    return matching_.same_case ? static_cast<unsigned char>(c) : small(c);
}

/// Whether a place where the letters are found counts.
bool TextPattern::fits(std::string_view text, std::size_t at) const {
    if (!matching_.whole_words) {
        return true;
    }
    const std::size_t end = at + text_.size();
    return !(at > 0 && is_of_word(text[at - 1]) && is_of_word(text[at])) &&
           !(end < text.size() && is_of_word(text[end]) && is_of_word(text[end - 1]));
}

/// Horspool's way: the last letter of the window tells how far it may be moved.
std::optional<std::size_t> TextPattern::next(std::string_view text, std::size_t from) const {
    const std::size_t length = text_.size();
    for (std::size_t at = from; at + length <= text.size();) {
        std::size_t n = length;
        while (n > 0 && folded(text[at + n - 1]) == static_cast<unsigned char>(text_[n - 1])) {
            --n;
        }
        if (n == 0 && fits(text, at)) {
            return at;
        }
        at += skip_[folded(text[at + length - 1])];
    }
    return std::nullopt;
}

std::optional<std::size_t> TextPattern::previous(std::string_view text, std::size_t before) const {
    constexpr std::size_t window = 65'536;
    std::size_t end = std::min(before, text.size());
    while (end > 0) {
        const std::size_t begin = end > window ? end - window : 0;
        const std::size_t border = end + text_.size(); // with the letter behind the last place
        const std::string_view part = text.substr(0, std::min(text.size(), border));
        std::optional<std::size_t> last;
        for (auto found = next(part, begin); found && *found < end; found = next(part, *found + 1)) {
            last = found;
        }
        if (last) {
            return last;
        }
        end = begin;
    }
    return std::nullopt;
}

ReplacedText
replaced_everywhere(std::string_view text, const TextPattern& pattern, std::string_view replacement) {
    ReplacedText found;
    std::size_t from = 0;
    for (auto at = pattern.next(text, 0); at; at = pattern.next(text, from)) {
        found.text += text.substr(from, *at - from);
        found.text += replacement;
        from = *at + pattern.size();
        ++found.count;
    }
    found.text += text.substr(from);
    return found;
}

TextCount::TextCount(std::string_view text, TextPattern pattern)
    : text_(text), pattern_(std::move(pattern)) {}

void TextCount::advance(std::size_t bytes) {
    const std::size_t end = std::min(text_.size(), at_ + bytes);
    // With the letter behind the last place, which tells whether a word ends there.
    const std::string_view part = text_.substr(0, std::min(text_.size(), end + pattern_.size()));
    auto found = pattern_.next(part, at_);
    for (; found && *found < end; found = pattern_.next(part, at_)) {
        ++count_;
        at_ = *found + pattern_.size();
    }
    at_ = std::max(at_, end);
}

} // namespace millwright
