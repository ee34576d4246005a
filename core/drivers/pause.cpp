#include "core/drivers/pause.h"

#include <fmt/format.h>

namespace millwright::drivers {

std::string reason_of_pause(const program::Program& program, const program::Listing* listing, int block) {
    const auto n = static_cast<std::size_t>(block);
    const program::Block& pause = program.blocks[n];
    const int line = listing != nullptr ? listing->line_of_block[n] : pause.source_line;
    const std::string what = pause.text.empty() ? "pause" : pause.text;
    return line > 0 ? fmt::format("{} at line {}: {}", what, line, code_of(pause.pause))
                    : fmt::format("{}: {}", what, code_of(pause.pause));
}

} // namespace millwright::drivers
