#include "core/toolpath/internal/move_error.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/kinematics/forward.h"
#include "core/toolpath/internal/largest_angle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace millwright::toolpath {

namespace {

/// Where a deviation jumps, as an axis does when another point of the surface becomes the nearest, no halving
/// makes it known.
constexpr double shortest_stretch = 1.0 / 4096;

using Deviation = double Look::*;

double steepness(const std::vector<Look>& looks, std::size_t n, Deviation of) {
    const Look& a = looks[n];
    const Look& b = looks[n + 1];
    return std::abs(b.*of - a.*of) / (b.t - a.t);
}

/// Whether the stretch behind look `n` can hide a value above `known`.
bool may_hide(const std::vector<Look>& looks, std::size_t n, Deviation of, double bend, double known) {
    const double length = looks[n + 1].t - looks[n].t;
    double steepest = steepness(looks, n, of);
    if (n > 0) {
        steepest = std::max(steepest, steepness(looks, n - 1, of));
    }
    if (n + 2 < looks.size()) {
        steepest = std::max(steepest, steepness(looks, n + 1, of));
    }
    const double rise = std::max(length * length / 8.0 * bend, length / 2.0 * steepest);
    return std::max(looks[n].*of, looks[n + 1].*of) + rise > known;
}

double largest(const std::vector<Look>& looks, Deviation of) {
    double found = 0.0;
    for (const Look& look : looks) {
        found = std::max(found, look.*of);
    }
    return found;
}

/// A deviation as far as it is known.
struct Known {
    Deviation of;
    double bend;
    double most; ///< the largest seen, and what may be above it
};

/// The looks with one in the middle of each stretch that may hide something; no more of them if none does.
std::vector<Look>
finer(std::vector<Look> looks, const LookBend& bend, const std::function<Look(double)>& look_at) {
    const double closest = largest(looks, &Look::closest), param = largest(looks, &Look::param);
    const std::array known{Known{&Look::closest, bend.closest, closest + closest_tolerance(closest)},
                           Known{&Look::param, bend.param, param + param_tolerance(param)},
                           Known{&Look::axis, bend.axis, largest(looks, &Look::axis) + axis_tolerance()}};
    std::vector<Look> found;
    for (std::size_t n = 0; n + 1 < looks.size(); ++n) {
        const auto hides = [&](const Known& k) { return may_hide(looks, n, k.of, k.bend, k.most); };
        found.push_back(looks[n]);
        if (looks[n + 1].t - looks[n].t > shortest_stretch && std::ranges::any_of(known, hides)) {
            found.push_back(look_at(0.5 * (looks[n].t + looks[n + 1].t)));
        }
    }
    found.push_back(looks.back());
    return found;
}

} // namespace

double closest_tolerance(double largest) {
    constexpr double share = 1e-3, least = 1e-4, most = 1e-3;
    return std::clamp(share * largest, least, most);
}

double param_tolerance(double largest) {
    constexpr double share = 1e-2, least = 1e-3, most = 1e-2;
    return std::clamp(share * largest, least, most);
}

double axis_tolerance() {
    return from_degrees(1e-3);
}

std::vector<Look> looks_until_known(const Look& begin,
                                    const Look& end,
                                    int parts,
                                    const LookBend& bend,
                                    const std::function<Look(double)>& look_at) {
    std::vector<Look> looks{begin};
    for (int k = 1; k < parts; ++k) {
        looks.push_back(look_at(static_cast<double>(k) / parts));
    }
    looks.push_back(end);
    for (std::size_t before = 0; before != looks.size();) {
        before = looks.size();
        looks = finer(std::move(looks), bend, look_at);
    }
    return looks;
}

grid::MoveError move_error(const kinematics::MachineModel& machine,
                           const kinematics::AxisPositions& from,
                           const kinematics::AxisPositions& to,
                           const ChordCurve& curve,
                           int tip_samples) {
    const kinematics::StraightForward way(machine, from, to);
    double tip = 0.0; // squares
    double off_surface = 0.0;
    double param = 0.0;
    LargestAngle axis;
    for (int k = 1; k <= tip_samples; ++k) {
        const double t = static_cast<double>(k) / (tip_samples + 1);
        const geometry::ToolPose actual = way.at(t);
        const ChordCurve::Nearest nearest = curve.nearest(actual.tip);
        const double normal = nearest.normal.squaredNorm(); // 0 where those of the chord's ends cancel
        const double off = square((actual.tip - nearest.point).dot(nearest.normal));
        tip = std::max(tip, nearest.squared);
        off_surface = normal > 0.0 ? std::max(off_surface, off / normal) : off_surface;
        param = std::max(param, (actual.tip - curve.at(t)).squaredNorm());
        axis.see(actual.axis, nearest.normal);
    }
    return {.tip = std::sqrt(tip),
            .axis = axis.angle(),
            .length = curve.length(),
            .off_surface = std::sqrt(off_surface),
            .param = std::sqrt(param)};
}

} // namespace millwright::toolpath
