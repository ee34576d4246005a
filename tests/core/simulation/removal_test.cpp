#include "core/simulation/removal.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/toolpath/cutter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stop_token>
#include <vector>

namespace millwright::simulation {
namespace {

using geometry::ToolPose;
using toolpath::CutterKind;
using toolpath::CutterShape;
using toolpath::Profile;

constexpr std::size_t removal_bytes = 2'000'000'000;

CutterShape ball_6() {
    return {.kind = CutterKind::ball, .diameter = 6.0, .length = 30.0};
}
CutterShape flat_6() {
    return {.kind = CutterKind::flat, .diameter = 6.0, .length = 30.0};
}

/// A block under z = 0, cut along poses one after another.
class CutBlock {
public:
    CutBlock(const Stock& stock, const CutterShape& cutter, double pitch)
        : cutter_(*toolpath::body_of(cutter)), field_(stock, pitch, removal_bytes, Progress()),
          removal_(field_), stock_volume_(volume(stock)) {}

    void cut(const std::vector<ToolPose>& poses, bool rapid = false) {
        std::vector<CutStep> steps;
        for (std::size_t n = 1; n < poses.size(); ++n) {
            divide(cutter_, poses[n - 1], poses[n], static_cast<std::int32_t>(n), rapid, steps);
        }
        removal_.remove(steps, Progress());
    }
    [[nodiscard]] double removed() const { return stock_volume_ - field_.volume(); }
    [[nodiscard]] const DexelField& field() const { return field_; }
    [[nodiscard]] const Removal& removal() const { return removal_; }

private:
    CuttingBody cutter_;
    DexelField field_;
    Removal removal_;
    double stock_volume_;
};

BoxStock block(double x, double y, double z) {
    return {{0.0, 0.0, -z}, {x, y, 0.0}};
}

void expect_within(double found, double expected, double share) {
    EXPECT_NEAR(found, expected, share * expected) << "off by " << 100.0 * (found / expected - 1.0) << " %";
}

constexpr double a_tenth_of_a_percent = 1e-3;

TEST(Removal, BallSlotHasItsVolume) {
    CutBlock cut(block(60.0, 20.0, 10.0), ball_6(), 0.1);
    constexpr double depth = 2.0, radius = 3.0;
    cut.cut({{Vec3(-10.0, 9.7, -depth), Vec3::UnitZ()}, {Vec3(70.0, 9.7, -depth), Vec3::UnitZ()}});
    const double half_width = std::sqrt(radius * radius - (radius - depth) * (radius - depth));
    const double section = radius * radius * std::asin(half_width / radius) - half_width * (radius - depth);
    expect_within(cut.removed(), 60.0 * section, a_tenth_of_a_percent);
}

TEST(Removal, FlatPocketHasItsVolume) {
    CutBlock cut(block(60.0, 40.0, 10.0), flat_6(), 0.2);
    // A rectangle of 40.3 x 20.7 with corners of radius 3, around poses that never leave it.
    const double left = 7.13, right = 7.13 + 40.3 - 6.0, front = 8.21, back = 8.21 + 20.7 - 6.0;
    std::vector<ToolPose> poses;
    for (double y = front; y < back; y += 2.5) {
        poses.push_back({Vec3(left, y, -4.13), Vec3::UnitZ()});
        poses.push_back({Vec3(right, y, -4.13), Vec3::UnitZ()});
        poses.push_back({Vec3(left, y, -4.13), Vec3::UnitZ()});
    }
    for (const Vec2& corner : {Vec2(left, back), Vec2(right, back), Vec2(right, front), Vec2(left, front)}) {
        poses.push_back({Vec3(corner.x(), corner.y(), -4.13), Vec3::UnitZ()});
    }
    poses.push_back({Vec3(left, back, -4.13), Vec3::UnitZ()});
    cut.cut(poses);
    expect_within(cut.removed(), (40.3 * 20.7 - (4.0 - pi) * 9.0) * 4.13, a_tenth_of_a_percent);
}

TEST(Removal, BullNoseRingHasItsVolume) {
    const CutterShape bull{
        .kind = CutterKind::bull_nose, .diameter = 8.0, .corner_radius = 1.0, .length = 30.0};
    CutBlock cut(block(50.0, 50.0, 8.0), bull, 0.2);
    constexpr double middle = 15.0, depth = 3.0;
    std::vector<ToolPose> poses;
    constexpr int chords = 720;
    for (int n = 0; n <= chords; ++n) {
        const double angle = 2.0 * pi * n / chords;
        poses.push_back(
            {Vec3(25.0 + middle * std::cos(angle), 25.0 + middle * std::sin(angle), -depth), Vec3::UnitZ()});
    }
    cut.cut(poses);
    // Pappus: the section is symmetric to its middle.
    const double section = 8.0 * depth - (2.0 - 0.5 * pi) * 1.0;
    expect_within(cut.removed(), 2.0 * pi * middle * section, a_tenth_of_a_percent);
}

TEST(Removal, TiltedFlatLeavesAWedge) {
    CutBlock cut(block(40.0, 30.0, 10.0), flat_6(), 0.1);
    // Tilted across the way: in the section across, a rectangle of 6 mm that leans, one corner 2 mm deep.
    const double tilt = from_degrees(20.0);
    const Vec3 axis(0.0, std::sin(tilt), std::cos(tilt));
    const Vec3 rim(0.0, 3.0 * std::cos(tilt), -3.0 * std::sin(tilt)); // from the tip to the lowest corner
    const Vec3 lowest(0.0, 15.0, -2.0);
    const Vec3 tip = lowest - rim;
    cut.cut({{Vec3(-10.0, tip.y(), tip.z()), axis}, {Vec3(50.0, tip.y(), tip.z()), axis}});
    // The triangle under z = 0: two sides that are square to each other, along the bottom and along the
    // shank.
    const double along_bottom = 2.0 / std::sin(tilt), along_shank = 2.0 / std::cos(tilt);
    expect_within(cut.removed(), 40.0 * 0.5 * along_bottom * along_shank, a_tenth_of_a_percent);
}

TEST(Removal, ToolSwungAboutItsTipLeavesASector) {
    CutBlock cut(block(40.0, 40.0, 20.0), ball_6(), 0.1);
    // The ball's middle stays: flank cylinders on both sides of the swing, and the ball under them.
    constexpr double radius = 3.0, swing = 30.0;
    std::vector<ToolPose> poses;
    const Vec3 middle(20.0, 20.0, -8.0);
    for (const double degrees : {-swing, swing}) {
        const Vec3 axis(std::sin(from_degrees(degrees)), 0.0, std::cos(from_degrees(degrees)));
        poses.push_back({Vec3(middle - radius * axis), axis});
    }
    // divide() takes the tip straight: with the ball's middle fixed the tip goes around it.
    std::vector<ToolPose> fine;
    constexpr int parts = 300;
    for (int n = 0; n <= parts; ++n) {
        const double angle = from_degrees(-swing + 2.0 * swing * n / parts);
        const Vec3 axis(std::sin(angle), 0.0, std::cos(angle));
        fine.push_back({Vec3(middle - radius * axis), axis});
    }
    cut.cut(fine);
    // Under z = 0, at |y| = c from the middle plane: the points within sqrt(9 - y^2) of a sector of half
    // angle `swing` with its apex 8 mm deep. Integrated numerically over y and x, which shares no code.
    double expected = 0.0;
    constexpr int slices = 300, columns = 3000;
    for (int i = 0; i < slices; ++i) {
        const double y = radius * (i + 0.5) / slices;
        const double r = std::sqrt(radius * radius - y * y);
        for (int j = 0; j < columns; ++j) {
            const double x = 10.0 * (j + 0.5) / columns;
            // The lowest point of the grown sector over x: the disc about the apex, or the offset flank.
            const double s = std::sin(from_degrees(swing)), c = std::cos(from_degrees(swing));
            double low = x <= r * c ? -8.0 - std::sqrt(r * r - x * x) : 0.0;
            if (x > r * c) { // the line at distance r beyond the flank through the apex
                low = -8.0 + (x * c - r) / s;
            }
            expected += 4.0 * std::max(-low, 0.0) * (radius / slices) * (10.0 / columns);
        }
    }
    expect_within(cut.removed(), expected, a_tenth_of_a_percent);
}

TEST(Removal, CylinderTurnedUnderAToolHasItsVolume) {
    // A bar along X that turns under a flat end: in part coordinates the tool goes around it.
    const CylinderStock bar{.base = {0.0, 0.0, 0.0}, .axis = 0, .diameter = 30.0, .length = 40.0};
    CutBlock cut(bar, flat_6(), 0.2);
    std::vector<ToolPose> poses;
    constexpr int parts = 1440;
    constexpr double radius = 12.0;
    for (int n = 0; n <= parts; ++n) {
        const double angle = 2.0 * pi * n / parts;
        const Vec3 axis(0.0, std::sin(angle), std::cos(angle));
        poses.push_back({Vec3(Vec3(20.0, 0.0, 0.0) + radius * axis), axis});
    }
    cut.cut(poses);
    expect_within(cut.removed(), pi * (15.0 * 15.0 - radius * radius) * 6.0, a_tenth_of_a_percent);
}

// --- The surface against true tool positions ---

ToolPose between_poses(const ToolPose& from, const ToolPose& to, double f) {
    const double turn = angle_between(from.axis, to.axis);
    const Vec3 across =
        turn > 0.0 ? Vec3((to.axis - to.axis.dot(from.axis) * from.axis).normalized()) : Vec3(Vec3::Zero());
    return {from.tip + f * (to.tip - from.tip), std::cos(f * turn) * from.axis + std::sin(f * turn) * across};
}

/// How deep the point is in any tool position of the moves; above 0: outside of all, by so much. The nearest
/// of many instances, and a golden section around it.
double depth_in(const Profile& body, const std::vector<ToolPose>& poses, const Vec3& point) {
    double least = std::numeric_limits<double>::infinity();
    constexpr int instances = 200;
    for (std::size_t n = 1; n < poses.size(); ++n) {
        const auto distance_at = [&](double f) {
            return toolpath::distance(body, between_poses(poses[n - 1], poses[n], f), point);
        };
        int nearest = 0;
        for (int i = 0; i <= instances; ++i) {
            nearest = distance_at(1.0 * i / instances) < distance_at(1.0 * nearest / instances) ? i : nearest;
        }
        double low = std::max(nearest - 1.0, 0.0) / instances;
        double high = std::min(nearest + 1.0, 1.0 * instances) / instances;
        for (int i = 0; i < 40; ++i) {
            constexpr double golden = 0.6180339887498949;
            const double a = high - golden * (high - low), b = low + golden * (high - low);
            (distance_at(a) < distance_at(b) ? high : low) = distance_at(a) < distance_at(b) ? b : a;
        }
        least = std::min({least, distance_at(low), distance_at(1.0 * nearest / instances)});
    }
    return least;
}

TEST(Removal, EveryEndOfTheMaterialLiesOnATrueToolPosition) {
    for (const CutterShape& shape :
         {ball_6(),
          flat_6(),
          CutterShape{.kind = CutterKind::bull_nose, .diameter = 8.0, .corner_radius = 1.0, .length = 30.0},
          CutterShape{
              .kind = CutterKind::cone, .diameter = 6.0, .half_angle = from_degrees(30.0), .length = 30.0}}) {
        CutBlock cut(block(30.0, 20.0, 10.0), shape, 0.7);
        std::mt19937 engine(7);
        const auto between = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(engine);
        };
        std::vector<ToolPose> poses;
        for (int n = 0; n < 12; ++n) {
            poses.push_back({Vec3(between(0.0, 30.0), between(0.0, 20.0), between(-6.0, -0.5)),
                             Vec3(between(-0.4, 0.4), between(-0.4, 0.4), 1.0).normalized()});
        }
        cut.cut(poses);
        const Profile body = *toolpath::body_of(shape);
        int ends = 0;
        const DexelField& field = cut.field();
        for (int k = 0; k < 3; ++k) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            for (int j = 0; j < field.count()[static_cast<std::size_t>(v)]; j += 2) {
                for (int i = 0; i < field.count()[static_cast<std::size_t>(u)]; i += 2) {
                    for (const Dexel& piece : field.line(k, i, j)) {
                        for (const auto& [at, move] :
                             {std::pair(piece.from, piece.from_move), std::pair(piece.to, piece.to_move)}) {
                            if (move == stock_surface) {
                                continue;
                            }
                            ASSERT_LT(move, std::ssize(poses));
                            Vec3 place;
                            place[u] = field.middle(u, i);
                            place[v] = field.middle(v, j);
                            place[k] = field.box().min()[k] + static_cast<double>(at);
                            // Its own move made it, and no other goes deeper there.
                            const auto n = static_cast<std::size_t>(move);
                            EXPECT_NEAR(depth_in(body, {poses[n - 1], poses[n]}, place), 0.0, 2e-3);
                            EXPECT_GT(depth_in(body, poses, place), -2e-3);
                            ++ends;
                        }
                    }
                }
            }
        }
        EXPECT_GT(ends, 100);
    }
}

