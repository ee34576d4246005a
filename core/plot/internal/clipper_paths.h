// Regions as Clipper has them, in whole numbers of a millionth of a millimetre, and its offsets.
#pragma once

#include "core/plot/compensation.h"

#include <polyclipping/clipper.hpp>

namespace millwright::plot::internal {

/// Throws Error for what is not finite and for coordinates beyond 1 km.
[[nodiscard]] ClipperLib::Paths to_clipper(const Region& region);

[[nodiscard]] Region from_clipper(const ClipperLib::Paths& paths);

/// Grown by `distance`, mm; the outermost rings have one sense, those within them turn about. Throws Error
/// for an offset beyond 1 km and an invalid tolerance.
[[nodiscard]] ClipperLib::Paths
offset_paths(const ClipperLib::Paths& paths, double distance, Corners corners, double arc_tolerance);

} // namespace millwright::plot::internal
