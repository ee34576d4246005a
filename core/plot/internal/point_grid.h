// Points in square cells: what is near a place is found without looking at everything.
#pragma once

#include "core/geometry/vectors.h"

#include <cstdint>
#include <vector>

namespace millwright::plot::internal {

class PointGrid {
public:
    /// About two points per cell, also when most have been removed.
    explicit PointGrid(std::vector<Vec2> points);

    void remove(int point);
    [[nodiscard]] bool empty() const { return left_ == 0; }

    /// The nearest of the points that are left, of equal ones the first; -1 if none is.
    [[nodiscard]] int nearest(const Vec2& place) const;

    /// Up to `count` points that are left, nearest first.
    [[nodiscard]] std::vector<int> near(const Vec2& place, int count) const;

private:
    struct Found {
        double distance = 0.0;
        int point = -1;
    };
    void fill(const std::vector<int>& points);
    [[nodiscard]] int column(double x) const;
    [[nodiscard]] int row(double y) const;
    [[nodiscard]] std::vector<int>& cell(int column, int row);
    [[nodiscard]] const std::vector<int>& cell(int column, int row) const;
    void add_cell(int column, int row, const Vec2& place, std::vector<Found>& found) const;
    void
    add_ring(int centre_column, int centre_row, int ring, const Vec2& place, std::vector<Found>& found) const;

    std::vector<Vec2> points_;
    Vec2 lower_ = Vec2::Zero();
    double size_ = 1.0;
    int columns_ = 1;
    int rows_ = 1;
    std::int64_t left_ = 0;
    std::int64_t filled_ = 0; ///< points that the cells were made for
    std::vector<std::vector<int>> cells_;
};

} // namespace millwright::plot::internal
