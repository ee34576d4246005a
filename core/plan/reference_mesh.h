// What of another program's file is shown beside the design: the triangles or measured points that a patch
// was fitted to, with their distances from it, and all else that the file has.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/triangle_mesh.h"
#include "core/project/imported_surface.h"

#include <vector>

namespace millwright::plan {

struct ReferenceMesh {
    exchange::TriangleMesh fitted; ///< measured points: without triangles; so is `rest` then
    std::vector<double> deviation; ///< one per point of `fitted`, mm; above zero on the side of the normal
    double largest = 0.0;          ///< as it is reported, without sign
    exchange::TriangleMesh rest;   ///< other faces of the file, other sides of the mesh
    std::vector<int> faces; ///< number of the face that each triangle of `rest` is of; empty for a mesh
};

/// Of the faces of a body that is not chosen only what lies inside their outlines. `imported` is what was
/// made by `choice`, or null before there was one. Throws Cancelled.
[[nodiscard]] ReferenceMesh reference_mesh(const project::ImportSource& source,
                                           const project::ImportChoice& choice,
                                           const project::ImportedSurface* imported,
                                           const Progress& progress);

} // namespace millwright::plan
