// Gap linking against the numbers computed from the listings of the KMITL master's thesis of 2006.
#include "core/plot/linking.h"

#include "core/base/error.h"
#include "core/hpgl/reader.h"
#include "core/plot/ordering.h"
#include "core/plot/stroke_plan.h"
#include "core/plot/work_time.h"
#include "tests/core/hpgl/thesis_drawings.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::plot {
namespace {

Strokes strokes_of_hpgl(const std::string& hpgl) {
    return hpgl::read_hpgl(hpgl, "thesis.plt").strokes;
}

Linked linked(const Strokes& strokes, double distance) {
    return link(strokes, {.distance = distance});
}

TEST(GapLinking, HatchesOfTheThesisJoinAsComputed) {
    const Linked fb = linked(strokes_of_hpgl(test::hatch_fb()), 3.0);
    EXPECT_EQ(fb.strokes.size(), 1U);
    EXPECT_EQ(fb.links, 5);
    EXPECT_NEAR(fb.link_length, 1.6 + 1.575 + 1.6 + 1.575 + 1.6, 1e-9);

    const Strokes fcd = strokes_of_hpgl(test::hatch_fc_fd());
    EXPECT_EQ(linked(fcd, 3.0).links, 8);
    EXPECT_EQ(linked(fcd, 3.0).strokes.size(), 5U);
    EXPECT_EQ(linked(fcd, 3.02).links, 9);
    EXPECT_EQ(linked(fcd, 3.02).strokes.size(), 4U);
}

TEST(GapLinking, PenUpStepOfTheListingJoinsAtThreeAndStaysAtLess) {
    const Strokes strokes = strokes_of_hpgl(test::listing_later_part());
    EXPECT_EQ(linked(strokes, 3.0).strokes.size(), 1U);
    EXPECT_EQ(linked(strokes, 2.7).strokes.size(), 2U);
}

TEST(GapLinking, IsStrict) {
    const Strokes apart = {{.pen = 1, .points = {{0.0, 0.0}, {1.0, 0.0}}},
                           {.pen = 1, .points = {{4.0, 0.0}, {5.0, 0.0}}}};
    EXPECT_EQ(linked(apart, 3.0).links, 0);
    EXPECT_EQ(linked(apart, 3.0000001).links, 1);
}

TEST(GapLinking, KeepsTheWholeLength) {
    const Strokes strokes = strokes_of_hpgl(test::hatch_fc_fd());
    const Vec2 origin = Vec2::Zero();
    const double before = draw_length(strokes) + air_length(strokes, origin, origin);
    const Strokes joined = linked(strokes, 3.0).strokes;
    EXPECT_NEAR(draw_length(joined) + air_length(joined, origin, origin), before, 1e-9);
}

TEST(GapLinking, NeverJoinsTwoPensOrADot) {
    const Strokes strokes = {{.pen = 1, .points = {{0.0, 0.0}, {1.0, 0.0}}},
                             {.pen = 2, .points = {{1.1, 0.0}, {2.0, 0.0}}},
                             {.pen = 2, .points = {{2.1, 0.0}}},
                             {.pen = 2, .points = {{2.2, 0.0}, {3.0, 0.0}}}};
    EXPECT_EQ(linked(strokes, 3.0).strokes, strokes);
}

// A U: hatch lines end on both sides of the notch, and the short way between them leads through it.
TEST(GapLinking, SafeModeRefusesALinkThatLeavesTheRegion) {
    const Region notched = {{{0.0, 0.0},
                             {10.0, 0.0},
                             {10.0, 10.0},
                             {6.0, 10.0},
                             {6.0, 4.0},
                             {4.0, 4.0},
                             {4.0, 10.0},
                             {0.0, 10.0}}};
    const Strokes strokes = {{.pen = 1, .points = {{0.0, 6.0}, {4.0, 6.0}}},
                             {.pen = 1, .points = {{6.0, 6.0}, {10.0, 6.0}}},
                             {.pen = 1, .points = {{10.0, 7.5}, {6.0, 7.5}}}};
    EXPECT_EQ(linked(strokes, 3.0).links, 2);
    const Linked safe = link(strokes, {.distance = 3.0, .outlines = notched});
    EXPECT_EQ(safe.links, 1);
    EXPECT_EQ(safe.refused, 1);
    EXPECT_EQ(safe.strokes.size(), 2U);
    // By brute force: no point of a linked stroke is outside.
    for (const Stroke& stroke : safe.strokes) {
        for (std::size_t n = 1; n < stroke.points.size(); ++n) {
            for (double t = 0.01; t < 1.0; t += 0.01) {
                const Vec2 p = stroke.points[n - 1] + t * (stroke.points[n] - stroke.points[n - 1]);
                EXPECT_TRUE(contains(notched, p) || std::abs(p.x() - 10.0) < 1e-9);
            }
        }
    }
}

// A ring in a frame: a point of the hole has as many lines around it as one beside the frame, plus two.
TEST(GapLinking, SafeModeKnowsAHoleFromTheFaceAroundIt) {
    const Ring frame = {{-50.0, -50.0}, {50.0, -50.0}, {50.0, 50.0}, {-50.0, 50.0}};
    const Ring outer = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}};
    const Ring hole = {{4.0, 2.0}, {6.0, 2.0}, {6.0, 8.0}, {4.0, 8.0}};
    const Strokes across_the_hole = {{.pen = 1, .points = {{0.0, 5.0}, {4.0, 5.0}}},
                                     {.pen = 1, .points = {{6.0, 5.0}, {10.0, 5.0}}}};
    const Strokes beside_it = {{.pen = 1, .points = {{0.0, 5.0}, {4.0, 5.0}}},
                               {.pen = 1, .points = {{4.0, 6.0}, {0.0, 6.0}}},
                               {.pen = 1, .points = {{1.0, 7.0}, {3.0, 7.0}}}};
    const Strokes out_of_the_ring = {{.pen = 1, .points = {{8.0, 5.0}, {9.0, 5.0}}},
                                     {.pen = 1, .points = {{11.0, 5.0}, {12.0, 5.0}}}};
    for (const std::vector<Ring>& outlines :
         {std::vector<Ring>{outer, hole}, std::vector<Ring>{frame, outer, hole}}) {
        const LinkSettings settings = {.distance = 3.0, .outlines = outlines};
        EXPECT_EQ(link(across_the_hole, settings).refused, 1);
        EXPECT_EQ(link(beside_it, settings).links, 2);
        EXPECT_EQ(link(out_of_the_ring, settings).refused, 1);
    }
}

