#include "core/base/error.h"
#include "core/geometry/mesh.h"
#include "tests/support/trim_loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>

namespace millwright::geometry {
namespace {

using test::rectangle;

using Triangles = std::vector<std::array<int, 3>>;

Trim::Loop circle_of_48(const Vec2& middle, double radius, int corners = 48) {
    return test::circle(middle, radius, corners);
}

double area(const Trim::Loop& loop) {
    double doubled = 0.0;
    for (std::size_t n = 0; n < loop.size(); ++n) {
        const Vec2& a = loop[n];
        const Vec2& b = loop[n + 1 == loop.size() ? 0 : n + 1];
        doubled += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * std::abs(doubled);
}

double area(const TrimmedSquare& square, const Triangles& triangles) {
    double sum = 0.0;
    for (const auto& [a, b, c] : triangles) {
        const Vec2& p = square.places[static_cast<std::size_t>(a)];
        const Vec2 q = square.places[static_cast<std::size_t>(b)] - p;
        const Vec2 r = square.places[static_cast<std::size_t>(c)] - p;
        const double own = 0.5 * (q.x() * r.y() - q.y() * r.x());
        EXPECT_GE(own, -1e-12) << "counterclockwise";
        sum += own;
    }
    return sum;
}

/// Triangles meet edge to edge, and only on the border of the square is nothing behind an edge.
void expect_no_cracks(const TrimmedSquare& square) {
    std::set<std::pair<double, double>> places;
    for (const Vec2& place : square.places) {
        EXPECT_TRUE(places.insert({place.x(), place.y()}).second) << "one place, one number";
    }
    std::map<std::pair<int, int>, int> edges;
    for (const Triangles* triangles : {&square.inside, &square.outside}) {
        for (const auto& [a, b, c] : *triangles) {
            for (const auto& edge : {std::pair{a, b}, {b, c}, {c, a}}) {
                ++edges[edge];
            }
        }
    }
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        const Vec2& a = square.places[static_cast<std::size_t>(edge.first)];
        const Vec2& b = square.places[static_cast<std::size_t>(edge.second)];
        const Vec2 middle = 0.5 * (a + b);
        const bool on_border = std::min(middle.minCoeff(), 1.0 - middle.maxCoeff()) < 1e-12;
        EXPECT_TRUE(on_border || edges.contains({edge.second, edge.first}))
            << a.transpose() << " - " << b.transpose();
    }
}

TEST(TrimmedSquare, LeavesTheAreaOfThePolygonsWithoutCracks) {
    const Trim::Loop outer{{0.0, 0.0}, {1.0, 0.03}, {0.9, 0.95}, {0.42, 1.0}, {0.0, 0.7}};
    const Trim::Loop round = circle_of_48({0.6, 0.4}, 0.213), tiny = circle_of_48({0.3, 0.5}, 0.004, 7);
    const std::vector<std::pair<Trim, double>> cases{
        {{{round}}, area(round)},
        {{{outer, round}}, area(outer) - area(round)},
        {{{outer, tiny}}, area(outer) - area(tiny)},
        {{{rectangle(0.25, 0.5, 0.75, 1.0)}}, 0.25},
        {{{rectangle(0.0, 0.0, 1.0, 1.0)}}, 1.0},
        {{{rectangle(0.1, 0.1, 0.9, 0.9), rectangle(0.2, 0.2, 0.8, 0.8), circle_of_48({0.5, 0.5}, 0.1)}},
         0.64 - 0.36 + area(circle_of_48({0.5, 0.5}, 0.1))}};
    for (const auto& [trim, wanted] : cases) {
        for (const auto& [nu, nv] : {std::pair{8, 8}, {1, 1}, {13, 5}, {40, 64}}) {
            const TrimmedSquare square = trimmed_square(trim, nu, nv);
            EXPECT_NEAR(area(square, square.inside), wanted, 1e-9) << nu << " x " << nv;
            EXPECT_NEAR(area(square, square.outside), 1.0 - wanted, 1e-9) << nu << " x " << nv;
            expect_no_cracks(square);
        }
    }
}

TEST(TrimmedSquare, EveryTriangleIsWhollyOnOneSide) {
    const Trim trim{{rectangle(0.0, 0.0, 1.0, 1.0), circle_of_48({0.55, 0.45}, 0.31)}};
    const TrimmedSquare square = trimmed_square(trim, 10, 10);
    const auto expect_all = [&](const Triangles& triangles, bool inside) {
        for (const auto& [a, b, c] : triangles) {
            const auto place = [&](int n) { return square.places[static_cast<std::size_t>(n)]; };
            const Vec2 middle = (place(a) + place(b) + place(c)) / 3.0;
            for (const int n : {a, b, c}) {
                const Vec2 beside = place(n) + 1e-6 * (middle - place(n));
                EXPECT_EQ(trim.contains(beside), inside) << beside.transpose();
            }
        }
    };
    expect_all(square.inside, true);
    expect_all(square.outside, false);
}

TEST(TrimmedSquare, WithoutLoopsIsAllInside) {
    const TrimmedSquare square = trimmed_square({}, 3, 2);
    EXPECT_EQ(square.places.size(), 12U);
    EXPECT_EQ(square.inside.size(), 12U);
    EXPECT_TRUE(square.outside.empty());
}

/// By how many edges a ray in the direction of u meets.
bool seen_inside(const Trim& trim, const Vec2& at) {
    bool inside = false;
    for (const Trim::Loop& loop : trim.loops) {
        for (std::size_t n = 0; n < loop.size(); ++n) {
            const Vec2 a = loop[n] - at, b = loop[n + 1 == loop.size() ? 0 : n + 1] - at;
            if ((a.y() > 0.0) != (b.y() > 0.0) && (a.x() * b.y() - a.y() * b.x() > 0.0) == (b.y() > a.y())) {
                inside = !inside;
            }
        }
    }
    return inside;
}

int triangles_over(const TrimmedSquare& square, const Triangles& triangles, const Vec2& at) {
    return static_cast<int>(std::ranges::count_if(triangles, [&](const std::array<int, 3>& triangle) {
        for (std::size_t n = 0; n < 3; ++n) {
            const Vec2& p = square.places[static_cast<std::size_t>(triangle[n])];
            const Vec2 side = square.places[static_cast<std::size_t>(triangle[(n + 1) % 3])] - p;
            if (side.x() * (at.y() - p.y()) < side.y() * (at.x() - p.x())) {
                return false;
            }
        }
        return true;
    }));
}

/// Over each of `count` x `count` places one triangle, on the side that the loops tell.
void expect_covers(const Trim& trim, const TrimmedSquare& square, int count) {
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < count; ++k) {
            const Vec2 at((i + 0.4931) / count, (k + 0.5117) / count); // on no line and no edge
            const bool inside = seen_inside(trim, at);
            EXPECT_EQ(triangles_over(square, square.inside, at), inside ? 1 : 0) << at.transpose();
            EXPECT_EQ(triangles_over(square, square.outside, at), inside ? 0 : 1) << at.transpose();
        }
    }
}

