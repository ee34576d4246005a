#include "app/plots/plot_points.h"

#include "app/plots/other_than_plot.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/plot/path_file.h"
#include "core/plot/point_file.h"
#include "core/plot/work_time.h"
#include "core/project/plot_input.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

std::vector<Vec3> points_of(const std::string& file) {
    plot::PointFile read = plot::read_points(read_file(file), file);
    for (std::size_t n = 1; n < read.diagnostics.size(); ++n) {
        fmt::print(stderr, "millwright: {}\n", to_text(read.diagnostics[n]));
    }
    if (!read.diagnostics.empty()) {
        throw Error(read.diagnostics.front());
    }
    if (read.points.empty()) {
        throw Error("it contains no points", file);
    }
    return std::move(read.points);
}

/// Of axis `k`, lowest and highest.
std::array<double, 2> range_of(const std::vector<Vec3>& points, Eigen::Index k) {
    const auto [low, high] = std::ranges::minmax_element(points, {}, [k](const Vec3& p) { return p[k]; });
    return {(*low)[k], (*high)[k]};
}

plot::WorkTime way_of(const std::vector<Vec3>& points, const plot::Strokes& strokes) {
    return plot::work_time(strokes, {}, points.front().head<2>(), points.back().head<2>());
}

} // namespace

bool is_point_file(const std::filesystem::path& file) {
    const std::string head = head_of_file(file);
    return plot::is_point_file(head) || (project::is_point_file(file) && !plot::is_path_file(head));
}

int points_info(const std::string& file, bool json) {
    const std::vector<Vec3> points = points_of(file);
    const plot::Strokes strokes = plot::strokes_of_points(points);
    const plot::WorkTime time = way_of(points, strokes);
    const auto x = range_of(points, 0), y = range_of(points, 1), z = range_of(points, 2);
    if (json) {
        const nlohmann::ordered_json answer = {{"points", points.size()},
                                               {"strokes", strokes.size()},
                                               {"extents_mm", {x[0], y[0], x[1], y[1]}},
                                               {"z_mm", z},
                                               {"draw_mm", time.cut_length},
                                               {"air_mm", time.travel_length},
                                               {"lifts", time.runs}};
        fmt::print("{}\n", answer.dump(2));
        return 0;
    }
    fmt::print("{} of a table, {}\n", counted(points.size(), "point"), counted(strokes.size(), "stroke"));
    fmt::print("x {:.3f} to {:.3f} mm, y {:.3f} to {:.3f} mm, z {:.3f} to {:.3f} mm\n",
               x[0],
               x[1],
               y[0],
               y[1],
               z[0],
               z[1]);
    fmt::print("{}\n", way_for_people(time));
    return 0;
}

int points_view(const std::string& file, plot::AirInSvg air, const std::string& out) {
    const std::vector<Vec3> points = points_of(file);
    const plot::Strokes strokes = plot::strokes_of_points(points);
    if (strokes.empty()) {
        throw Error("the points contain no cuts to draw", file);
    }
    write_file(out, plot::svg_text(strokes, air));
    fmt::print("{}, {}\n", counted(points.size(), "point"), counted(strokes.size(), "stroke"));
    return 0;
}

int points_toolpath(const std::string& file, const StrokeCutting& cutting) {
    const CuttingOptions& options = cutting.cutting;
    write_program(plot::path_of_points(points_of(file),
                                       {.cutting = from_mm_per_min(options.feed_mm_per_min),
                                        .plunging = from_mm_per_min(options.plunge_mm_per_min),
                                        .safe_height = options.safe_height}),
                  options,
                  {.kind = plot::TipKind::flat, .diameter = cutting.plan.tool_diameter},
                  {"points: " + std::filesystem::path(file).filename().string()});
    return 0;
}

} // namespace millwright::app
