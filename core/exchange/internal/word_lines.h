// The lines of a text file, ended by LF, CR LF or CR, as words between white space.
#pragma once

#include "core/base/text.h"
#include "core/exchange/internal/mesh_readers.h"

#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

namespace millwright::exchange {

class WordLines {
public:
    /// A byte order mark at the beginning is skipped.
    explicit WordLines(std::string_view text) : left_(without_byte_order_mark(text)) {}

    /// The words of the next line, which may be none; nothing at the end. Valid until the next call.
    [[nodiscard]] const std::vector<std::string_view>* next();
    /// Of the line that `next` gave, from 1.
    [[nodiscard]] int number() const { return number_; }
    /// What has not been read.
    [[nodiscard]] std::string_view rest() const { return left_; }

private:
    std::string_view left_;
    std::vector<std::string_view> words_;
    int number_ = 0;
    bool cr_alone_ = false; ///< as the first line ends: a LF behind a CR is not of the line, but what follows
};

/// The whole word as a number; nullopt if it is not a number, or does not fit.
template <typename Number> std::optional<Number> number_from(std::string_view word) {
    if (word.starts_with('+')) {
        word.remove_prefix(1);
    }
    Number value{};
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    return fault == std::errc{} && end == word.data() + word.size() ? std::optional(value) : std::nullopt;
}

/// Three numbers of a line, from word `first` on. Fails about the line if they are not there.
[[nodiscard]] Vec3
vector_from(const std::vector<std::string_view>& words, std::size_t first, const PolygonSoup& soup, int line);

} // namespace millwright::exchange
