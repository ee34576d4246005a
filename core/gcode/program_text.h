// What a file has around its program: every reader of programs leaves it out in the same way.
#pragma once

#include "core/base/text.h"
#include "core/program/listing.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace millwright::gcode {

/// How long the byte order mark of UTF-8 is with which `text` begins; 0 where there is none.
[[nodiscard]] inline std::size_t length_of_byte_order_mark(std::string_view text) {
    return text.size() - without_byte_order_mark(text).size();
}

/// `last_line`, which has no end of its own, without what fills the last block of a file: the mark of DOS for
/// the end (byte 0x1A) and zero bytes.
[[nodiscard]] constexpr std::string_view without_filling(std::string_view last_line) {
    while (!last_line.empty() && (last_line.back() == '\x1A' || last_line.back() == '\0')) {
        last_line.remove_suffix(1);
    }
    return last_line;
}

/// `bytes` without either.
[[nodiscard]] inline std::string_view program_text(std::string_view bytes) {
    return without_filling(without_byte_order_mark(bytes));
}

/// The lines of a file, each that is not empty being a block. Throws Error if there is none.
[[nodiscard]] program::Listing listing_of(std::string text, const std::filesystem::path& file);

} // namespace millwright::gcode
