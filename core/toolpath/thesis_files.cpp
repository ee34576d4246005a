#include "core/toolpath/thesis_files.h"

#include "core/base/error.h"
#include "core/toolpath/actual_trajectory.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/tool_poses.h"
#include "core/toolpath/zigzag.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::toolpath {

namespace {

using kinematics::RotaryTilt;
using kinematics::RotaryTiltAngles;

constexpr double listing_pi = 22.0 / 7.0;

double listing_parameter(int i, int n) {
    return static_cast<double>(static_cast<float>(i) / static_cast<float>(n));
}

/// The zigzag order of the listing, odd tracks backwards, as indices into samples [nu x nv].
std::vector<std::size_t> zigzag_order(const ListingGrid& grid) {
    const bool along_v = grid.direction == grid::TrackDirection::along_v;
    const int tracks = along_v ? grid.nu : grid.nv, nodes = along_v ? grid.nv : grid.nu;
    std::vector<std::size_t> order;
    for (int track = 0; track < tracks; ++track) {
        for (int step = 0; step < nodes; ++step) {
            const int node = track % 2 == 0 ? step : nodes - 1 - step;
            const int i = along_v ? track : node, j = along_v ? node : track;
            order.push_back(static_cast<std::size_t>(i * grid.nv + j));
        }
    }
    return order;
}

/// Is A zero for the listing? It calls the integer absolute value, which truncates every |A| < 1 rad to 0.
bool counts_as_zero(double A, ListingFaults faults) {
    constexpr double threshold = 1e-8;
    const double shown = faults == ListingFaults::all ? std::trunc(A) : A;
    return std::abs(shown) < threshold;
}

/// Before interpolating, an A of zero takes the other end's A.
void substitute(RotaryTiltAngles& first, RotaryTiltAngles& second, ListingFaults faults) {
    if (counts_as_zero(first.A, faults)) {
        first.A = second.A;
    }
    if (counts_as_zero(second.A, faults)) {
        second.A = first.A;
    }
}

struct Contact {
    Vec3 point, normal;
};

std::vector<Contact> contacts(const geometry::ParametricSurface& patch, const ListingGrid& grid) {
    std::vector<Contact> result;
    for (int i = 0; i < grid.nu; ++i) {
        for (int j = 0; j < grid.nv; ++j) {
            const auto [position, normal] =
                patch.point(listing_parameter(i, grid.nu), listing_parameter(j, grid.nv));
            if (!normal) {
                throw Error(fmt::format("the surface has no normal at sample ({},{})", i, j));
            }
            result.push_back({position, grid.flipped ? Vec3(-*normal) : *normal});
        }
    }
    return result;
}

Vec3 mid_point(const RotaryTilt& machine, const Contact& from, const Contact& to, ListingFaults faults) {
    auto first = rotary_tilt_angles(kinematics::AngleMode::faulty_listing, from.normal);
    auto second = rotary_tilt_angles(kinematics::AngleMode::faulty_listing, to.normal);
    substitute(first, second, faults);
    const auto forward = faults == ListingFaults::all ? kinematics::faulty_listing_machine_from_workpiece
                                                      : kinematics::machine_from_workpiece;
    const Vec3 M = 0.5 * (forward(machine, from.point, first.A, first.B) +
                          forward(machine, to.point, second.A, second.B));
    return workpiece_from_machine(machine, M, 0.5 * (first.A + second.A), 0.5 * (first.B + second.B));
}

} // namespace

ObliqueView::ObliqueView(const std::vector<Vec3>& points) {
    expects(!points.empty(), "a view fits some points");
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : points) {
        mean += p;
    }
    mean /= static_cast<double>(points.size());
    const double c = std::cos(listing_pi / 6.0), s = std::sin(listing_pi / 6.0);
    const double across = mean.x() + mean.y() * c;
    const double up = mean.z() + mean.y() * s;
    constexpr double least = 1e-3; // mm: below it points are beyond any picture
    if (!(across > least && up > least)) {
        throw Error("the view of the thesis has no scale for this surface",
                    {},
                    "X + Y cos 30 and Z + Y sin 30 of its mean point must be above 0");
    }
    R_ = std::min(250.0 / across, 200.0 / up);
}