TEST(Removal, GivesTheSameBytesOnAnyNumberOfThreads) {
    const auto dexels_with = [](int threads) {
        set_thread_count(threads);
        CutBlock cut(block(30.0, 20.0, 10.0), ball_6(), 0.4);
        std::vector<ToolPose> poses;
        for (int n = 0; n < 60; ++n) {
            const double angle = 0.3 * n;
            poses.push_back({Vec3(15.0 + 10.0 * std::cos(angle), 10.0 + 7.0 * std::sin(angle), -0.05 * n),
                             Vec3(0.2 * std::sin(angle), 0.1, 1.0).normalized()});
        }
        cut.cut(poses);
        set_thread_count(0);
        std::vector<Dexel> all;
        const DexelField& field = cut.field();
        for (int k = 0; k < 3; ++k) {
            for (int j = 0; j < field.tile_count(k)[1]; ++j) {
                for (int i = 0; i < field.tile_count(k)[0]; ++i) {
                    const auto& dexels = field.tile(k, i, j).dexels;
                    all.insert(all.end(), dexels.begin(), dexels.end());
                }
            }
        }
        std::vector<double> volumes;
        for (const auto& [move, cut_by] : cut.removal().cuts()) {
            volumes.push_back(cut_by.volume);
        }
        return std::pair(all, volumes);
    };
    const auto one = dexels_with(1);
    EXPECT_EQ(one, dexels_with(2));
    EXPECT_EQ(one, dexels_with(3));
}

