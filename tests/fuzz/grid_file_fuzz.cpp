// Any bytes give an array or an Error, never a crash or a number that is not finite; what was read and is
// written again is read as the same array.
#include "core/grid/grid_file.h"

#include "core/base/error.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

using namespace millwright;
using namespace millwright::grid;

void demand(bool promise) {
    if (!promise) {
        std::abort();
    }
}

void try_blocks(std::string_view text, FileContents contents) {
    try {
        const NodeArray found = parse_blocks(text, "fuzz.dat", contents);
        demand(all_finite(found) && found.rows >= 2 && found.columns >= 2);
        const NodeArray again = parse_blocks(blocks_text(found), "again.dat", FileContents::residuals);
        demand(blocks_text(again) == blocks_text(found));
    } catch (const Error& error) {
        demand(error.diagnostic().place.line > 0);
    }
}

void try_pairs(std::string_view text, int rows, int columns) {
    try {
        demand(all_finite(parse_pairs(text, "fuzz.dat", rows, columns)));
    } catch (const Error& error) {
        demand(error.diagnostic().place.line > 0);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try_blocks(text, FileContents::nodes);
    try_blocks(text, FileContents::residuals);
    try_pairs(text, 2, 2);
    try_pairs(text, 3, 2);
    return 0;
}
