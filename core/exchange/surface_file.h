// A design for other programs: exact as STEP, as triangles in STL, OBJ, PLY and glb.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/mesh.h"
#include "core/geometry/surface.h"

#include <filesystem>

namespace millwright::exchange {

/// Equal steps of the parameters at which no triangle is further than `tolerance` (mm, above 0) from the
/// patch, by its second derivatives; at most 1,000 each way.
struct Steps {
    int u = 1;
    int v = 1;
};
[[nodiscard]] Steps steps_within(const geometry::BezierPatch& patch, double tolerance);

/// Whether the name ends like that of a file that can be written, in any case.
[[nodiscard]] bool is_surface_file(const std::filesystem::path& file);

/// The kind by the end of the name: .step, .stp, .glb, .stl (binary), .obj, .ply (binary). `tolerance` is of
/// the triangles, mm; STEP is exact. Replaces `file` as a whole or leaves it. Throws Error, naming the file;
/// Cancelled.
void write_surface(const geometry::Surface& surface,
                   const std::filesystem::path& file,
                   double tolerance,
                   const Progress& progress);

} // namespace millwright::exchange
