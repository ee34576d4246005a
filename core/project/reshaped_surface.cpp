#include "core/project/reshaped_surface.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace millwright::project {

namespace {

using geometry::BezierPatch;
using geometry::Parameter;
using geometry::Trim;

BezierPatch patch_of(const SurfaceInput& surface, int patch) {
    if (patch < 0 || patch >= std::ssize(surface.patches)) {
        throw Error(fmt::format(
            "there is no patch {}: the design has {}, counted from 0", patch, surface.patches.size()));
    }
    return BezierPatch(surface.patches[static_cast<std::size_t>(patch)]);
}

/// What is left of it on the part [from, to] of the parameter; nothing: nothing.
std::optional<Trim> trim_in(const Trim& trim, Parameter parameter, double from, double to) {
    if (trim.everything()) {
        return trim;
    }
    const int axis = parameter == Parameter::u ? 0 : 1;
    std::vector<Trim::Loop> loops = trim.loops;
    for (Trim::Loop& loop : loops) {
        for (Vec2& place : loop) {
            place[axis] = (place[axis] - from) / (to - from);
        }
    }
    return geometry::trim_in_square(loops, Vec2::Zero());
}

} // namespace

SurfaceInput with_degrees(SurfaceInput surface, int patch, int degree_u, int degree_v) {
    const BezierPatch before = patch_of(surface, patch);
    if (degree_u < before.degree_u() || degree_v < before.degree_v()) {
        throw Error(fmt::format("patch {} is of degree {} x {}: a lower one would change its shape",
                                patch,
                                before.degree_u(),
                                before.degree_v()));
    }
    if (degree_u > geometry::max_degree || degree_v > geometry::max_degree) {
        throw Error(fmt::format(
            "degree {} x {} is too high: {} is the highest", degree_u, degree_v, geometry::max_degree));
    }
    surface.patches[static_cast<std::size_t>(patch)] = geometry::elevated(before, degree_u, degree_v).net();
    return surface;
}

SurfaceInput with_split(SurfaceInput surface, int patch, Parameter parameter, double at) {
    const BezierPatch whole = patch_of(surface, patch);
    if (!(at >= narrowest_split && at <= 1.0 - narrowest_split)) {
        throw Error(fmt::format(
            "a patch is split between {} and {}, not at {:.4g}", narrowest_split, 1.0 - narrowest_split, at));
    }
    const auto [before, behind] = geometry::split(whole, parameter, at);
    const Trim trim = surface.trim(patch);
    const auto n = static_cast<std::ptrdiff_t>(patch);
    surface.trims.resize(surface.patches.size());
    surface.patches.erase(surface.patches.begin() + n);
    surface.trims.erase(surface.trims.begin() + n);
    std::ptrdiff_t put = n;
    const auto add = [&](const BezierPatch& half, const std::optional<Trim>& left) {
        if (left) {
            surface.patches.insert(surface.patches.begin() + put, half.net());
            surface.trims.insert(surface.trims.begin() + put, *left);
            ++put;
        }
    };
    add(before, trim_in(trim, parameter, 0.0, at));
    add(behind, trim_in(trim, parameter, at, 1.0));
    if (surface.machined_patch > patch) {
        surface.machined_patch += static_cast<int>(put - n) - 1;
    }
    if (std::ranges::all_of(surface.trims, &Trim::everything)) {
        surface.trims.clear();
    }
    surface.preset.clear();
    return surface;
}

} // namespace millwright::project
