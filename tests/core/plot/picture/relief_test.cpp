#include "core/plot/picture/relief.h"

#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/plot/picture/relief_plan.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace millwright::plot {
namespace {

/// First 8 columns of the first 12 rows of the picture in the ICCAS 2004 paper of the KMITL thesis of 2006.
Picture thesis_picture() {
    const std::vector<int> gray = {
        92,  93,  94,  91,  90,  90,  88,  89,  129, 130, 131, 131, 133, 136, 138, 137, 99,  99,  100, 95,
        93,  91,  88,  90,  134, 135, 136, 135, 136, 137, 138, 137, 123, 123, 118, 111, 107, 103, 99,  99,
        132, 133, 133, 133, 134, 137, 139, 139, 124, 125, 123, 119, 118, 116, 112, 112, 131, 132, 134, 136,
        137, 139, 143, 146, 129, 128, 126, 126, 127, 126, 122, 118, 138, 140, 142, 141, 141, 142, 144, 145,
        169, 169, 170, 169, 169, 170, 169, 165, 130, 131, 132, 136, 136, 136, 137, 139};
    Picture picture{8, 12, {}, {}};
    for (const int level : gray) {
        picture.gray.push_back(static_cast<std::uint16_t>(level * 257));
    }
    return picture;
}

using Height = std::function<double(int row, int column)>;

HeightField field_of(int columns, int rows, double pitch, const Height& z) {
    HeightField field{columns, rows, pitch, {}};
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            field.z.push_back(static_cast<float>(z(i, j)));
        }
    }
    return field;
}

HeightField noise(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> z(-1.5, 0.0);
    return field_of(17, 13, 0.2, [&](int, int) { return z(random); });
}

HeightField spikes(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> one_in(0, 24);
    return field_of(17, 13, 0.2, [&](int, int) { return one_in(random) == 0 ? 0.0 : -1.0; });
}

HeightField hill() {
    return field_of(17, 13, 0.2, [](int i, int j) { return -0.02 * (square(i - 6.0) + square(j - 8.0)); });
}

HeightField step() {
    return field_of(17, 13, 0.2, [](int i, int j) { return i + j > 14 ? -1.0 : 0.0; });
}

std::vector<HeightField> fields() {
    return {noise(1), spikes(2), spikes(3), hill(), step()};
}

std::vector<ToolTip> tips() {
    return {{TipKind::ball, 1.0},
            {TipKind::ball, 0.37},
            {TipKind::flat, 0.8},
            {TipKind::flat, 0.5},
            {TipKind::v, 6.0, from_degrees(60.0)},
            {TipKind::v, 1.0, from_degrees(20.0)}};
}

/// How deep the tool gets into the worst pixel, tried at many places of each move that may cut; mm.
double over_cut(const CutPath& path, const HeightField& field, const ToolTip& tip) {
    constexpr double spacing = 0.007; // no part of a pixel
    double worst = 0.0;
    for (std::size_t n = 1; n < path.size(); ++n) {
        const Vec3& a = path[n - 1].at;
        const Vec3& b = path[n].at;
        const int count = 1 + static_cast<int>((b - a).norm() / spacing);
        for (int k = 0; k <= count; ++k) {
            const Vec3 at = a + static_cast<double>(k) / count * (b - a);
            for (int i = 0; i < field.rows; ++i) {
                for (int j = 0; j < field.columns; ++j) {
                    const double r = std::hypot(at.x() - j * field.pitch, at.y() - field.y_of_row(i));
                    const double z = static_cast<double>(field.row(i)[static_cast<std::size_t>(j)]);
                    worst = std::max(worst, z - (at.z() + rise(tip, r)));
                }
            }
        }
    }
    return worst;
}

/// How far the tool could come down here, by looking at every pixel.
double lowest_at(const Vec2& at, const HeightField& field, const ToolTip& tip) {
    double z = -1e9;
    for (int i = 0; i < field.rows; ++i) {
        for (int j = 0; j < field.columns; ++j) {
            const double r = (at - Vec2(j * field.pitch, field.y_of_row(i))).norm();
            z = std::max(z, static_cast<double>(field.row(i)[static_cast<std::size_t>(j)]) - rise(tip, r));
        }
    }
    return z;
}

double level_length(const CutPath& path) {
    double length = 0.0;
    for (std::size_t n = 1; n < path.size(); ++n) {
        length += (path[n].at - path[n - 1].at).head<2>().norm();
    }
    return length;
}

std::int64_t count_of(const CutPath& path, CutMove move) {
    return std::ranges::count(path, move, &CutPoint::move);
}

