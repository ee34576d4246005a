#include "core/grid/node_array.h"

#include "core/base/error.h"
#include "tests/core/grid/short_names.h"
#include "tests/support/grid_arrays.h"

#include <gtest/gtest.h>

#include <limits>

namespace millwright::grid {
namespace {

using test::infinity;

TEST(NodeArray, IsRowMajor) {
    NodeArray array(2, 3);
    array.at(1, 2) = Vec2(7.0, 8.0);
    EXPECT_EQ(array.nodes.size(), 6U);
    EXPECT_EQ(array.nodes[5], Vec2(7.0, 8.0));
}

TEST(MinCellArea, OfAShearedArrayIsBaseTimesHeight) {
    NodeArray array = unit_spaced(4, 5);
    for (Vec2& p : array.nodes) {
        p = Vec2(2.0 * p.x() + 0.7 * p.y(), 3.0 * p.y());
    }
    EXPECT_NEAR(min_cell_area(array), 6.0, 1e-12);
    EXPECT_NEAR(min_corner_jacobian(array), 1.0, 1e-12);
}

TEST(MinCornerJacobian, DoesNotChangeWhenTheArrayIsMovedAndScaled) {
    NodeArray array = unit_spaced(5, 5);
    array.at(2, 2) += Vec2(0.3, -0.2);
    const double before = min_corner_jacobian(array);
    EXPECT_NEAR(before, 0.5, 1e-12); // (-0.3, -0.8) x (0.7, 0.2)
    for (Vec2& p : array.nodes) {
        p = 0.01 * p + Vec2(100.0, -50.0);
    }
    EXPECT_NEAR(min_corner_jacobian(array), before, 1e-9);
}

TEST(MinCornerJacobian, IsNotPositiveWhereACellFoldsThoughItsAreaIsPositive) {
    NodeArray array = unit_spaced(3, 3);
    array.at(1, 1) = Vec2(0.45, 0.45); // inside the first cell, past its diagonal
    EXPECT_GT(min_cell_area(array), 0.4);
    EXPECT_LE(min_corner_jacobian(array), 0.0);
}

TEST(MinCornerJacobian, OfAMirroredArrayIsNegative) {
    NodeArray array = unit_spaced(3, 3);
    for (Vec2& p : array.nodes) {
        p.x() = -p.x();
    }
    EXPECT_LT(min_corner_jacobian(array), 0.0);
    EXPECT_LT(min_cell_area(array), 0.0);
}

TEST(MinCornerJacobian, OfANotFiniteArrayIsMinusInfinity) {
    NodeArray array = unit_spaced(3, 3);
    array.at(1, 1).y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(all_finite(array));
    EXPECT_EQ(min_corner_jacobian(array), -infinity);
    EXPECT_EQ(min_cell_area(array), -infinity);
}

TEST(MinCellArea, NeedsACell) {
    EXPECT_THROW((void)min_cell_area(NodeArray(1, 5)), Defect);
}

} // namespace
} // namespace millwright::grid
