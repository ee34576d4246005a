// The part of a path that lies inside a trimmed patch: tracks end and begin at the outline, and what is
// between is gone over lifted.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/trim.h"
#include "core/toolpath/toolpath.h"

namespace millwright::toolpath {

/// `contacts` as a strategy gives it, before the tool. Points are added where tracks cross the outline. A
/// link stays one (`MoveKind::cross`) only between two ends of tracks that are kept and where its straight
/// way in the parameters stays inside; else it goes `over`. Throws Error if nothing is left, and where the
/// surface has no normal at the outline.
[[nodiscard]] Toolpath
trimmed(const geometry::BezierPatch& patch, const geometry::Trim& trim, Toolpath contacts, bool flipped);

} // namespace millwright::toolpath