TEST(Relief, OfTheThesisHas96PointsAnd24Point70Millimetres) {
    const HeightField field = height_field(thesis_picture(), 0.26, 1.0);
    ReliefSettings settings;
    settings.tip.kind = TipKind::point;
    settings.merge = false;
    const CutPath path = relief(field, settings);
    EXPECT_EQ(count_of(path, CutMove::plunge) + count_of(path, CutMove::cut), 96);
    EXPECT_NEAR(level_length(path), 24.70, 1e-9);
    // Serpentine from the top left, bright is deep.
    const std::vector<double> first_row = {
        -0.3608, -0.3647, -0.3686, -0.3569, -0.3529, -0.3529, -0.3451, -0.3490};
    for (std::size_t n = 0; n < first_row.size(); ++n) {
        EXPECT_NEAR(path[n + 1].at.z(), first_row[n], 5e-5);
        EXPECT_DOUBLE_EQ(path[n + 1].at.x(), 0.26 * static_cast<double>(n));
        EXPECT_DOUBLE_EQ(path[n + 1].at.y(), 0.26 * 11);
    }
    EXPECT_NEAR(path[9].at.x(), 0.26 * 7, 1e-12);
    EXPECT_NEAR(path[9].at.z(), -137.0 / 255.0, 1e-6);
}

TEST(Relief, OfAnInvertedPictureMakesDarkDeep) {
    Picture picture = thesis_picture();
    for (std::uint16_t& level : picture.gray) {
        level = static_cast<std::uint16_t>(65535 - level); // as the reader does it
    }
    ReliefSettings settings;
    settings.tip.kind = TipKind::point;
    settings.merge = false;
    const CutPath path = relief(height_field(picture, 0.26, 1.0), settings);
    EXPECT_NEAR(path[1].at.z(), -(255.0 - 92.0) / 255.0, 1e-6);
    EXPECT_NEAR(path[2].at.z(), -(255.0 - 93.0) / 255.0, 1e-6);
}

TEST(Relief, OverCutsNoPixelWithAnyTip) {
    for (const HeightField& field : fields()) {
        for (const ToolTip& tip : tips()) {
            for (const double step_over : {0.2, 0.13, 0.31}) {
                for (const double tolerance : {0.0, 0.05}) {
                    ReliefSettings settings;
                    settings.tip = tip;
                    settings.step_over = step_over;
                    settings.merge_tolerance = tolerance;
                    EXPECT_LT(over_cut(relief(field, settings), field, tip), 1e-6)
                        << to_text(tip) << ' ' << step_over << ' ' << tolerance;
                }
            }
        }
    }
}

// The measure bites: a path that follows the pixels themselves cuts into their neighbours.
TEST(Relief, WithoutCompensationWouldOverCut) {
    ReliefSettings settings;
    settings.tip.kind = TipKind::point;
    for (const HeightField& field : fields()) {
        EXPECT_GT(over_cut(relief(field, settings), field, {TipKind::ball, 1.0}), 0.005);
    }
}

TEST(Relief, LeavesNoMoreThanItHasTo) {
    for (const ToolTip& tip : tips()) {
        ReliefSettings settings;
        settings.tip = tip;
        settings.merge = false;
        // On a slope the tip goes down to where single places allow it, or to the surface itself.
        const HeightField slope = field_of(17, 13, 0.2, [](int i, int j) { return -0.03 * i - 0.05 * j; });
        const CutPath path = relief(slope, settings);
        double most = 0.0;
        for (std::size_t n = 1; n + 1 < path.size(); ++n) {
            const Vec3& at = path[n].at;
            const bool in_row =
                std::abs(path[n - 1].at.y() - at.y()) + std::abs(path[n + 1].at.y() - at.y()) < 1e-9;
            const bool upright =
                std::abs(path[n - 1].at.x() - at.x()) * std::abs(path[n + 1].at.x() - at.x()) < 1e-9;
            const bool inside = at.x() > 0.3 && at.x() < 2.9;
            if (path[n].move == CutMove::cut && in_row && !upright && inside) {
                const double surface = -0.03 * (12 - at.y() / 0.2) - 0.25 * at.x();
                most = std::max(most, at.z() - std::max(lowest_at(at.head<2>(), slope, tip), surface));
            }
        }
        // A tip no larger than a pixel, and the rim of an end mill, let go of a pixel at once; on the way to
        // the next column that counts.
        const bool sudden = tip.kind == TipKind::flat || tip.diameter < 0.5;
        EXPECT_LT(most, sudden ? 0.0501 : 0.016) << to_text(tip) << ' ' << most;
        const HeightField level = field_of(9, 9, 0.2, [](int, int) { return -0.7; });
        for (const CutPoint& point : relief(level, settings)) {
            if (point.move == CutMove::cut) {
                EXPECT_NEAR(point.at.z(), -0.7, 1e-6);
            }
        }
        // Nowhere above the highest pixel.
        for (const CutPoint& point : relief(spikes(2), settings)) {
            EXPECT_TRUE(point.at.z() <= 1e-6 || point.at.z() >= settings.safe_height);
        }
    }
}

