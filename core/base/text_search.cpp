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

} // namespace

TextPattern::TextPattern(std::string_view text) {
    expects(!text.empty(), "there is something to look for");
    std::ranges::transform(
        text, std::back_inserter(text_), [](char c) { return static_cast<char>(small(c)); });
    skip_.fill(text_.size());
    for (std::size_t n = 0; n + 1 < text_.size(); ++n) {
        skip_[static_cast<unsigned char>(text_[n])] = text_.size() - 1 - n;
    }
}

/// Horspool's way: the last letter of the window tells how far it may be moved.
std::optional<std::size_t> TextPattern::next(std::string_view text, std::size_t from) const {
    const std::size_t length = text_.size();
    for (std::size_t at = from; at + length <= text.size();) {
        std::size_t n = length;
        while (n > 0 && small(text[at + n - 1]) == static_cast<unsigned char>(text_[n - 1])) {
            --n;
        }
        if (n == 0) {
            return at;
        }
        at += skip_[small(text[at + length - 1])];
    }
    return std::nullopt;
}

std::optional<std::size_t> TextPattern::previous(std::string_view text, std::size_t before) const {
    constexpr std::size_t window = 65'536;
    std::size_t end = std::min(before, text.size());
    while (end > 0) {
        const std::size_t begin = end > window ? end - window : 0;
        const std::string_view part = text.substr(0, std::min(text.size(), end + text_.size() - 1));
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

TextCount::TextCount(std::string_view text, TextPattern pattern)
    : text_(text), pattern_(std::move(pattern)) {}

void TextCount::advance(std::size_t bytes) {
    const std::size_t end = std::min(text_.size(), at_ + bytes);
    const std::string_view part = text_.substr(0, std::min(text_.size(), end + pattern_.size() - 1));
    auto found = pattern_.next(part, at_);
    for (; found; found = pattern_.next(part, at_)) {
        ++count_;
        at_ = *found + pattern_.size();
    }
    at_ = std::max(at_, end);
}

} // namespace millwright
