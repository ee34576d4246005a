// One axis on its way through a block: where it turns back, and where it has a given position.
#pragma once

#include "core/motion/path.h"

namespace millwright::motion::internal {

/// A part of a block's way, as offsets into it.
struct Part {
    double begin = 0.0, end = 0.0;
};

/// The part of a block between two offsets, cut so that the axis only rises or only falls on each piece, and
/// goes linearly on a piece without a rounding.
[[nodiscard]] std::vector<Part> monotone_parts(const Path& path, int block, int axis, const Part& whole);

/// Where on a monotone part the axis is at `position`, which must lie between its ends.
[[nodiscard]] double offset_of(const Path& path, int block, int axis, const Part& part, double position);

} // namespace millwright::motion::internal
