#include "core/grid/quality_guard.h"

#include "tests/core/grid/short_names.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::grid {
namespace {

using test::along_v;

/// Each individual move wants to be 0.5 long; what the path is worth is given.
class PathModel final : public ErrorModel {
public:
    [[nodiscard]] MoveError move(const Vec2& a, const Vec2& b, Sampling) const override {
        return {std::abs((b - a).norm() - 0.5), 0.0, 1.0};
    }
    [[nodiscard]] std::unique_ptr<LatticeErrors> lattice(std::span<const Vec2>, Sampling) const override {
        return nullptr;
    }
    [[nodiscard]] double track_gap(const Grid&, TrackDirection) const override { return 0.0; }
    [[nodiscard]] ErrorSummary on_path(const Grid& grid, TrackDirection, const Progress&) const override {
        return grid == Grid::uniform(3, 3) ? of_start : of_others;
    }

    ErrorSummary of_start{.max = 2.0, .mean = 1.0, .axis_max = 0.5};
    ErrorSummary of_others{.max = 1.5, .mean = 0.5, .axis_max = 0.25};
};

Grid bent() {
    NodeArray nodes = Grid::uniform(3, 3).array();
    nodes.at(1, 1) = {0.5, 0.4};
    return Grid(nodes);
}

TEST(QualityGuard, IsNotKeptByTheStartItself) {
    const PathModel model;
    const QualityGuard guard(model, Grid::uniform(3, 3), along_v, {});
    EXPECT_FALSE(guard.kept_by(Grid::uniform(3, 3), {}).has_value());
}

TEST(QualityGuard, IsBrokenByAnyFigureOfThePath) {
    const Grid start = bent();
    for (double ErrorSummary::*figure : {&ErrorSummary::mean, &ErrorSummary::max, &ErrorSummary::axis_max}) {
        PathModel model;
        model.of_start = model.of_others;
        EXPECT_TRUE(QualityGuard(model, start, along_v, {}).kept_by(Grid::uniform(3, 3), {}).has_value());
        model.of_start.*figure *= 1.01;
        EXPECT_FALSE(QualityGuard(model, start, along_v, {}).kept_by(Grid::uniform(3, 3), {}).has_value());
    }
}

} // namespace
} // namespace millwright::grid
