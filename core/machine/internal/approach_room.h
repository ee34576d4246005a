// The lines above the one where a program is begun in its middle: there its approach is written.
#pragma once

#include <filesystem>

namespace millwright::machine::internal {

/// Throws Error for a run from `line` of `file`, whose first block stands at `first_block`, if that is among
/// the first `approach_lines`.
void check_room_above(int first_block, int line, const std::filesystem::path& file);

} // namespace millwright::machine::internal