TEST(GapLinking, ClosedStrokesAreOutlines) {
    const Strokes strokes = strokes_of_hpgl("SP1;PU0,0;PD400,0,400,400,0,400,0,0;PU100,100;PD200,100;");
    const std::vector<Ring> outlines = closed_outlines(strokes);
    ASSERT_EQ(outlines.size(), 1U);
    EXPECT_EQ(outlines[0].size(), 4U);
    EXPECT_THROW(static_cast<void>(linked(strokes, -1.0)), Error);
}

// The sign that ships: links of the safe mode are inside of letters, wherever one looks on them. The pen of
// the letters is 2, that of the frame 1.
TEST(GapLinking, LinksOfTheSignStayInItsLetters) {
    const Strokes strokes = hpgl::read_hpgl_file("assets/samples/plot/hatched-sign.plt").strokes;
    const std::vector<Ring> outlines = closed_outlines(strokes);
    const Region letters(outlines.begin() + 1, outlines.end());
    const Linked safe = link(strokes, {.distance = 3.0, .outlines = outlines});
    EXPECT_LT(safe.strokes.size(), strokes.size() / 2);
    EXPECT_GT(safe.refused, 0);
    for (const Stroke& stroke : safe.strokes) {
        for (std::size_t n = 1; n < stroke.points.size() && stroke.pen == 2; ++n) {
            for (double t = 0.05; t < 1.0; t += 0.1) {
                const Vec2 p = stroke.points[n - 1] + t * (stroke.points[n] - stroke.points[n - 1]);
                bool inside = false;
                for (const Vec2& nudge :
                     {Vec2(1e-3, 0.0), Vec2(-1e-3, 0.0), Vec2(0.0, 1e-3), Vec2(0.0, -1e-3)}) {
                    inside = inside || contains(letters, p + nudge);
                }
                EXPECT_TRUE(inside) << p.transpose();
            }
        }
    }
}

