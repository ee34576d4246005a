// Programs made at random, of codes that LinuxCNC and we understand alike; the same seed gives the same
// program.
#pragma once

#include <string>

namespace millwright::test {

/// Moves, arcs, cycles, offsets, expressions, loops and settings in any mixture.
[[nodiscard]] std::string random_program_text(unsigned seed);

/// A contour of lines and arcs under cutter compensation, often one that the tool cannot follow.
[[nodiscard]] std::string random_contour(unsigned seed);

} // namespace millwright::test
