// Bodies as binary glTF 2.0 files (.glb), which Blender and most viewers read. In a file lengths are metres
// and y points up; here they are mm, in the coordinates of each body.
#pragma once

#include "core/geometry/solid.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::geometry {

/// A body and its position at rest, in a frame whose z points up. Only other programs look at that.
struct PlacedBody {
    SolidBody body;
    Frame at_rest = Frame::Identity();
};

/// One node a body, of its name. The same bytes for the same bodies.
[[nodiscard]] std::string glb_of(const std::vector<PlacedBody>& bodies, const std::string& name);

/// Every node that has triangles and a name, in its own coordinates; where a node stands is not looked at.
/// Throws Error, naming `file`, for what is no glb, lies partly in other files, has compressed or sparse
/// triangles, indices or numbers that are out of range, a name twice, or more than five million points.
[[nodiscard]] std::vector<SolidBody> parse_glb(std::string_view bytes, const std::filesystem::path& file);

} // namespace millwright::geometry