// The sign of the thesis in Thai, hatched: its distance stays, lifts and time go down. The thesis saved 39.3
// % of a sign whose sizes are lost.
TEST(GapLinking, OfTheThaiSignSavesLiftsAndTimeAndKeepsTheDistance) {
    const Strokes drawn = hpgl::read_hpgl_file("assets/samples/plot/thesis-sign.plt").strokes;
    const Vec2 home = Vec2::Zero();
    const WorkTime before = work_time(drawn, {}, home, home);
    const WorkTime joined = work_time(linked(drawn, 3.0).strokes, {}, home, home);
    EXPECT_NEAR(joined.distance(), before.distance(), 1e-6);
    EXPECT_LT(joined.runs, before.runs / 2);
    EXPECT_LT(joined.seconds, 0.76 * before.seconds);
    const WorkTime in_order = work_time(linked(ordered(drawn), 3.0).strokes, {}, home, home);
    EXPECT_LT(in_order.runs, before.runs / 5);
    EXPECT_LT(in_order.seconds, 0.62 * before.seconds);
}

TEST(WorkTimes, OfLevelsCountWhatIsCut) {
    const Strokes drawn = {{.pen = 1, .points = {{10.0, 0.0}, {20.0, 0.0}}},
                           {.pen = 2, .points = {{20.0, 5.0}, {40.0, 5.0}}},
                           {.pen = 1, .points = {{40.0, 0.0}, {50.0, 0.0}}}};
    const Vec2 home = Vec2::Zero();
    std::vector<Level> levels = levels_for(drawn);
    const WorkTime once = work_time(drawn, levels, {}, home, home);
    EXPECT_NEAR(once.cut_length, 40.0, 1e-9);
    EXPECT_NEAR(once.travel_length, 10.0 + 20.0 + std::hypot(30.0, 5.0) + std::hypot(40.0, 5.0), 1e-9);
    EXPECT_EQ(once.runs, 3);
    EXPECT_NEAR(once.seconds, once.cut_length / 2.0 + once.travel_length / 10.0 + 18.0, 1e-9);
    levels[1].enabled = false;
    levels[0].passes = 2;
    const WorkTime twice = work_time(drawn, levels, {}, home, home);
    EXPECT_NEAR(twice.cut_length, 40.0, 1e-9);
    EXPECT_NEAR(twice.travel_length, 10.0 + 20.0 + 40.0 + 20.0 + 50.0, 1e-9);
    EXPECT_EQ(twice.runs, 4);
    levels.push_back(levels[0]);
    EXPECT_EQ(work_time(drawn, levels, {}, home, home).runs, 8);
    // By the feeds of the levels in place of the thesis's 2 mm/s.
    std::vector<Level> fast = levels;
    for (Level& level : fast) {
        level.cutting = 8.0;
    }
    const WorkTime at_feeds = work_time(drawn, fast, {}, home, home);
    EXPECT_NEAR(
        at_feeds.seconds - at_feeds.seconds_at_feeds, at_feeds.cut_length * (1.0 / 2.0 - 1.0 / 8.0), 1e-9);
    levels[1].enabled = true;
    levels[1].order = -1;
    EXPECT_NEAR(work_time(drawn, {levels[0], levels[1]}, {}, home, home).travel_length,
                std::hypot(20.0, 5.0) + std::hypot(30.0, 5.0) + 20.0 + 40.0 + 20.0 + 50.0,
                1e-9);
    EXPECT_THROW((void)work_time(drawn, levels, {.cutting = 0.0}, home, home), Error);
}