TEST(Removal, ReportsWhereARapidMetMaterial) {
    CutBlock cut(block(30.0, 20.0, 10.0), flat_6(), 0.5);
    cut.cut({{Vec3(-5.0, 10.0, -2.0), Vec3::UnitZ()}, {Vec3(15.0, 10.0, -2.0), Vec3::UnitZ()}}, true);
    const auto& cuts = cut.removal().cuts();
    ASSERT_EQ(cuts.size(), 1U);
    ASSERT_TRUE(cuts.begin()->second.contact.has_value());
    EXPECT_GT(cuts.begin()->second.contact->length, 1.0);
    EXPECT_LT(cuts.begin()->second.contact->place.x(), 18.0);
    EXPECT_GT(cuts.begin()->second.contact->place.z(), -2.0);
}

TEST(Removal, ARapidThatLeavesACutOrSlidesOnTheStockIsNoContact) {
    CutBlock cut(block(30.0, 20.0, 10.0), ball_6(), 0.3);
    const Vec3 axis = Vec3(0.1, 0.2, 1.0).normalized();
    const ToolPose end{Vec3(15.0, 10.0, -2.0), axis};
    cut.cut({{Vec3(5.0, 10.0, -2.0), axis}, end});
    cut.cut({end, {Vec3(end.tip + 20.0 * axis), axis}}, true);
    cut.cut({{Vec3(-5.0, 10.0, -0.005), Vec3::UnitZ()}, {Vec3(35.0, 10.0, -0.005), Vec3::UnitZ()}}, true);
    for (const auto& [move, made] : cut.removal().cuts()) {
        EXPECT_FALSE(made.contact.has_value());
    }
}

