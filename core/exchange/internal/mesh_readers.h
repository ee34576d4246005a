// Readers of the three kinds of mesh file. Each fills the soup, or fails about a line of its file. Ours,
// because the readers of assimp 5.2 do not come to an end on damaged headers and leak at faults.
#pragma once

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/exchange/triangle_mesh.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::exchange {

// What the readers of meshes make: faces as they stand in the file, before points in one place are joined.

/// Collects points and faces. Throws Error about `file` and the line for what no mesh may have.
class PolygonSoup {
public:
    PolygonSoup(std::filesystem::path file, double mm_per_unit)
        : file_(std::move(file)), unit_(mm_per_unit) {}

    [[nodiscard]] std::ptrdiff_t point_count() const { return std::ssize(mesh_.points); }
    void add_point(const Vec3& point, int line = 0);
    /// A face of three or more corners, cut into triangles by its ears where it has more.
    void add_face(std::span<const int> corners, int line = 0);

    /// What of the file is not read, a sentence.
    void note(std::string sentence) { notes_.push_back(std::move(sentence)); }
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

    [[nodiscard]] TriangleMesh take() && { return std::move(mesh_); }
    [[noreturn]] void fail(std::string message, int line = 0, std::string hint = {}) const;

private:
    std::filesystem::path file_;
    double unit_;
    TriangleMesh mesh_;
    std::vector<std::string> notes_;
};

/// Binary or text.
void read_stl(std::string_view bytes,
              const std::filesystem::path& file,
              PolygonSoup& soup,
              const Progress& progress);
/// Wavefront: v and f; all else is read over.
void read_obj(std::string_view bytes, PolygonSoup& soup, const Progress& progress);
/// Text or binary of either byte order: x, y, z of `vertex`, vertex_indices of `face` and `tristrips`; all
/// else is read over.
void read_ply(std::string_view bytes, PolygonSoup& soup, const Progress& progress);

} // namespace millwright::exchange
