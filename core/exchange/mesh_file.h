// Meshes of triangles from STL, OBJ and PLY files. None of these says its unit.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/triangle_mesh.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::exchange {

inline constexpr int most_mesh_triangles = 5'000'000;

struct MeshFile {
    TriangleMesh mesh;
    int without_area = 0; ///< triangles of the file that are left out: two corners in one place, or in a line
    std::vector<std::string> notes; ///< what else of the file is not read, a sentence each
};

/// Whether the name ends like that of a mesh that can be read, in any case.
[[nodiscard]] bool is_mesh_file(const std::filesystem::path& file);

/// Faces of more corners are cut into triangles, points in the same place are one; the order is that of the
/// file. Throws Error, naming the
/// file, for another kind of file, damaged or empty ones, numbers that are not finite, and more than
/// `most_mesh_triangles`; Cancelled.
[[nodiscard]] MeshFile
read_mesh(const std::filesystem::path& file, double mm_per_unit, const Progress& progress);

/// The same of bytes at hand; `file` is named in diagnostics and tells the kind.
[[nodiscard]] MeshFile parse_mesh(std::string_view bytes,
                                  const std::filesystem::path& file,
                                  double mm_per_unit,
                                  const Progress& progress);

} // namespace millwright::exchange
