// A table that plays a plot cuts what the plot's program cuts.
#include "core/jobs/point_job.h"

#include "core/plot/decode.h"
#include "core/program/program.h"
#include "tests/support/machines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace millwright::jobs {
namespace {

using testing::HasSubstr;

std::shared_ptr<const kinematics::MachineModel> forming_table() {
    return std::make_shared<const kinematics::MachineModel>(test::machine("forming-table"));
}

/// Six squares beside each other, a pen each.
plot::Strokes six_squares() {
    plot::Strokes strokes;
    for (int pen = 1; pen <= 6; ++pen) {
        const double x = 10.0 * pen;
        strokes.push_back(
            {.pen = pen, .points = {{x, 10.0}, {x + 7.0, 10.0}, {x + 7.0, 17.0}, {x, 17.0}, {x, 10.0}}});
    }
    return strokes;
}

/// Backwards, pens 2 and 5 off, each at a depth of its own, the last two with another tool.
plot::CutPath six_levels() {
    plot::CutSettings settings;
    settings.levels = plot::levels_for(six_squares());
    for (plot::Level& level : settings.levels) {
        level.enabled = level.pen != 2 && level.pen != 5;
        level.order = -level.pen;
        level.depth = 0.5 * level.pen;
        level.tool = level.pen < 4 ? 2 : 1;
    }
    return plot::cut_path(six_squares(), settings);
}

Job played(const plot::CutPath& path, plot::DecodeMode mode, const std::optional<Vec3>& start = {}) {
    PathPoints settings{.decoding = {.velocity = 8.0, .period = 0.02, .plunge_velocity = 5.0, .mode = mode},
                        .start = start};
    return path_points_job(path, "six.plt", forming_table(), settings);
}

// It played the strokes at Z 0, in the order of the file, pens that are off too.
TEST(PointJob, PlaysTheStrokesOrderDepthsAndToolsOfTheProgram) {
    const Job job = played(six_levels(), plot::DecodeMode::segments);
    const drivers::PointTrack& track = *job.points;
    ASSERT_EQ(track.points.size(), track.blocks.size());
    EXPECT_TRUE(std::ranges::is_sorted(track.blocks));
    int moves = 0;
    for (int n = 0; n < job.program->block_count(); ++n) {
        const program::Block& block = job.program->blocks[static_cast<std::size_t>(n)];
        const auto after = std::ranges::upper_bound(track.blocks, n);
        const auto last = after - track.blocks.begin() - 1;
        if (!block.moves()) {
            continue;
        }
        ++moves;
        ASSERT_GE(last, 0) << n;
        const Vec3& point = track.points[static_cast<std::size_t>(last)];
        const auto coordinate = [&](char letter) { return block.target[job.machine->axis_index(letter)]; };
        const Vec3 target(coordinate('X'), coordinate('Y'), coordinate('Z'));
        EXPECT_NEAR((point - target).norm(), 0.0, 1e-4) << n;
    }
    EXPECT_GT(moves, 4 * 6);
    std::vector<int> columns; // of the squares, as they are cut
    double lowest = 0.0;
    for (const Vec3& point : track.points) {
        if (point.z() < -0.01) {
            const int column = static_cast<int>(std::floor(point.x() / 10.0));
            EXPECT_GE(point.z(), -0.5 * column - 1e-9);
            lowest = std::min(lowest, point.z());
            if (columns.empty() || columns.back() != column) {
                columns.push_back(column);
            }
        }
    }
    EXPECT_THAT(columns, testing::ElementsAre(6, 4, 3, 1));
    EXPECT_NEAR(lowest, -3.0, 1e-12);
}

TEST(PointJob, RestsAtItsFirstToolAndWhereTheToolChanges) {
    const Job job = played(six_levels(), plot::DecodeMode::path);
    const drivers::PointTrack& track = *job.points;
    ASSERT_EQ(track.stops.size(), 2U);
    EXPECT_EQ(track.stops[0].before, 0U);
    EXPECT_THAT(track.stops[0].why, HasSubstr("put in tool 1"));
    EXPECT_THAT(track.stops[1].why, HasSubstr("change to tool 2 at line "));
    const std::size_t change = track.stops[1].before;
    ASSERT_GT(change, 0U);
    EXPECT_EQ(track.points[change - 1], Vec3(0.0, 0.0, 25.0)); // the change position
    const auto cuts = [](const Vec3& point) { return point.z() < 0.0; };
    const auto begin = track.points.begin();
    const auto at = begin + static_cast<std::ptrdiff_t>(change);
    EXPECT_TRUE(std::all_of(begin, at, [&](const Vec3& point) { return !cuts(point) || point.x() > 39.0; }));
    EXPECT_TRUE(std::all_of(
        at, track.points.end(), [&](const Vec3& point) { return !cuts(point) || point.x() < 38.0; }));
}

TEST(PointJob, GoesUpBeforeAcrossFromWhereTheTableIs) {
    const Vec3 start(30.0, 40.0, -1.0);
    const Job job = played(six_levels(), plot::DecodeMode::path, start);
    const std::vector<Vec3>& points = job.points->points;
    EXPECT_EQ(points.front(), start);
    const auto leaves = std::ranges::find_if(
        points, [&](const Vec3& point) { return (point - start).head<2>().norm() > 0.0; });
    ASSERT_NE(leaves, points.end());
    EXPECT_EQ((leaves - 1)->z(), 5.0);
    EXPECT_EQ(played(six_levels(), plot::DecodeMode::path).points->points.front(), Vec3(0.0, 0.0, 5.0));
    EXPECT_TRUE(preflight(job).empty());
}

TEST(PointJob, PointsOutsideTheTableAreRefusedWithTheLineOfTheirBlock) {
    plot::CutPath path = six_levels();
    for (plot::CutPoint& point : path) {
        point.at.x() += 440.0;
    }
    const auto faults = preflight(played(path, plot::DecodeMode::path));
    ASSERT_FALSE(faults.empty());
    EXPECT_THAT(faults.front().message, HasSubstr("axis X would move to 48"));
    EXPECT_GT(faults.front().place.line, 1);
    EXPECT_EQ(faults.front().place.file, "six.plt");
}

TEST(PointJob, EachPointOfAFileIsABlockOnItsLine) {
    const std::string text = "0,0,5\n\n0.1,0,5\n0.2,0,5\n";
    const auto read = plot::read_points(text, "p.csv");
    const Job job = point_file_job(text, read, "p.csv", forming_table(), 0.02);
    EXPECT_EQ(job.block_count(), 3);
    EXPECT_EQ(job.listing->line_of_block, (std::vector<int>{1, 3, 4}));
    EXPECT_EQ(job.points->points, read.points);
    EXPECT_NEAR(job.points->duration(), 0.04, 1e-12);
    EXPECT_TRUE(preflight(job).empty());
    const auto far = plot::read_points("0,0,5\n\n500,0,5\n", "p.csv");
    const auto faults = preflight(point_file_job("0,0,5\n\n500,0,5\n", far, "p.csv", forming_table(), 100.0));
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults.front().place.line, 3);
    EXPECT_THROW((void)point_file_job("", {}, "p.csv", forming_table(), 0.02), Error);
}

} // namespace
} // namespace millwright::jobs
