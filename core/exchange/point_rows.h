// Measured points in rows: as many in each, the rows one beside the other.
#pragma once

#include "core/exchange/point_file.h"
#include "core/exchange/triangle_mesh.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace millwright::exchange {

/// Points of a raster, row by row; u goes from row to row, v along a row.
struct PointGrid {
    int rows = 0;
    int columns = 0;
    std::vector<Vec3> points; ///< in the unit of the file
    std::vector<int> lines;   ///< of the file, one per point

    [[nodiscard]] const Vec3& at(int row, int column) const {
        return points[static_cast<std::size_t>(row * columns + column)];
    }
};

/// Blank lines of the file end a row. Without them a row of three points or more ends where the points turn
/// back to begin the next one, or, measured to and fro, to go along it. Rows that were measured backwards are
/// turned round. Nothing if there are no rows: then the points are a cloud. Throws Error with file and line
/// for rows between blank lines that differ in length, fewer than two points in them, and a point that is
/// there twice.
[[nodiscard]] std::optional<PointGrid> rows_of(const MeasuredPoints& measured,
                                               const std::filesystem::path& file);

/// The points of a mesh that joins points in rows: each cell between two rows is two triangles, and the order
/// of the points is that of the rows; `lines` are the numbers of the points, from 1. Nothing for others.
[[nodiscard]] std::optional<MeasuredPoints> raster_points(const TriangleMesh& mesh);

/// The points without those that repeat an earlier one, as a cloud may have them; `repeated`: the lines of
/// the others.
struct PointCloud {
    std::vector<Vec3> points;
    std::vector<int> lines;
    std::vector<int> repeated;
};
[[nodiscard]] PointCloud cloud_of(const MeasuredPoints& measured);

} // namespace millwright::exchange
