#include "core/toolpath/spiral.h"

#include "core/base/error.h"
#include "core/toolpath/trimmed_path.h"

#include <utility>

namespace millwright::toolpath {

namespace {

/// Of `rows` x `columns`, the first side along the columns.
std::vector<std::array<int, 2>> rounds(int rows, int columns) {
    std::vector<std::array<int, 2>> order;
    int top = 0;
    int bottom = rows - 1;
    int left = 0;
    int right = columns - 1;
    while (top <= bottom && left <= right) {
        for (int c = left; c <= right; ++c) {
            order.push_back({top, c});
        }
        for (int r = top + 1; r <= bottom; ++r) {
            order.push_back({r, right});
        }
        for (int c = right - 1; top < bottom && c >= left; --c) {
            order.push_back({bottom, c});
        }
        for (int r = bottom - 1; left < right && r > top; --r) {
            order.push_back({r, left});
        }
        ++top;
        --bottom;
        ++left;
        --right;
    }
    return order;
}

} // namespace

std::vector<std::array<int, 2>> spiral_order(int nu, int nv, grid::TrackDirection direction) {
    expects(nu >= 1 && nv >= 1, "a grid has nodes");
    const bool along_v = direction == grid::TrackDirection::along_v;
    std::vector<std::array<int, 2>> order = along_v ? rounds(nu, nv) : rounds(nv, nu);
    if (!along_v) {
        for (auto& [first, second] : order) {
            std::swap(first, second);
        }
    }
    return order;
}

Toolpath Spiral::contacts(const Covering& of, const Progress& progress) const {
    Toolpath path;
    path.direction = of.direction;
    for (const auto& [i, j] : spiral_order(of.grid.nu(), of.grid.nv(), of.direction)) {
        PathPoint point = point_to_trim(of.patch, of.outline, of.grid.node(i, j), of.flipped);
        point.origin.i = i;
        point.origin.j = j;
        point.reached_by = path.points.empty() ? MoveKind::start : MoveKind::track;
        path.points.push_back(point);
    }
    progress.report(1.0);
    return path;
}

} // namespace millwright::toolpath