TEST(Removal, TheCoreOfACutterIsSmallerAllAround) {
    for (const CutterShape& shape :
         {ball_6(),
          flat_6(),
          CutterShape{.kind = CutterKind::bull_nose, .diameter = 8.0, .corner_radius = 1.0, .length = 30.0},
          CutterShape{.kind = CutterKind::cone,
          .diameter = 6.0,
          .corner_radius = 0.0,
          .half_angle = from_degrees(15.0),
          .length = 30.0},
          CutterShape{.kind = CutterKind::cone,
          .diameter = 6.0,
          .corner_radius = 0.004,
          .half_angle = from_degrees(15.0),
          .length = 30.0},
          CutterShape{.kind = CutterKind::cone,
          .diameter = 5.0,
          .corner_radius = 0.0,
          .half_angle = from_degrees(59.0),
          .length = 30.0}}) {
        const Profile body = *toolpath::body_of(shape);
        const CuttingBody cutter(body);
        for (const Vec2& point : Profile(cutter.core.shape()).outline(1e-4)) {
            const double depth = -body.near(point).distance;
            EXPECT_GT(depth, contact_depth - 1e-4)
                << static_cast<int>(shape.kind) << ' ' << point.transpose();
            // A tip is deeper by the normal of the axis; nothing else is by more than the rounding of a
            // corner.
            EXPECT_LT(depth, contact_depth * 1.5) << static_cast<int>(shape.kind) << ' ' << point.transpose();
        }
    }
}

