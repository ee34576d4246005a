#include "core/plot/picture/finished_look.h"

#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace millwright::plot {
namespace {

CutPath path_of(const std::vector<Vec3>& points) {
    CutPath path;
    for (const Vec3& at : points) {
        path.push_back({.at = at, .speed = 1.0, .move = CutMove::cut});
    }
    return path;
}

/// Two rows of a ball of 1 mm radius, 0.8 mm apart, 1 mm deep.
CutPath two_rows() {
    return path_of({{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}, {8.0, 0.0, -1.0}, {8.0, 0.8, -1.0}, {0.0, 0.8, -1.0}});
}

const ToolTip ball_tip{TipKind::ball, 2.0};

TEST(FinishedLook, LeavesRidgesBetweenRows) {
    const HeightField field = finished(two_rows(), ball_tip, 500);
    // 8 + 2 mm along, so squares of 0.02 mm; the mouth begins at -1.
    EXPECT_NEAR(field.pitch, 0.02, 1e-12);
    const auto z = [&](double x, double y) {
        const int column = static_cast<int>(std::floor((x + 1.0) / field.pitch));
        const int row = field.rows - 1 - static_cast<int>(std::floor((y + 1.0) / field.pitch));
        return static_cast<double>(field.row(row)[static_cast<std::size_t>(column)]);
    };
    EXPECT_NEAR(z(4.0, 0.0), -1.0, 1e-3);
    EXPECT_NEAR(z(4.0, 0.8), -1.0, 1e-3);
    EXPECT_NEAR(z(4.0, 0.4), -std::sqrt(1.0 - square(0.4)), 0.02 * 0.5); // its slope times half a square
    EXPECT_NEAR(z(4.0, -0.8), -std::sqrt(1.0 - square(0.8)), 0.02 * 1.4);
    EXPECT_DOUBLE_EQ(z(-0.98, -0.98), 0.0);
}

TEST(FinishedLook, IsTheSameOnAnyNumberOfThreads) {
    set_thread_count(1);
    const HeightField one = finished(two_rows(), ball_tip, 300);
    set_thread_count(7);
    EXPECT_EQ(finished(two_rows(), ball_tip, 300).z, one.z);
    set_thread_count(0);
}

TEST(FinishedLook, EachToolCutsAsWideAsItIs) {
    CutPath path = two_rows();
    path[3].tool = path[4].tool = 2; // the second row
    for (CutPoint& point : path) {
        point.at.y() *= 10.0; // rows 8 mm apart
    }
    const HeightField field = finished_by(path, {{TipKind::flat, 2.0}, {{2, {TipKind::flat, 6.0}}}}, 500);
    const auto width_at = [&](double y) { // of what is cut 1 mm deep, across x = 4
        int cut = 0;
        for (int row = 0; row < field.rows; ++row) {
            const double at = field.corner.y() + field.y_of_row(row);
            const auto column = static_cast<std::size_t>((4.0 - field.corner.x()) / field.pitch);
            cut += std::abs(at - y) < 3.9 && field.row(row)[column] < -0.99F ? 1 : 0;
        }
        return cut * field.pitch;
    };
    EXPECT_NEAR(width_at(0.0), 2.0, 3.0 * field.pitch);
    EXPECT_NEAR(width_at(8.0), 6.0, 3.0 * field.pitch);
}

TEST(FinishedLook, OfAThinPointIsNotEmpty) {
    const HeightField field = finished(two_rows(), {TipKind::point}, 100);
    EXPECT_GT(std::ranges::count(field.z, -1.0F), 150);
}

TEST(FinishedLook, RefusesPathsThatCutNothing) {
    EXPECT_THROW(static_cast<void>(finished(path_of({{0.0, 0.0, 5.0}, {1.0, 0.0, 5.0}}), ball_tip, 100)),
                 Error);
    EXPECT_THROW(static_cast<void>(finished({}, ball_tip, 100)), Error);
    EXPECT_THROW(static_cast<void>(finished(two_rows(), ball_tip, 0)), Error);
}

/// Slopes that rise to the left, level, rise to the right.
HeightField roof() {
    HeightField field{30, 10, 1.0, {}};
    for (int n = 0; n < 300; ++n) {
        const int x = n % 30;
        field.z.push_back(static_cast<float>(x < 10 ? -x : x < 20 ? -10 : x - 30));
    }
    return field;
}

TEST(FinishedLook, IsBrightestWhereItFacesTheLight) {
    const GrayImage image = shaded(roof(), 100.0);
    const auto at = [&](int x) { return int{image.pixels[static_cast<std::size_t>(5 * 30 + x)]}; };
    // The light comes from the left: what rises to the right faces it.
    EXPECT_GT(at(25), at(15));
    EXPECT_GT(at(15), at(5));
    EXPECT_EQ(at(14), at(15));
}

TEST(FinishedLook, ShowsWhatIsThrough) {
    const GrayImage image = shaded(roof(), 10.0);
    EXPECT_EQ(image.pixels[15], 255);
    EXPECT_LT(image.pixels[2], 255);
}

TEST(FinishedLook, HalvesTheLight) {
    const millwright::test::WithoutTraps no_traps;
    HeightField field{4, 1, 1.0, {0.0F, -1.0F, -1.5F, -3.0F}};
    const GrayImage image = against_light(field, 2.0, 0.5);
    EXPECT_EQ(image.pixels, (std::vector<std::uint8_t>{71, 137, 188, 255})); // sRGB of 1/16, 1/4, 1/2, 1
    EXPECT_THROW(static_cast<void>(against_light(field, 0.0, 0.5)), Error);
    EXPECT_THROW(static_cast<void>(against_light(field, 1.0, std::nan(""))), Error);
}

} // namespace
} // namespace millwright::plot
