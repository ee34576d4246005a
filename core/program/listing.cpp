#include "core/program/listing.h"

#include "core/base/error.h"

#include <algorithm>

namespace millwright::program {

std::string_view Listing::line(int line) const {
    expects(line >= 1 && line <= line_count(), "a line belongs to its listing");
    const std::size_t begin = line_starts[static_cast<std::size_t>(line) - 1];
    const std::size_t end = line_starts[static_cast<std::size_t>(line)];
    return std::string_view(text).substr(begin, end - begin - 1);
}

int Listing::block_at_line(int line) const {
    const auto after = std::upper_bound(line_of_block.begin(), line_of_block.end(), line);
    return static_cast<int>(after - line_of_block.begin()) - 1;
}

} // namespace millwright::program