TEST(Removal, SumsWhatEachMoveRemoved) {
    CutBlock cut(block(30.0, 20.0, 10.0), flat_6(), 0.1);
    cut.cut({{Vec3(-5.0, 10.05, -2.0), Vec3::UnitZ()},
             {Vec3(10.05, 10.05, -2.0), Vec3::UnitZ()},
             {Vec3(20.05, 10.05, -2.0), Vec3::UnitZ()}});
    double sum = 0.0;
    for (const auto& [move, made] : cut.removal().cuts()) {
        sum += made.volume;
    }
    EXPECT_EQ(cut.removal().cuts().size(), 2U);
    EXPECT_NEAR(cut.removal().cuts().at(2).volume, 10.0 * 6.0 * 2.0, 3.0);
    EXPECT_NEAR(sum, cut.removed(), 0.02 * sum);
}

TEST(Removal, StopsWhenCancelled) {
    std::stop_source source;
    source.request_stop();
    DexelField field(block(10.0, 10.0, 5.0), 0.5, removal_bytes, Progress());
    const CuttingBody cutter(*toolpath::body_of(ball_6()));
    std::vector<CutStep> steps;
    divide(cutter,
           {Vec3(0.0, 5.0, -1.0), Vec3::UnitZ()},
           {Vec3(10.0, 5.0, -1.0), Vec3::UnitZ()},
           0,
           false,
           steps);
    Removal removal(field);
    EXPECT_THROW(removal.remove(steps, Progress({}, source.get_token())), Cancelled);
}

} // namespace
} // namespace millwright::simulation