// The two jobs whose geometry is known: travel 19 mm and 249.42 mm. The thesis shows 214 s and 193 s.
TEST(WorkTimes, AreThoseOfTheThesis) {
    const Strokes square = {
        {.pen = 1, .points = {{9.5, 0.0}, {112.5, 0.0}, {112.5, 103.0}, {9.5, 103.0}, {9.5, 0.0}}}};
    const WorkTime time = work_time(square, {}, {0.0, 0.0}, {0.0, 0.0});
    EXPECT_NEAR(time.cut_length, 412.0, 1e-9);
    EXPECT_NEAR(time.travel_length, 19.0, 1e-9);
    EXPECT_NEAR(time.seconds, 214.0, 1.0);
    EXPECT_NEAR(time.distance(), 431.0, 1e-9);
    const Strokes circle = {
        {.pen = 1, .points = {{124.71, 0.0}, {124.71 - 323.58 / 2.0, 0.0}, {124.71, 0.0}}}};
    EXPECT_NEAR(work_time(circle, {}, {0.0, 0.0}, {0.0, 0.0}).seconds, 193.0, 1.0);
    EXPECT_EQ(minutes_and_seconds(time.seconds), "3:34");
    EXPECT_EQ(minutes_and_seconds(2465.0), "41:05");
    EXPECT_EQ(minutes_and_seconds(16823.0), "4:40:23");
    EXPECT_EQ(time_for_people(3598.6), "59:59 min");
    EXPECT_EQ(time_for_people(3599.1), "1:00:00 h");
}

/// A star of seven points with a round hole.
constexpr const char* holed_star = "IN;SP1;PU7575,6000;PD9153,7519,6982,7231,6779,9412,5650,7536,3818,8736,"
                                   "4581,6683,2500,6000,4581,5317,3818,"
                                   "3264,5650,4464,6779,2588,6982,4769,9153,4481,7575,6000;PU;PU6500,6000;"
                                   "PD6476,6155,6405,6294,6294,6405,6155,"
                                   "6476,6000,6500,5845,6476,5706,6405,5595,6294,5524,6155,5500,6000,5524,"
                                   "5845,5595,5706,5706,5595,5845,5524,"
                                   "6000,5500,6155,5524,6294,5595,6405,5706,6476,5845,6500,6000;PU;SP0;";

double distance_to_segment(const Vec2& a, const Vec2& b, const Vec2& p) {
    const Vec2 way = b - a;
    const double t = std::clamp((p - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
    return (a + t * way - p).norm();
}

/// The least distance of what is cut from what is drawn, sampled.
double least_distance(const Strokes& cut, const Strokes& drawn) {
    double least = 1e9;
    for (const Stroke& stroke : cut) {
        for (std::size_t n = 1; n < stroke.points.size(); ++n) {
            for (int k = 0; k <= 16; ++k) {
                const Vec2 p = stroke.points[n - 1] + k / 16.0 * (stroke.points[n] - stroke.points[n - 1]);
                for (const Stroke& outline : drawn) {
                    for (std::size_t m = 1; m < outline.points.size(); ++m) {
                        least =
                            std::min(least, distance_to_segment(outline.points[m - 1], outline.points[m], p));
                    }
                }
            }
        }
    }
    return least;
}

TEST(GapLinking, LinksOfACompensatedToolStayItsRadiusFromTheOutline) {
    const Strokes drawn = strokes_of_hpgl(holed_star);
    for (const bool order : {false, true}) {
        for (const double link : {3.0, 6.0}) {
            SCOPED_TRACE(link);
            StrokePlan plan;
            plan.side = CutterSide::inside;
            plan.hatch_pitch = 1.5;
            plan.order = order;
            plan.link = link;
            const Strokes crossing = planned(drawn, plan, Progress()).strokes;
            EXPECT_LT(least_distance(crossing, drawn), 1.4); // else this shows nothing
            plan.link_inside = true;
            const Strokes inside = planned(drawn, plan, Progress()).strokes;
            EXPECT_LT(inside.size(), shaped(drawn, plan).strokes.size());
            EXPECT_GT(least_distance(inside, drawn), 1.5 - 1e-5);
        }
    }
}

} // namespace
} // namespace millwright::plot
