// Any bytes are either finite points, in rows or as a cloud, with a finite surface, or an Error about the
// file.
#include "core/exchange/point_file.h"

#include "core/base/error.h"
#include "core/exchange/cloud_fit.h"
#include "core/exchange/grid_surface.h"
#include "core/exchange/point_rows.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace millwright;

constexpr std::size_t most_points_of_a_surface = 100; // more take a fuzzer too long

bool finite_net(const geometry::BezierPatch& patch) {
    const auto& points = patch.net().points;
    return std::all_of(points.begin(), points.end(), [](const Vec3& point) { return is_finite(point); });
}

/// The surface of sound points may be refused as well, in a sentence without a place.
void make_surface(const exchange::MeasuredPoints& measured) {
    try {
        if (auto grid = exchange::rows_of(measured, "part.csv")) {
            expects(std::ssize(grid->points) == std::ptrdiff_t{grid->rows} * grid->columns,
                    "rows are a raster");
            const auto surface = exchange::surface_through(std::move(*grid), std::nullopt, {});
            expects(std::all_of(surface.face.patches.begin(), surface.face.patches.end(), finite_net),
                    "a surface through finite points is finite");
            return;
        }
        const exchange::PointCloud cloud = exchange::cloud_of(measured);
        exchange::FitSettings settings;
        settings.degree_u = settings.degree_v = exchange::cloud_degree(cloud.points.size());
        expects(finite_net(exchange::fit_cloud(cloud.points, settings, {}).patch),
                "a patch near finite points is finite");
    } catch (const Error& error) {
        expects(!error.diagnostic().message.empty(), "an error says what is wrong");
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    try {
        const exchange::MeasuredPoints measured = exchange::parse_measured_points(bytes, "part.csv", {});
        expects(measured.points.size() == measured.lines.size(), "every point has its line");
        for (const Vec3& point : measured.points) {
            expects(is_finite(point), "a point is finite");
        }
        if (measured.points.size() <= most_points_of_a_surface) {
            make_surface(measured);
        }
    } catch (const Error& error) {
        expects(error.diagnostic().place.file == "part.csv", "an error of a file of points names it");
    }
    return 0;
}
