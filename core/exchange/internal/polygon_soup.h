// What the readers of meshes make: faces as they stand in the file, before points in one place are joined.
#pragma once

#include "core/base/error.h"
#include "core/exchange/triangle_mesh.h"

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace millwright::exchange {

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

} // namespace millwright::exchange
