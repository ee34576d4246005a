// The outlines of a trimmed patch over a net of nodes: from the parameters of the patch to those of the net.
#pragma once

#include "core/geometry/trim.h"
#include "core/grid/node_array.h"

namespace millwright::viewport {

/// The place in the parameters of the patch that a net has at `at` in its own, 0 to 1 from the first to the
/// last row and column: blended between the four nodes of a cell.
[[nodiscard]] Vec2 place_on_net(const grid::NodeArray& nodes, const Vec2& at);

/// `trim` in the net's own parameters. Straight edges of outlines are bent there: they get as many corners as
/// keep them to a fiftieth of a cell of a mesh that divides each cell of the net into `fine` x `fine`. Where
/// the net, whose cells are all positive, ends short of the patch, the outline goes along its border.
[[nodiscard]] geometry::Trim trim_on_net(const geometry::Trim& trim, const grid::NodeArray& nodes, int fine);

} // namespace millwright::viewport
