#include "core/gcode/program_text.h"

#include "core/base/error.h"
#include "core/gcode/line_ends.h"

#include <utility>

namespace millwright::gcode {

program::Listing listing_of(std::string text, const std::filesystem::path& file) {
    program::Listing listing;
    text = with_newlines(std::string(program_text(text)));
    if (!text.empty() && text.back() != '\n') {
        text += '\n';
    }
    listing.text = std::move(text);
    listing.line_starts.push_back(0);
    for (std::size_t n = 0; n < listing.text.size(); ++n) {
        if (listing.text[n] != '\n') {
            continue;
        }
        const std::string_view line =
            std::string_view(listing.text).substr(listing.line_starts.back(), n - listing.line_starts.back());
        if (line.find_first_not_of(" \t\r") != std::string_view::npos) {
            listing.line_of_block.push_back(static_cast<int>(listing.line_starts.size()));
        }
        listing.line_starts.push_back(n + 1);
    }
    if (listing.line_of_block.empty()) {
        throw Error(Diagnostic{{file, 1, 1, -1}, "the program is empty", {}});
    }
    return listing;
}

} // namespace millwright::gcode
