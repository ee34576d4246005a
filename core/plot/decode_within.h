// Points for a machine that goes no faster than it can. mm/s.
#pragma once

#include "core/plot/decode.h"

#include <vector>

namespace millwright::plot {

/// As decode(). Rounding down or to nearest makes segments up to twice as fast as their velocity; where they
/// would be faster than `fastest` they have more steps. Throws Error, too, for a velocity above it.
[[nodiscard]] std::vector<Vec3> decode_within(double fastest,
                                              const Strokes& strokes,
                                              const DecodeSettings& settings,
                                              const Vec2& start = Vec2::Zero());

} // namespace millwright::plot
