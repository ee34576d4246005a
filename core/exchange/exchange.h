// Designs and bodies that come from other programs and go to them: triangles (STL, OBJ, PLY) and exact
// surfaces (STEP, IGES).
//
//   const TriangleMesh mesh = read_mesh("scan.stl", 1.0, progress);    the reference
//   const MeshFit fit = fit_patch(mesh, settings, progress);           a patch near it, and how near
//   const CadModel model = read_cad("part.step", progress);            faces as Bezier patches
//   const MeshFit near = fit_face(model.faces[0], settings, progress); one patch near a face
//   const auto rows = rows_of(read_measured_points("probe.csv", progress), "probe.csv");  measured in rows
//   const GridSurface through = surface_through(*rows, {}, progress);  exactly through them
//   const MeshFit cloud = fit_cloud(points, settings, progress);       a fair patch near scattered points
//   write_surface(surface, "part.step", tolerance, progress);          the way back
#pragma once

#include "core/exchange/cad_file.h"
#include "core/exchange/cloud_fit.h"
#include "core/exchange/grid_surface.h"
#include "core/exchange/mesh_file.h"
#include "core/exchange/patch_fit.h"
#include "core/exchange/point_file.h"
#include "core/exchange/point_rows.h"
#include "core/exchange/surface_file.h"