TEST(Relief, RowsAreAsFarApartAsAsked) {
    ReliefSettings settings;
    settings.step_over = 0.5;
    std::vector<double> rows;
    for (const CutPoint& point : relief(noise(1), settings)) {
        if (rows.empty() || std::abs(point.at.y() - rows.back()) > 1e-9) {
            rows.push_back(point.at.y());
        }
    }
    ASSERT_EQ(rows.size(), 6U); // 2.4 mm in five equal parts of at most 0.5 mm
    EXPECT_DOUBLE_EQ(rows.front(), 2.4);
    EXPECT_DOUBLE_EQ(rows[1], 2.4 - 0.48);
    EXPECT_DOUBLE_EQ(rows.back(), 0.0);
}

TEST(Relief, JoinsPixelsOfEqualDepth) {
    const HeightField field = field_of(100, 3, 0.1, [](int, int j) { return j < 50 ? -1.0 : -0.5; });
    ReliefSettings settings;
    settings.tip.kind = TipKind::point;
    const CutPath path = relief(field, settings);
    EXPECT_EQ(count_of(path, CutMove::plunge) + count_of(path, CutMove::cut), 3 * 4);
    EXPECT_NEAR(level_length(path), 3 * 9.9 + 2 * 0.1, 1e-9);
}

/// z of the moves of one row at x.
double height_at(const CutPath& path, double y, double x) {
    for (std::size_t n = 1; n < path.size(); ++n) {
        const Vec3& a = path[n - 1].at;
        const Vec3& b = path[n].at;
        const bool here = std::abs(a.y() - y) + std::abs(b.y() - y) < 1e-9 && path[n].move == CutMove::cut;
        if (here && x >= std::min(a.x(), b.x()) && x <= std::max(a.x(), b.x()) &&
            std::abs(a.x() - b.x()) > 1e-9) {
            return a.z() + (x - a.x()) / (b.x() - a.x()) * (b.z() - a.z());
        }
    }
    return std::nan("");
}

TEST(Relief, JoinsMovesWithinTheTolerance) {
    const HeightField field = noise(5);
    ReliefSettings settings;
    settings.merge = false;
    const CutPath all = relief(field, settings);
    settings.merge = true;
    settings.merge_tolerance = 0.1;
    const CutPath joined = relief(field, settings);
    EXPECT_LT(joined.size(), all.size() * 3 / 4);
    for (const CutPoint& point : all) {
        if (point.move == CutMove::cut) {
            const double z = height_at(joined, point.at.y(), point.at.x());
            EXPECT_GE(z, height_at(all, point.at.y(), point.at.x()) - 1e-6);
            EXPECT_LE(z, height_at(all, point.at.y(), point.at.x()) + 0.1 + 1e-6);
        }
    }
}

/// Material over the tip where it goes, cut away on the way: the most at once, mm.
double largest_bite(const CutPath& path, const ToolTip& tip) {
    constexpr double cell = 0.05;
    constexpr int side = 100;
    constexpr double corner = -0.8;
    std::vector<double> material(static_cast<std::size_t>(side * side), 0.0);
    double most = 0.0;
    for (std::size_t n = 1; n < path.size(); ++n) {
        const Vec3& a = path[n - 1].at;
        const Vec3& b = path[n].at;
        const int count = 1 + static_cast<int>((b - a).norm() / cell);
        for (int k = 0; k <= count; ++k) {
            const Vec3 at = a + static_cast<double>(k) / count * (b - a);
            for (int c = 0; c < side * side; ++c) {
                const Vec2 middle(corner + cell * (c % side), corner + cell * (c / side)); // NOLINT
                double& top = material[static_cast<std::size_t>(c)];
                const double bottom = at.z() + rise(tip, (at.head<2>() - middle).norm());
                most = std::max(most, top - bottom);
                top = std::min(top, bottom);
            }
        }
    }
    return most;
}

