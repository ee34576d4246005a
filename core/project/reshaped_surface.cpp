#include "core/project/reshaped_surface.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/project/internal/region_area.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace millwright::project {

namespace {

using geometry::BezierPatch;
using geometry::Parameter;
using geometry::Trim;

BezierPatch patch_of(const SurfaceInput& surface, int patch) {
    if (!surface.has_patches()) {
        throw Error(surface.joined
                        ? "the surface is several exact faces without patches: their control points stay as "
                          "they are"
                        : "the surface is an exact face without patches: its control points stay as they are",
                    {},
                    "import it without --exact to change its patches");
    }
    if (patch < 0 || patch >= std::ssize(surface.patches)) {
        throw Error(
            fmt::format("no patch {}; the design has {}, numbered from 0", patch, surface.patches.size()));
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

/// The part [from, to] of a parameter.
struct Part {
    Parameter parameter;
    double from, to;

    [[nodiscard]] int axis() const { return parameter == Parameter::u ? 0 : 1; }
    [[nodiscard]] double length() const { return to - from; }
};

grid::Field field_on(const grid::Field& whole, const Part& part) {
    grid::Field field = whole;
    for (int i = 0; i < field.rows; ++i) {
        for (int j = 0; j < field.columns; ++j) {
            Vec2 place = whole.place(i, j);
            place[part.axis()] = part.from + place[part.axis()] * part.length();
            field.values[field.index(i, j)] = whole.at(place);
        }
    }
    return field;
}

/// What of a polygon lies on the side of `limit` where `sign` * (its coordinate - limit) <= 0 (Sutherland and
/// Hodgman, Reentrant polygon clipping, 1974; by the even-odd rule it may cross itself).
std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, int axis, double limit, double sign) {
    std::vector<Vec2> left;
    for (std::size_t n = 0; n < polygon.size(); ++n) {
        const Vec2& a = polygon[n];
        const Vec2& b = polygon[(n + 1) % polygon.size()];
        const double beyond_a = sign * (a[axis] - limit), beyond_b = sign * (b[axis] - limit);
        if (beyond_a <= 0.0) {
            left.push_back(a);
        }
        if ((beyond_a < 0.0 && beyond_b > 0.0) || (beyond_a > 0.0 && beyond_b < 0.0)) {
            left.emplace_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
        }
    }
    return left;
}

/// Only its outline changes.
grid::Region region_on(grid::Region region, const Part& part) {
    std::vector<Vec2> outline = clipped(region.outline, part.axis(), part.to, 1.0);
    outline = clipped(outline, part.axis(), part.from, -1.0);
    for (Vec2& corner : outline) {
        corner[part.axis()] = std::clamp((corner[part.axis()] - part.from) / part.length(), 0.0, 1.0);
    }
    if (std::ssize(outline) > grid::most_corners) {
        throw Error(
            fmt::format("the outline of the region would have more than {} corners", grid::most_corners));
    }
    const bool anything = std::ssize(outline) >= grid::fewest_corners && encloses_area(outline);
    region.outline = anything ? std::move(outline) : std::vector<Vec2>();
    return region;
}

struct SineAndCosine {
    double sine, cosine;
};

/// Exact at quarter turns: a part laid on its back lies there without a rounding.
SineAndCosine sine_and_cosine(double degrees) {
    constexpr std::array<SineAndCosine, 4> quarters{{{0.0, 1.0}, {1.0, 0.0}, {0.0, -1.0}, {-1.0, 0.0}}};
    const double turn = degrees - 360.0 * std::floor(degrees / 360.0);
    const double quarter = turn / 90.0;
    if (exactly_equal(quarter, std::floor(quarter))) {
        return quarters[static_cast<std::size_t>(quarter) % quarters.size()];
    }
    return {std::sin(from_degrees(turn)), std::cos(from_degrees(turn))};
}

} // namespace

SurfaceInput with_degrees(SurfaceInput surface, int patch, int degree_u, int degree_v) {
    const BezierPatch before = patch_of(surface, patch);
    if (degree_u < before.degree_u() || degree_v < before.degree_v()) {
        throw Error(fmt::format("patch {} has degree {} x {}: a lower degree would change its shape",
                                patch,
                                before.degree_u(),
                                before.degree_v()));
    }
    if (degree_u > geometry::max_degree || degree_v > geometry::max_degree) {
        throw Error(fmt::format(
            "degree {} x {} is too high: the maximum is {}", degree_u, degree_v, geometry::max_degree));
    }
    surface.patches[static_cast<std::size_t>(patch)] = geometry::elevated(before, degree_u, degree_v).net();
    return surface;
}

SurfaceInput with_turn(SurfaceInput surface, const Vec3& degrees) {
    if (!degrees.allFinite()) {
        throw Error("a rotation angle of the part is not finite");
    }
    for (int axis = 0; axis < 3; ++axis) {
        const auto [sine, cosine] = sine_and_cosine(degrees[axis]);
        const int first = (axis + 1) % 3, second = (axis + 2) % 3;
        const auto turn = [first, second, sine = sine, cosine = cosine](std::vector<Vec3>& points) {
            for (Vec3& point : points) {
                const double a = point[first], b = point[second];
                point[first] = cosine * a - sine * b + 0.0; // no -0
                point[second] = sine * a + cosine * b + 0.0;
            }
        };
        for (geometry::ControlNet& net : surface.patches) {
            turn(net.points);
        }
        for (FaceInput* face : surface.exact_faces()) {
            turn(face->net.points);
        }
        if (surface.joined && surface.joined->corners) {
            auto& corners = *surface.joined->corners;
            std::vector<Vec3> places(corners.begin(), corners.end());
            turn(places);
            std::copy(places.begin(), places.end(), corners.begin());
        }
    }
    if (!degrees.isZero(0.0)) {
        surface.preset.clear();
    }
    return surface;
}

SurfaceInput with_split(SurfaceInput surface, int patch, Parameter parameter, double at) {
    const BezierPatch whole = patch_of(surface, patch);
    if (!(at >= narrowest_split && at <= 1.0 - narrowest_split)) {
        throw Error(fmt::format("a patch can be split between {} and {}, not at {:.4g}",
                                narrowest_split,
                                1.0 - narrowest_split,
                                at));
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

Project with_split(Project project, int patch, Parameter parameter, double at) {
    const bool machined = patch == project.surface.machined_patch;
    const Trim trim = project.surface.trim(patch);
    project.surface = with_split(std::move(project.surface), patch, parameter, at);
    if (machined) {
        const bool first = trim_in(trim, parameter, 0.0, at).has_value();
        const Part part = first ? Part{parameter, 0.0, at} : Part{parameter, at, 1.0};
        EllipticInput& elliptic = project.grid.elliptic;
        if (elliptic.painted) {
            elliptic.painted = field_on(*elliptic.painted, part);
        }
        elliptic.region = region_on(std::move(elliptic.region), part);
    }
    return project;
}

} // namespace millwright::project
