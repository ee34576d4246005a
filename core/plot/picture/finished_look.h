// What stands when a path has been cut, and how it looks. Lengths mm; z = 0 is the top of the plate.
#pragma once

#include "core/base/progress.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/height_field.h"
#include "core/plot/picture/picture.h"
#include "core/plot/picture/tool_tip.h"

#include <map>

namespace millwright::plot {

/// The surface that `tip` leaves of a plate on all moves of `path`, as a field that holds all of the cut: at
/// its squares' middles, to what the tool's steps of half a square leave open. The longer side has
/// `longest_side` squares. Throws Error if the path cuts nothing or the side is not from 1 to 10,000. Throws
/// Cancelled through `progress`.
[[nodiscard]] HeightField
finished(const CutPath& path, const ToolTip& tip, int longest_side, const Progress& progress = Progress());

/// Tips by the number of the tool.
struct ToolTips {
    ToolTip usual = {};
    std::map<int, ToolTip> others = {};

    [[nodiscard]] const ToolTip& of(int tool) const;
};

/// The same of a path that several tools cut.
[[nodiscard]] HeightField finished_by(const CutPath& path,
                                      const ToolTips& tips,
                                      int longest_side,
                                      const Progress& progress = Progress());

/// Lit from the upper left, as a matt surface. Squares at or below `-thickness` are through the plate: white.
[[nodiscard]] GrayImage shaded(const HeightField& field, double thickness);

/// Against the light: what is left of a plate of this thickness halves the light each `half_depth`; levels of
/// sRGB. Throws Error unless both are above 0 and finite.
[[nodiscard]] GrayImage against_light(const HeightField& field, double thickness, double half_depth);

} // namespace millwright::plot
