#include "core/plot/internal/point_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace millwright::plot::internal {

PointGrid::PointGrid(std::vector<Vec2> points) : points_(std::move(points)) {
    std::vector<int> all(points_.size());
    std::iota(all.begin(), all.end(), 0);
    fill(all);
}

void PointGrid::fill(const std::vector<int>& points) {
    const auto place = [&](int n) -> const Vec2& { return points_[static_cast<std::size_t>(n)]; };
    Vec2 upper = points.empty() ? Vec2(0.0, 0.0) : place(points.front());
    lower_ = upper;
    for (const int n : points) {
        lower_ = lower_.cwiseMin(place(n));
        upper = upper.cwiseMax(place(n));
    }
    const Vec2 span = (upper - lower_).cwiseMax(Vec2(1e-9, 1e-9));
    const double count = std::max<double>(1.0, static_cast<double>(points.size()) / 2.0);
    // A thin box has no more cells along than there are points.
    size_ = std::max(std::sqrt(span.x() * span.y() / count), span.maxCoeff() / count);
    columns_ = static_cast<int>(span.x() / size_) + 1;
    rows_ = static_cast<int>(span.y() / size_) + 1;
    cells_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), {});
    for (const int n : points) {
        cell(column(place(n).x()), row(place(n).y())).push_back(n);
    }
    left_ = std::ssize(points);
    filled_ = left_;
}

int PointGrid::column(double x) const {
    return static_cast<int>(std::clamp((x - lower_.x()) / size_, 0.0, columns_ - 1.0));
}

int PointGrid::row(double y) const {
    return static_cast<int>(std::clamp((y - lower_.y()) / size_, 0.0, rows_ - 1.0));
}

std::vector<int>& PointGrid::cell(int column, int row) {
    return cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
}

const std::vector<int>& PointGrid::cell(int column, int row) const {
    return cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
}

void PointGrid::remove(int point) {
    const Vec2& p = points_[static_cast<std::size_t>(point)];
    left_ -= static_cast<std::int64_t>(std::erase(cell(column(p.x()), row(p.y())), point));
    constexpr std::int64_t sparse = 8;
    if (left_ * sparse < filled_ && left_ > 0) {
        std::vector<int> rest;
        for (const std::vector<int>& points : cells_) {
            rest.insert(rest.end(), points.begin(), points.end());
        }
        std::ranges::sort(rest);
        fill(rest);
    }
}

void PointGrid::add_cell(int column, int row, const Vec2& place, std::vector<Found>& found) const {
    if (column < 0 || column >= columns_ || row < 0 || row >= rows_) {
        return;
    }
    for (const int n : cell(column, row)) {
        found.push_back({(points_[static_cast<std::size_t>(n)] - place).norm(), n});
    }
}

void PointGrid::add_ring(
    int centre_column, int centre_row, int ring, const Vec2& place, std::vector<Found>& found) const {
    if (ring == 0) {
        add_cell(centre_column, centre_row, place, found);
        return;
    }
    const int first = std::max(-ring, -centre_column);
    const int last = std::min(ring, columns_ - 1 - centre_column);
    for (int dx = first; dx <= last; ++dx) {
        add_cell(centre_column + dx, centre_row - ring, place, found);
        add_cell(centre_column + dx, centre_row + ring, place, found);
    }
    const int lowest = std::max(-ring + 1, -centre_row);
    const int highest = std::min(ring - 1, rows_ - 1 - centre_row);
    for (int dy = lowest; dy <= highest; ++dy) {
        add_cell(centre_column - ring, centre_row + dy, place, found);
        add_cell(centre_column + ring, centre_row + dy, place, found);
    }
}

std::vector<int> PointGrid::near(const Vec2& place, int count) const {
    std::vector<Found> found;
    const int centre_column = column(place.x());
    const int centre_row = row(place.y());
    const auto wanted = static_cast<std::size_t>(std::min<std::int64_t>(count, left_));
    const auto before = [](const Found& a, const Found& b) {
        return a.distance < b.distance || (!(b.distance < a.distance) && a.point < b.point);
    };
    // Whatever is beyond ring r is at least r cells away (the place itself may be outside of the box).
    for (int ring = 0; ring <= std::max(columns_, rows_); ++ring) {
        add_ring(centre_column, centre_row, ring, place, found);
        if (found.size() >= wanted) {
            std::ranges::nth_element(
                found, found.begin() + static_cast<std::ptrdiff_t>(wanted) - (wanted > 0 ? 1 : 0), before);
            if (wanted == 0 || found[wanted - 1].distance <= ring * size_) {
                break;
            }
        }
    }
    std::ranges::sort(found, before);
    std::vector<int> points;
    for (std::size_t n = 0; n < wanted; ++n) {
        points.push_back(found[n].point);
    }
    return points;
}

int PointGrid::nearest(const Vec2& place) const {
    const std::vector<int> points = near(place, 1);
    return points.empty() ? -1 : points.front();
}

} // namespace millwright::plot::internal
