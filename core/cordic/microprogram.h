// The processor's microprogram. The thesis prints none; this one fits its stack, its registers and its 74
// clocks.
#pragma once

#include "core/cordic/microcode.h"
#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace millwright::cordic {

/// How set-points reach the motion controller.
enum class Publishing : std::uint8_t {
    latch, ///< all at once in one clock, as the thesis's clock count assumes
    bus    ///< byte by byte over the bus
};

/// Its text for the micro-assembler.
[[nodiscard]] std::string microprogram_text(Publishing publishing);

/// The numbers that the text names: LAST_STEP, LAST_CORRECTION, LAST_BYTE and so on.
[[nodiscard]] std::vector<std::pair<std::string, int>> microprogram_constants(const Sequence& sequence,
                                                                              const NumberFormat& format);

/// The text assembled with the counts of a sequence and the immediate size of a format.
[[nodiscard]] Microprogram
make_microprogram(const Sequence& sequence, const NumberFormat& format, Publishing publishing);

} // namespace millwright::cordic
