#include "core/exchange/point_rows.h"

#include "core/base/counted.h"
#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <tuple>
#include <utility>

namespace millwright::exchange {

namespace {

[[noreturn]] void
fail_in_rows(const std::filesystem::path& file, int line, std::string message, std::string hint = {}) {
    throw Error(Diagnostic{
        .place = {.file = file, .line = line}, .message = std::move(message), .hint = std::move(hint)});
}

/// For each point the first one in the same place: itself, unless that is an earlier one.
std::vector<std::size_t> first_ones(const std::vector<Vec3>& points) {
    const auto key = [&](std::size_t n) {
        const Vec3& p = points[n];
        return std::tuple(p.x() + 0.0, p.y() + 0.0, p.z() + 0.0, n);
    };
    std::vector<std::size_t> order(points.size()), first(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, key);
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool same = k > 0 && (points[order[k]].array() == points[order[k - 1]].array()).all();
        first[order[k]] = same ? first[order[k - 1]] : order[k];
    }
    return first;
}

constexpr double same_way = 0.5; // cosine: within 60 degrees

double cosine_between(const Vec3& a, const Vec3& b) {
    const double lengths = a.norm() * b.norm();
    return lengths > 0.0 ? a.dot(b) / lengths : 0.0;
}

/// Whether every step of the row goes along it.
bool is_row(std::span<const Vec3> row) {
    const Vec3 whole = row.back() - row.front();
    for (std::size_t n = 1; n < row.size(); ++n) {
        if (!(cosine_between(row[n] - row[n - 1], whole) > same_way)) {
            return false;
        }
    }
    return true;
}

/// Whether rows of `length` points lie beside each other, all measured in one direction or to and fro.
bool are_rows(const std::vector<Vec3>& points, std::size_t length) {
    const auto row = [&](std::size_t n) { return std::span(points).subspan(n * length, length); };
    const std::size_t count = points.size() / length;
    int forth = 0, back = 0;
    for (std::size_t n = 0; n < count; ++n) {
        if (!is_row(row(n))) {
            return false;
        }
        if (n > 0) {
            const Vec3 before = row(n - 1).back() - row(n - 1).front();
            if (cosine_between(row(n).front() - row(n - 1).back(), before) > same_way) {
                return false; // the row goes on
            }
            const double cosine = cosine_between(row(n).back() - row(n).front(), before);
            forth += cosine > same_way ? 1 : 0;
            back += cosine < -same_way ? 1 : 0;
        }
    }
    const int neighbours = static_cast<int>(count) - 1;
    return forth == neighbours || back == neighbours;
}

/// Of rows that no blank line ends: the longest that fit; 0 if none do.
std::size_t row_length(const std::vector<Vec3>& points) {
    constexpr std::size_t shortest_row = 3; // two points are always in a row
    for (std::size_t rows = 2; shortest_row * rows <= points.size(); ++rows) {
        if (points.size() % rows == 0 && are_rows(points, points.size() / rows)) {
            return points.size() / rows;
        }
    }
    return 0;
}

/// A row against the direction of the first one is turned round.
void turn_rows(PointGrid& grid) {
    const auto length = static_cast<std::ptrdiff_t>(grid.columns);
    const Vec3 along = grid.at(0, grid.columns - 1) - grid.at(0, 0);
    for (int row = 1; row < grid.rows; ++row) {
        if ((grid.at(row, grid.columns - 1) - grid.at(row, 0)).dot(along) < 0.0) {
            std::reverse(grid.points.begin() + row * length, grid.points.begin() + (row + 1) * length);
            std::reverse(grid.lines.begin() + row * length, grid.lines.begin() + (row + 1) * length);
        }
    }
}

/// The points of every block between blank lines.
std::size_t block_length(const MeasuredPoints& measured, const std::filesystem::path& file) {
    const auto end = [&](std::size_t n) {
        return n + 1 < measured.begins.size() ? measured.begins[n + 1] : measured.points.size();
    };
    const std::size_t length = end(0);
    for (std::size_t n = 0; n < measured.begins.size(); ++n) {
        const std::size_t here = end(n) - measured.begins[n];
        if (here != length) {
            fail_in_rows(
                file,
                measured.lines[measured.begins[n]],
                fmt::format("row {} has {}, but the first row has {}", n + 1, counted(here, "point"), length),
                "give all rows the same number of points, or fit the points as a cloud, without rows");
        }
    }
    return length;
}

} // namespace

std::optional<PointGrid> rows_of(const MeasuredPoints& measured, const std::filesystem::path& file) {
    const bool blocks = measured.begins.size() > 1;
    const std::size_t length = blocks ? block_length(measured, file) : row_length(measured.points);
    if (length == 0) {
        return std::nullopt;
    }
    if (length < 2) {
        fail_in_rows(file, measured.lines.front(), "a row has only one point, but needs two or more");
    }
    const std::vector<std::size_t> first = first_ones(measured.points);
    for (std::size_t n = 0; n < first.size(); ++n) {
        if (first[n] != n) {
            fail_in_rows(file,
                         measured.lines[n],
                         fmt::format("the point of line {} is repeated here", measured.lines[first[n]]),
                         "give each point of the rows a different position");
        }
    }
    PointGrid grid{static_cast<int>(measured.points.size() / length),
                   static_cast<int>(length),
                   measured.points,
                   measured.lines};
    turn_rows(grid);
    return grid;
}

std::optional<MeasuredPoints> raster_points(const TriangleMesh& mesh) {
    MeasuredPoints measured{
        .points = mesh.points, .lines = std::vector<int>(mesh.points.size()), .begins = {0}};
    std::iota(measured.lines.begin(), measured.lines.end(), 1);
    const auto grid = rows_of(measured, {});
    if (!grid) {
        return std::nullopt;
    }
    std::vector<int> place(mesh.points.size()); // in the grid, of each point
    for (std::size_t n = 0; n < grid->lines.size(); ++n) {
        place[static_cast<std::size_t>(grid->lines[n] - 1)] = static_cast<int>(n);
    }
    constexpr int triangles_per_cell = 2;
    std::map<std::pair<int, int>, int> triangles_in; // by the cell's row and column
    for (const std::array<int, 3>& triangle : mesh.triangles) {
        std::array<int, 3> rows{}, columns{};
        for (std::size_t k = 0; k < triangle.size(); ++k) {
            const int at = place[static_cast<std::size_t>(triangle[k])];
            rows[k] = at / grid->columns;
            columns[k] = at % grid->columns;
        }
        const auto [top, bottom] = std::ranges::minmax(rows);
        const auto [left, right] = std::ranges::minmax(columns);
        if (bottom - top != 1 || right - left != 1 || ++triangles_in[{top, left}] > triangles_per_cell) {
            return std::nullopt;
        }
    }
    const auto cells = static_cast<std::size_t>((grid->rows - 1) * (grid->columns - 1));
    return mesh.triangles.size() == triangles_per_cell * cells ? std::optional(measured) : std::nullopt;
}

PointCloud cloud_of(const MeasuredPoints& measured) {
    const std::vector<std::size_t> first = first_ones(measured.points);
    PointCloud cloud;
    for (std::size_t n = 0; n < first.size(); ++n) {
        if (first[n] == n) {
            cloud.points.push_back(measured.points[n]);
            cloud.lines.push_back(measured.lines[n]);
        } else {
            cloud.repeated.push_back(measured.lines[n]);
        }
    }
    return cloud;
}

} // namespace millwright::exchange
