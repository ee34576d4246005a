// Finding a piece of text in a long one, and putting another in its place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace millwright {

/// What counts as the same.
struct TextMatching {
    bool same_case = false;   ///< else capital and small letters of ASCII are the same
    bool whole_words = false; ///< neither letter, digit nor _ stands directly before or behind

    friend bool operator==(const TextMatching&, const TextMatching&) = default;
};

class TextPattern {
public:
    /// Throws Defect if it is empty.
    explicit TextPattern(std::string_view text, TextMatching matching = {});

    [[nodiscard]] std::size_t size() const { return text_.size(); }
    /// The first place at `from` or later.
    [[nodiscard]] std::optional<std::size_t> next(std::string_view text, std::size_t from) const;
    /// The last place before `before`.
    [[nodiscard]] std::optional<std::size_t> previous(std::string_view text, std::size_t before) const;

private:
    [[nodiscard]] unsigned char folded(char c) const;
    [[nodiscard]] bool fits(std::string_view text, std::size_t at) const;

    std::string text_; ///< in small letters, unless their case counts
    TextMatching matching_;
    std::array<std::size_t, 256> skip_{};
};

struct ReplacedText {
    std::string text;
    std::int64_t count = 0; ///< of places
};

/// Every place from the beginning on; what was put in is not searched again.
[[nodiscard]] ReplacedText
replaced_everywhere(std::string_view text, const TextPattern& pattern, std::string_view replacement);

/// Counts in small steps, so that the caller never waits for it. Places that overlap count once.
class TextCount {
public:
    /// `text` must live as long.
    TextCount(std::string_view text, TextPattern pattern);

    /// Looks at about so many bytes more.
    void advance(std::size_t bytes);
    [[nodiscard]] bool done() const { return at_ >= text_.size(); }
    [[nodiscard]] std::int64_t count() const { return count_; }

private:
    std::string_view text_;
    TextPattern pattern_;
    std::size_t at_ = 0;
    std::int64_t count_ = 0;
};

} // namespace millwright