TEST(Relief, IsRoughedInPassesThatLeaveTheAllowance) {
    ReliefSettings settings;
    settings.step_over = 0.2;
    const HeightField field = hill();
    const CutPath plain = relief(field, settings);
    settings.roughing = Roughing{.depth_per_pass = 0.5, .allowance = 0.1, .step_over = 0.4};
    const CutPath path = relief(field, settings);
    // The last pass is the same as without.
    ASSERT_GT(path.size(), plain.size());
    const auto rough = static_cast<std::ptrdiff_t>(path.size() - plain.size());
    EXPECT_TRUE(std::equal(plain.begin(), plain.end(), path.begin() + rough));
    HeightField raised = field;
    for (float& z : raised.z) {
        z += 0.1F;
    }
    const CutPath before(path.begin(), path.begin() + rough);
    EXPECT_LT(over_cut(before, raised, settings.tip), 1e-6);
    // Cusps of 0.04 mm between rows that are 0.4 mm apart, and pixels of noise that rows pass at a distance.
    EXPECT_LT(largest_bite(before, settings.tip), 0.5 + 0.15);
    EXPECT_GT(largest_bite(plain, settings.tip), 1.0);
}

TEST(Relief, OfOnePixelIsAHole) {
    const HeightField field = field_of(1, 1, 0.2, [](int, int) { return -1.0; });
    const CutPath path = relief(field, {});
    ASSERT_EQ(path.size(), 3U);
    EXPECT_EQ(path[1].at, Vec3(0.0, 0.0, -1.0));
    EXPECT_EQ(path[2].move, CutMove::retract);
}

TEST(Relief, IsTheSameOnAnyNumberOfThreads) {
    ReliefSettings settings;
    settings.step_over = 0.05;
    set_thread_count(1);
    const CutPath one = relief(noise(9), settings);
    set_thread_count(7);
    EXPECT_EQ(relief(noise(9), settings), one);
    set_thread_count(0);
}

TEST(Relief, NamesTheSettingThatIsWrong) {
    const millwright::test::WithoutTraps no_traps;
    const HeightField field = noise(1);
    const auto error_of = [&](auto change) -> std::string {
        ReliefSettings settings;
        change(settings);
        try {
            static_cast<void>(relief(field, settings));
        } catch (const Error& error) {
            return error.what();
        }
        return "none";
    };
    using testing::HasSubstr;
    EXPECT_THAT(error_of([](ReliefSettings& s) { s.cutting = 0.0; }), HasSubstr("the cutting speed is 0"));
    EXPECT_THAT(error_of([](ReliefSettings& s) { s.step_over = -1.0; }), HasSubstr("the step-over is -1"));
    EXPECT_THAT(error_of([](ReliefSettings& s) { s.step_over = 1e-9; }),
                HasSubstr("more than 100 million points"));
    EXPECT_THAT(error_of([](ReliefSettings& s) { s.merge_tolerance = std::nan(""); }),
                HasSubstr("the tolerance is nan"));
    EXPECT_THAT(error_of([](ReliefSettings& s) {
                    s.roughing = Roughing{.depth_per_pass = 1e-6, .allowance = 0.0, .step_over = {}};
                }),
                HasSubstr("passes"));
    EXPECT_THROW(static_cast<void>(height_field(thesis_picture(), 0.0, 1.0)), Error);
    EXPECT_THROW(static_cast<void>(height_field(thesis_picture(), 0.26, -1.0)), Error);
}

// A deep relief does not make the cut around it as deep.
TEST(Relief, IsCutOutOfItsPlateInPasses) {
    const HeightField field = field_of(20, 10, 1.0, [](int, int) { return -3.0; });
    const auto steps_of = [&](ReliefPlan plan) {
        plan.relief.tip = {.kind = TipKind::ball, .diameter = 1.0};
        const std::size_t before = relief_path(field, plan).size();
        plan.plate = 4.0;
        const CutPath path = relief_path(field, plan);
        double deepest_step = 0.0;
        double depth = 0.0;
        for (std::size_t n = before; n < path.size(); ++n) {
            if (path[n].move == CutMove::plunge && -path[n].at.z() > depth) {
                deepest_step = std::max(deepest_step, -path[n].at.z() - depth);
                depth = -path[n].at.z();
            }
        }
        EXPECT_DOUBLE_EQ(depth, 4.0);
        return deepest_step;
    };
    EXPECT_NEAR(steps_of({}), 0.5, 1e-9); // half of the tool
    EXPECT_NEAR(steps_of({.relief = {.roughing = Roughing{.depth_per_pass = 0.8}}}), 0.8, 1e-9);
}

