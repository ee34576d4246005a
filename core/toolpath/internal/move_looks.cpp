#include "core/toolpath/internal/move_looks.h"

#include "core/base/units.h"

#include <algorithm>
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

/// The looks with one in the middle of each stretch that may hide something; no more of them if none does.
std::vector<Look>
finer(std::vector<Look> looks, const LookBend& bend, const std::function<Look(double)>& look_at) {
    const double most = largest(looks, &Look::closest);
    const double known = most + closest_tolerance(most);
    const double known_axis = largest(looks, &Look::axis) + axis_tolerance();
    std::vector<Look> found;
    for (std::size_t n = 0; n + 1 < looks.size(); ++n) {
        found.push_back(looks[n]);
        if (looks[n + 1].t - looks[n].t > shortest_stretch &&
            (may_hide(looks, n, &Look::closest, bend.closest, known) ||
             may_hide(looks, n, &Look::axis, bend.axis, known_axis))) {
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

} // namespace millwright::toolpath
