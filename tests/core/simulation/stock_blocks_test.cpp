#include "core/simulation/internal/stock_blocks.h"

#include "core/simulation/stock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <vector>

namespace millwright::simulation {
namespace {

constexpr double rounding = 1e-3; // mm

std::vector<Box3> boxes_of(const StockBlocks& blocks) {
    std::vector<Box3> boxes;
    for (std::size_t n = 0; n < blocks.surface.points.size(); n += 8) {
        Box3 box;
        for (std::size_t corner = n; corner < n + 8; ++corner) {
            box.extend(blocks.surface.points[corner]);
        }
        boxes.push_back(box);
    }
    return boxes;
}

/// Both ends of every piece on any line.
std::vector<Vec3> ends_of(const DexelField& field) {
    std::vector<Vec3> ends;
    for (int k = 0; k < 3; ++k) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        for (int i = 0; i < field.count()[static_cast<std::size_t>(u)]; ++i) {
            for (int j = 0; j < field.count()[static_cast<std::size_t>(v)]; ++j) {
                Vec3 end;
                end[u] = field.middle(u, i);
                end[v] = field.middle(v, j);
                for (const Dexel& piece : field.line(k, i, j)) {
                    for (const float at : {piece.from, piece.to}) {
                        end[k] = field.box().min()[k] + static_cast<double>(at);
                        ends.push_back(end);
                    }
                }
            }
        }
    }
    return ends;
}

TEST(StockBlocks, HoldAllOfARoundStockAndLittleMore) {
    const CylinderStock cylinder{.base = {0.0, 0.0, -9.3}, .diameter = 16.0, .length = 9.3};
    const DexelField field(cylinder, 0.5, 100'000'000, Progress());
    const std::vector<Vec3> ends = ends_of(field);
    for (const int stride : {1, 2, 3, 5}) {
        const StockBlocks blocks = blocks_of(field, 400'000, stride, Progress());
        ASSERT_EQ(blocks.stride, stride);
        const std::vector<Box3> boxes = boxes_of(blocks);
        for (const Vec3& end : ends) {
            EXPECT_TRUE(std::ranges::any_of(
                boxes, [&](const Box3& box) { return box.exteriorDistance(end) < rounding; }))
                << stride << ": " << end.transpose();
        }
        const double edge = stride * field.cell().maxCoeff();
        for (const Vec3& corner : blocks.surface.points) {
            EXPECT_LT(corner.head<2>().norm(), 8.0 + std::numbers::sqrt2 * edge + rounding);
            EXPECT_GT(corner.z(), -9.3 - rounding);
            EXPECT_LT(corner.z(), rounding);
        }
    }
}

TEST(StockBlocks, OfABoxAreItsFacesWhateverTheirNumber) {
    const Box3 box(Vec3(1.0, 2.0, 3.0), Vec3(21.3, 14.7, 9.1));
    const DexelField field(BoxStock{box.min(), box.max()}, 0.5, 100'000'000, Progress());
    const StockBlocks fine = blocks_of(field, 400'000, 1, Progress());
    const StockBlocks coarse = blocks_of(field, 12 * 2, 1, Progress());
    EXPECT_LE(coarse.surface.triangles.size(), std::size_t{12 * 2});
    for (const StockBlocks& blocks : {fine, coarse}) {
        Box3 around;
        for (const Vec3& point : blocks.surface.points) {
            around.extend(point);
        }
        EXPECT_NEAR((around.min() - box.min()).norm(), 0.0, 2.0 * rounding);
        EXPECT_NEAR((around.max() - box.max()).norm(), 0.0, 2.0 * rounding);
    }
}

} // namespace
} // namespace millwright::simulation