TEST(TrimmedSquare, LeavesNoHoleWhereALoopCrossesItself) {
    const Trim lying{{{{0.1, 0.1}, {0.9, 0.9}, {0.9, 0.1}, {0.1, 0.9}}}};
    const Trim standing{{{{0.1, 0.1}, {0.9, 0.1}, {0.1, 0.9}, {0.9, 0.9}}}};
    for (const Trim* bow_tie : {&lying, &standing}) {
        for (const auto& [nu, nv] : {std::pair{31, 31}, {1, 1}, {10, 10}, {7, 12}}) {
            const TrimmedSquare square = trimmed_square(*bow_tie, nu, nv);
            EXPECT_NEAR(area(square, square.inside), 0.32, 1e-9) << nu << " x " << nv;
            expect_no_cracks(square);
            expect_covers(*bow_tie, square, 40);
            for (const Vec2& at : {Vec2(0.5003, 0.4991), Vec2(0.5003, 0.5009)}) {
                EXPECT_EQ(triangles_over(square, square.inside, at) +
                              triangles_over(square, square.outside, at),
                          1);
            }
        }
    }
}

TEST(TrimmedSquare, FollowsRandomLoopsThatCrossThemselvesAndEachOther) {
    std::mt19937 random(20);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int turn = 0; turn < 12; ++turn) {
        Trim trim;
        for (int loop = 0; loop < 2; ++loop) {
            auto& corners = trim.loops.emplace_back();
            for (int k = 0; k < 4 + turn; ++k) {
                corners.emplace_back(share(random), share(random));
            }
        }
        for (const auto& [nu, nv] : {std::pair{1, 1}, {9, 6}}) {
            const TrimmedSquare square = trimmed_square(trim, nu, nv);
            EXPECT_NEAR(area(square, square.inside) + area(square, square.outside), 1.0, 1e-9);
            expect_no_cracks(square);
            expect_covers(trim, square, 25);
        }
    }
}

TEST(TrimmedSquare, TakesCornersOnTheSidesOfCellsAndAHairBesideThem) {
    std::mt19937 random(21);
    std::uniform_int_distribution<int> step(0, 6), hair(-3, 3);
    for (int turn = 0; turn < 40; ++turn) {
        Trim exact, beside;
        auto& corners = exact.loops.emplace_back();
        auto& near = beside.loops.emplace_back();
        for (int k = 0; k < 9; ++k) {
            corners.emplace_back(step(random) / 6.0, step(random) / 6.0);
            const Vec2 off(hair(random), hair(random));
            near.emplace_back((corners.back() + 0.4e-12 * off).cwiseMax(0.0).cwiseMin(1.0));
        }
        const TrimmedSquare square = trimmed_square(exact, 6, 3);
        expect_no_cracks(square);
        expect_covers(exact, square, 25);
        expect_no_cracks(trimmed_square(beside, 6, 3));
    }
}

TEST(TrimmedSquare, LeavesNoHoleAmongMoreCrossingsThanAreFollowed) {
    Trim::Loop star; // 101 corners, nearly each edge crosses each other one
    for (int k = 0; k < 101; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k * 50 % 101) / 101;
        star.emplace_back(Vec2(0.5, 0.5) + 0.45 * Vec2(std::cos(angle), std::sin(angle)));
    }
    const TrimmedSquare square = trimmed_square({{star}}, 1, 1);
    EXPECT_NEAR(area(square, square.inside) + area(square, square.outside), 1.0, 1e-9);
    expect_no_cracks(square);
}

TEST(TrimmedSquare, SlicesOnlyTheCellsThatACornerIsBeside) {
    const Trim slot{{rectangle(0.01, 0.02, 0.03, 0.98), circle_of_48({0.955, 0.5}, 0.02, 400)}};
    const TrimmedSquare square = trimmed_square(slot, 20, 1);
    EXPECT_LT(square.inside.size() + square.outside.size(), 4'000U) << "the slot is not cut at the circle";
    expect_no_cracks(square);
    expect_covers(slot, square, 30);
}

TEST(TrimmedSquare, RefusesAMeshWithoutCells) {
    EXPECT_THROW((void)trimmed_square({}, 0, 3), Defect);
}

} // namespace
} // namespace millwright::geometry
