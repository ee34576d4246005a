#include "core/toolpath/thesis_files.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::toolpath {

namespace {

using kinematics::RotaryTilt;
using kinematics::RotaryTiltAngles;

constexpr double listing_pi = 22.0 / 7.0;

double listing_parameter(int i, int n) {
    return static_cast<double>(static_cast<float>(i) / static_cast<float>(n));
}

/// The zigzag order of the listing: inner index j, odd rows backwards. Flat indices i * n + j.
std::vector<int> zigzag_order(int n) {
    std::vector<int> order;
    for (int i = 0; i < n; ++i) {
        for (int step = 0; step < n; ++step) {
            order.push_back(i * n + (i % 2 == 0 ? step : n - 1 - step));
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

std::vector<Contact> contacts(const geometry::BezierPatch& patch, int n) {
    std::vector<Contact> result;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const auto at = patch.derivatives(listing_parameter(i, n), listing_parameter(j, n));
            const auto normal = patch.unit_normal(at);
            if (!normal) {
                throw Error(fmt::format("the surface has no normal at sample ({},{})", i, j));
            }
            result.push_back({at.position, *normal});
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
        throw Error("the thesis's view has no scale for this surface",
                    {},
                    "X + Y cos 30 and Z + Y sin 30 of its middle are above 0");
    }
    R_ = std::min(250.0 / across, 200.0 / up);
}

Eigen::Vector2i ObliqueView::pixel(const Vec3& p) const {
    const double c = std::cos(listing_pi / 6.0), s = std::sin(listing_pi / 6.0);
    return {static_cast<int>(10.0 + R_ * (p.x() + p.y() * c)),
            static_cast<int>(400.0 - R_ * (p.z() + p.y() * s))};
}

std::vector<Vec3> listing_samples(const geometry::BezierPatch& patch, int n) {
    std::vector<Vec3> samples;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            samples.push_back(patch.position(listing_parameter(i, n), listing_parameter(j, n)));
        }
    }
    return samples;
}

std::string surface_dat(const geometry::BezierPatch& patch, int n) {
    const std::vector<Vec3> samples = listing_samples(patch, n);
    const ObliqueView view(samples);
    const auto pixel = [&](int i, int j) { return view.pixel(samples[static_cast<std::size_t>(i * n + j)]); };
    std::string text;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j + 1 < n; ++j) {
            const auto a = pixel(i, j), b = pixel(i, j + 1);
            text += fmt::format("{} {} {} {}\n", a.x(), a.y(), b.x(), b.y());
        }
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i + 1 < n; ++i) {
            const auto a = pixel(i, j), b = pixel(i + 1, j);
            text += fmt::format("{} {} {} {} \n", a.x(), a.y(), b.x(), b.y());
        }
    }
    return text;
}

std::vector<Vec3> listing_mid_points(const geometry::BezierPatch& patch,
                                     const RotaryTilt& machine,
                                     int n,
                                     ListingFaults faults) {
    const std::vector<Contact> at = contacts(patch, n);
    const std::vector<int> order = zigzag_order(n);
    std::vector<Vec3> result;
    for (std::size_t move = 1; move < order.size(); ++move) {
        result.push_back(mid_point(machine,
                                   at[static_cast<std::size_t>(order[move - 1])],
                                   at[static_cast<std::size_t>(order[move])],
                                   faults));
    }
    return result;
}

std::string
toolpath_dat(const geometry::BezierPatch& patch, const RotaryTilt& machine, int n, ListingFaults faults) {
    const std::vector<Vec3> samples = listing_samples(patch, n);
    const ObliqueView view(samples);
    const std::vector<Vec3> middles = listing_mid_points(patch, machine, n, faults);
    const std::vector<int> order = zigzag_order(n);
    std::string text;
    for (std::size_t move = 0; move < middles.size(); ++move) {
        const auto middle = view.pixel(middles[move]);
        const auto end = view.pixel(samples[static_cast<std::size_t>(order[move + 1])]);
        text += fmt::format("{} {} \n {} {}\n", middle.x(), middle.y(), end.x(), end.y());
    }
    return text;
}

} // namespace millwright::toolpath
