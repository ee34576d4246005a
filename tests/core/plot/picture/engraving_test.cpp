#include "core/plot/picture/engraving.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace millwright::plot {
namespace {

using testing::HasSubstr;

/// From white on the left to black on the right.
Picture wedge(int width, int height) {
    Picture picture{width, height, {}, {}};
    for (int n = 0; n < width * height; ++n) {
        picture.gray.push_back(static_cast<std::uint16_t>(white - white * (n % width) / (width - 1)));
    }
    return picture;
}

Picture even(int width, int height, double darkness) {
    const auto gray = static_cast<std::uint16_t>(std::lround(white * (1.0 - darkness)));
    return {width, height, std::vector<std::uint16_t>(static_cast<std::size_t>(width * height), gray), {}};
}

std::ptrdiff_t points_of(const Strokes& strokes) {
    std::ptrdiff_t count = 0;
    for (const Stroke& stroke : strokes) {
        count += std::ssize(stroke.points);
    }
    return count;
}

TEST(Dithering, HasAsManyDotsAsTheDarknessAsksFor) {
    for (const double darkness : {0.0, 0.1, 0.25, 0.5, 0.8, 1.0}) {
        const Strokes dots = dithered(even(80, 60, darkness), 0.5, {.pitch = 0.5});
        // What is lost is the error that leaves the picture at its edges.
        EXPECT_NEAR(static_cast<double>(points_of(dots)), darkness * 80 * 60, 30.0) << darkness;
    }
}

TEST(Dithering, KeepsTheMeanOfEachPartOfThePicture) {
    const Strokes dots = dithered(wedge(160, 160), 0.1, {.pitch = 0.1});
    for (int part = 0; part < 10; ++part) {
        const auto inside = [&](const Stroke& dot) {
            const double x = dot.points.front().x();
            return x >= 1.6 * part && x < 1.6 * (part + 1);
        };
        const double share = static_cast<double>(std::ranges::count_if(dots, inside)) / (16 * 160);
        EXPECT_NEAR(share, (part + 0.5) / 10.0, 0.02);
    }
}

TEST(Dithering, PutsDotsOnItsGridBackAndForth) {
    const Strokes dots = dithered(even(4, 2, 1.0), 1.0, {.pitch = 1.0});
    ASSERT_EQ(dots.size(), 8U);
    EXPECT_EQ(dots[0].points, std::vector<Vec2>({Vec2(0.5, 1.5)}));
    EXPECT_EQ(dots[3].points, std::vector<Vec2>({Vec2(3.5, 1.5)}));
    EXPECT_EQ(dots[4].points, std::vector<Vec2>({Vec2(3.5, 0.5)}));
    EXPECT_EQ(dots[7].points, std::vector<Vec2>({Vec2(0.5, 0.5)}));
}

TEST(Dithering, JoinsNeighboursInARow) {
    const Strokes apart = dithered(wedge(50, 20), 0.2, {.pitch = 0.2});
    const Strokes joined = dithered(wedge(50, 20), 0.2, {.pitch = 0.2, .join = true});
    EXPECT_EQ(points_of(joined), points_of(apart));
    EXPECT_LT(joined.size(), apart.size());
    for (const Stroke& stroke : joined) {
        for (std::size_t n = 1; n < stroke.points.size(); ++n) {
            EXPECT_NEAR((stroke.points[n] - stroke.points[n - 1]).norm(), 0.2, 1e-9);
        }
    }
}

TEST(Dithering, AveragesPixelsSmallerThanItsDots) {
    Picture checks{40, 40, {}, {}};
    for (int n = 0; n < 1600; ++n) {
        checks.gray.push_back((n % 40 + n / 40) % 2 == 0 ? 0 : white);
    }
    EXPECT_NEAR(static_cast<double>(points_of(dithered(checks, 0.1, {.pitch = 0.4}))), 50.0, 3.0);
}

// Cones: the mouths of all holes together are as large as what is dark.
TEST(Halftone, CoversAsMuchAsIsDark) {
    for (const double darkness : {0.05, 0.3, 0.7}) {
        HalftoneSettings settings;
        settings.pitch = 1.0;
        const CutPath path = halftone(even(400, 300, darkness), 0.1, settings);
        double covered = 0.0;
        for (const CutPoint& point : path) {
            if (point.move == CutMove::plunge) {
                covered += pi * square(-point.at.z() * std::tan(settings.tip.angle / 2.0));
            }
        }
        EXPECT_NEAR(covered, darkness * 40.0 * 30.0, 0.03 * darkness * 40.0 * 30.0) << darkness;
    }
}

TEST(Halftone, StandsOnATurnedGrid) {
    HalftoneSettings settings;
    settings.pitch = 2.0;
    settings.angle = from_degrees(30.0);
    const CutPath path = halftone(even(200, 200, 0.5), 0.1, settings);
    const Vec2 along(std::cos(settings.angle), std::sin(settings.angle));
    std::set<std::pair<long, long>> places;
    for (const CutPoint& point : path) {
        const Vec2 from = (point.at.head<2>() - Vec2(10.0, 10.0)) / 2.0;
        const double u = from.dot(along);
        const double v = from.dot(Vec2(-along.y(), along.x()));
        EXPECT_NEAR(u, std::round(u), 1e-9);
        EXPECT_NEAR(v, std::round(v), 1e-9);
        places.emplace(std::lround(u), std::lround(v));
    }
    EXPECT_EQ(places.size() * 3, path.size());
}

TEST(Engraving, NamesWhatIsWrong) {
    const millwright::test::WithoutTraps no_traps;
    const Picture picture = even(10, 10, 0.5);
    EXPECT_THROW(static_cast<void>(dithered(picture, 1.0, {.pitch = 0.0})), Error);
    EXPECT_THROW(static_cast<void>(dithered(picture, 1.0, {.pitch = 1e-6})), Error);
    EXPECT_THROW(static_cast<void>(dithered(picture, std::nan(""), {})), Error);
    HalftoneSettings settings;
    settings.tip.kind = TipKind::flat;
    try {
        static_cast<void>(halftone(picture, 1.0, settings));
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_THAT(to_text(error.diagnostic()), HasSubstr("flat:6 can only make holes of one width"));
    }
    settings = {};
    settings.pitch = 1e-6;
    EXPECT_THROW(static_cast<void>(halftone(picture, 1.0, settings)), Error);
}

} // namespace
} // namespace millwright::plot