Eigen::Vector2i ObliqueView::pixel(const Vec3& p) const {
    const double c = std::cos(listing_pi / 6.0), s = std::sin(listing_pi / 6.0);
    return {static_cast<int>(10.0 + R_ * (p.x() + p.y() * c)),
            static_cast<int>(400.0 - R_ * (p.z() + p.y() * s))};
}

std::vector<Vec3> listing_samples(const geometry::ParametricSurface& patch, const ListingGrid& grid) {
    expects(grid.nu >= 2 && grid.nv >= 2, "the listing's grid has at least 2 x 2 points");
    std::vector<Vec3> samples;
    for (int i = 0; i < grid.nu; ++i) {
        for (int j = 0; j < grid.nv; ++j) {
            samples.push_back(patch.position(listing_parameter(i, grid.nu), listing_parameter(j, grid.nv)));
        }
    }
    return samples;
}

std::string surface_dat(const geometry::ParametricSurface& patch, const ListingGrid& grid) {
    const std::vector<Vec3> samples = listing_samples(patch, grid);
    const ObliqueView view(samples);
    const auto pixel = [&](int i, int j) {
        return view.pixel(samples[static_cast<std::size_t>(i * grid.nv + j)]);
    };
    std::string text;
    for (int i = 0; i < grid.nu; ++i) {
        for (int j = 0; j + 1 < grid.nv; ++j) {
            const auto a = pixel(i, j), b = pixel(i, j + 1);
            text += fmt::format("{} {} {} {}\n", a.x(), a.y(), b.x(), b.y());
        }
    }
    for (int j = 0; j < grid.nv; ++j) {
        for (int i = 0; i + 1 < grid.nu; ++i) {
            const auto a = pixel(i, j), b = pixel(i + 1, j);
            text += fmt::format("{} {} {} {} \n", a.x(), a.y(), b.x(), b.y());
        }
    }
    return text;
}

std::vector<Vec3> listing_mid_points(const geometry::ParametricSurface& patch,
                                     const RotaryTilt& machine,
                                     const ListingGrid& grid,
                                     ListingFaults faults) {
    const std::vector<Contact> at = contacts(patch, grid);
    const std::vector<std::size_t> order = zigzag_order(grid);
    std::vector<Vec3> result;
    for (std::size_t move = 1; move < order.size(); ++move) {
        result.push_back(mid_point(machine, at[order[move - 1]], at[order[move]], faults));
    }
    return result;
}

std::vector<Vec3> machine_mid_points(const geometry::ParametricSurface& patch,
                                     const kinematics::MachineModel& machine,
                                     const ListingGrid& grid) {
    grid::NodeArray nodes(grid.nu, grid.nv);
    for (int i = 0; i < grid.nu; ++i) {
        for (int j = 0; j < grid.nv; ++j) {
            nodes.at(i, j) = Vec2(listing_parameter(i, grid.nu), listing_parameter(j, grid.nv));
        }
    }
    const Toolpath path =
        on_machine(machine, zigzag(patch, grid::Grid(std::move(nodes)), grid.direction, grid.flipped));
    const AxisPath axes = sequence(machine, path);
    std::vector<Vec3> result;
    for (std::size_t move = 1; move < axes.positions.size(); ++move) {
        result.push_back(actual_pose(machine, axes.positions[move - 1], axes.positions[move], 0.5).tip);
    }
    return result;
}

std::string toolpath_dat(const geometry::ParametricSurface& patch,
                         const std::vector<Vec3>& middles,
                         const ListingGrid& grid) {
    const std::vector<Vec3> samples = listing_samples(patch, grid);
    const std::vector<std::size_t> order = zigzag_order(grid);
    expects(middles.size() + 1 == order.size(), "every move has its mid-point");
    const ObliqueView view(samples);
    std::string text;
    for (std::size_t move = 0; move < middles.size(); ++move) {
        const auto middle = view.pixel(middles[move]);
        const auto end = view.pixel(samples[order[move + 1]]);
        text += fmt::format("{} {} \n {} {}\n", middle.x(), middle.y(), end.x(), end.y());
    }
    return text;
}

} // namespace millwright::toolpath