TEST(Relief, HasAFrameAroundIt) {
    const Stroke around = frame(field_of(100, 50, 0.1, [](int, int) { return -1.0; }), 3.0, 1.0);
    // 10 x 5 mm of pixels, 1 mm margin, half of the tool.
    EXPECT_NEAR(length(around), 2.0 * (10.0 + 5.0 + 4.0 + 6.0), 1e-9);
    EXPECT_TRUE(around.points.front().isApprox(Vec2(-2.55, -2.55)));
    EXPECT_EQ(around.points.front(), around.points.back());
}

TEST(ReliefPlan, IsNotDeeperThanItsPlateUnlessThatIsAllowed) {
    const HeightField field = field_of(20, 10, 1.0, [](int, int) { return -3.9; });
    ReliefPlan plan;
    plan.relief.tip = {.kind = TipKind::ball, .diameter = 1.0};
    plan.plate = 3.0;
    EXPECT_THROW(static_cast<void>(relief_path(field, plan)), Error);
    plan.through = true;
    EXPECT_NO_THROW(static_cast<void>(relief_path(field, plan)));
    plan.through = false;
    plan.plate = 3.9;
    EXPECT_NO_THROW(static_cast<void>(relief_path(field, plan)));
    plan.tabs.height = 5.0;
    EXPECT_THROW(static_cast<void>(relief_path(field, plan)), Error) << "tabs above the plate";
}

// A ball has no width at its end: full width at the underside takes its radius more, into what lies below. It
// reported pen 1, and the tabs' width with the tool's.
TEST(ReliefPlan, TabsThatDoNotFitAreToldOfTheFrameInTheUsersWidth) {
    const HeightField field = field_of(100, 50, 0.1, [](int, int) { return -0.5; });
    ReliefPlan plan;
    plan.relief.tip = {.kind = TipKind::flat, .diameter = 2.0};
    plan.plate = 3.0;
    plan.tabs = {.count = 50, .width = 20.0, .height = 1.0};
    const auto refusal = [&] {
        try {
            (void)relief_path(field, plan);
        } catch (const Error& error) {
            return error.diagnostic().message;
        }
        return std::string();
    };
    EXPECT_TRUE(refusal().starts_with("frame: 50 tabs of 20 mm do not fit on a path of ")) << refusal();
    EXPECT_TRUE(refusal().ends_with("each also needs 2 mm, the width of the tool")) << refusal();
    plan.tabs = {.count = 1, .width = 2.0, .height = 4.0};
    EXPECT_EQ(refusal(), "frame: tabs of 4 mm are higher than the plate of 3 mm");
}

TEST(ReliefPlan, TellsWhatARoundTipLeavesOfAFrameOrHowDeepItGoes) {
    const HeightField field = field_of(20, 10, 1.0, [](int, int) { return -1.0; });
    const auto bottom = [&](const ReliefPlan& plan) { return deepest(relief_path(field, plan)); };
    ReliefPlan plan;
    plan.relief.tip = {.kind = TipKind::ball, .diameter = 6.0};
    plan.tabs = {.count = 2, .width = 6.0, .height = 1.0};
    EXPECT_FALSE(frame_notice(plan)) << "there is no frame";
    plan.plate = 3.0;
    EXPECT_DOUBLE_EQ(bottom(plan), 3.0);
    EXPECT_NE(frame_notice(plan)->message.find("a flange of up to 3.000 mm"), std::string::npos);
    plan.through = true;
    EXPECT_DOUBLE_EQ(bottom(plan), 6.0);
    EXPECT_NE(frame_notice(plan)->message.find("is cut to 6.000 mm, 3.000 mm below the plate"),
              std::string::npos);
    double highest_tab = -10.0; // they stand 1 mm above the underside
    for (const CutPoint& point : relief_path(field, plan)) {
        const bool around = point.at.x() < -3.0 || point.at.y() < -3.0;
        if (point.move == CutMove::cut && around && point.at.z() > -3.0) {
            highest_tab = std::max(highest_tab, point.at.z());
        }
    }
    EXPECT_NEAR(highest_tab, -2.0, 1e-9);
    plan.relief.tip = {.kind = TipKind::v, .diameter = 4.0, .angle = std::numbers::pi / 2.0};
    EXPECT_NEAR(bottom(plan), 5.0, 1e-9); // 2 mm of radius, 45 degrees
    plan.relief.tip = {.kind = TipKind::flat, .diameter = 4.0};
    EXPECT_DOUBLE_EQ(bottom(plan), 3.0);
    EXPECT_FALSE(frame_notice(plan));
}

} // namespace
} // namespace millwright::plot
