#include "core/geometry/patch_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace millwright::geometry {

namespace {

constexpr std::array sides{Side::u_start, Side::u_end, Side::v_start, Side::v_end};

/// Parameters at `t` along the side.
Vec2 place_on(Side side, double t) {
    switch (side) {
    case Side::u_start:
        return {0.0, t};
    case Side::u_end:
        return {1.0, t};
    case Side::v_start:
        return {t, 0.0};
    case Side::v_end:
        break;
    }
    return {t, 1.0};
}

Vec3 point_on(const std::vector<BezierPatch>& patches, const PatchSide& side, double t) {
    const Vec2 uv = place_on(side.side, t);
    return patches[static_cast<std::size_t>(side.patch)].position(uv.x(), uv.y());
}

struct PossibleSeam {
    Seam seam;
    double distance = 0.0; ///< of the ends, mm
};

/// Every pair of sides of two patches, both ways round.
std::vector<PossibleSeam> pairs_of_sides(const std::vector<BezierPatch>& patches, int a, int b) {
    std::vector<PossibleSeam> pairs;
    for (const Side of_a : sides) {
        for (const Side of_b : sides) {
            for (const bool reversed : {false, true}) {
                const Seam seam{{a, of_a}, {b, of_b}, reversed};
                const auto apart = [&](double t) {
                    return (point_on(patches, seam.a, t) - point_on(patches, seam.b, reversed ? 1.0 - t : t))
                        .norm();
                };
                pairs.push_back({seam, std::max(apart(0.0), apart(1.0))});
            }
        }
    }
    return pairs;
}

/// Those for which `close` is true.
template <typename Close>
std::vector<PossibleSeam> possible_seams(const std::vector<BezierPatch>& patches, Close close) {
    std::vector<PossibleSeam> found;
    const auto count = static_cast<int>(patches.size());
    for (int a = 0; a < count; ++a) {
        for (int b = a + 1; b < count; ++b) {
            std::ranges::copy_if(pairs_of_sides(patches, a, b), std::back_inserter(found), close);
        }
    }
    return found;
}

/// Nearest first, no side twice nor in `taken`.
std::vector<Seam> nearest_first(std::vector<PossibleSeam> found, const std::vector<Seam>& taken) {
    std::ranges::stable_sort(found, {}, &PossibleSeam::distance);
    std::vector<Seam> seams;
    for (const auto& [next, distance] : found) {
        const auto shares_a_side = [&next = next](const Seam& seam) {
            const auto has = [&](const PatchSide& side) { return seam.a == side || seam.b == side; };
            return has(next.a) || has(next.b);
        };
        if (std::ranges::none_of(seams, shares_a_side) && std::ranges::none_of(taken, shares_a_side)) {
            seams.push_back(next);
        }
    }
    return seams;
}

constexpr int places = 64; // of a side, along which it is measured

double length_of(const BezierPatch& patch, const Vec2& from, const Vec2& to) {
    double length = 0.0;
    Vec3 last = patch.position(from.x(), from.y());
    for (int k = 1; k <= places; ++k) {
        const Vec2 uv = from + static_cast<double>(k) / places * (to - from);
        const Vec3 next = patch.position(uv.x(), uv.y());
        length += (next - last).norm();
        last = next;
    }
    return length;
}

/// What a patch is beside one of its sides.
struct Surroundings {
    double least = 0.0;           ///< of its lengths along that side and across, through the middle, mm
    Vec3 outwards = Vec3::Zero(); ///< at its middle, a unit vector
};

Side opposite(Side side) {
    switch (side) {
    case Side::u_start:
        return Side::u_end;
    case Side::u_end:
        return Side::u_start;
    case Side::v_start:
        return Side::v_end;
    case Side::v_end:
        break;
    }
    return Side::v_start;
}

Surroundings surroundings_of(const BezierPatch& patch, Side side) {
    const Vec2 middle = place_on(side, 0.5);
    const Vec2 other = place_on(opposite(side), 0.5);
    const double along = length_of(patch, place_on(side, 0.0), place_on(side, 1.0));
    constexpr double near = 1.0 / places; // a bent patch goes another way at its other end
    const Vec2 inside = middle + near * (other - middle);
    const Vec3 way = patch.position(middle.x(), middle.y()) - patch.position(inside.x(), inside.y());
    return {.least = std::min(along, length_of(patch, other, middle)), .outwards = way.stableNormalized()};
}

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

} // namespace

std::string_view to_text(Side side) {
    switch (side) {
    case Side::u_start:
        return "u = 0";
    case Side::u_end:
        return "u = 1";
    case Side::v_start:
        return "v = 0";
    case Side::v_end:
        break;
    }
    return "v = 1";
}

std::vector<Seam> seams_of(const std::vector<BezierPatch>& patches, double tolerance) {
    const auto close = [tolerance](const PossibleSeam& pair) { return pair.distance <= tolerance; };
    return nearest_first(possible_seams(patches, close), {});
}

std::vector<Seam> open_seams_of(const std::vector<BezierPatch>& patches, const std::vector<Seam>& joined) {
    constexpr double share = 0.25;   // of the patches' lengths
    constexpr double same_way = 0.5; // cosine of 60 degrees
    std::vector<std::array<Surroundings, sides.size()>> around;
    for (const BezierPatch& patch : patches) {
        auto& of_patch = around.emplace_back();
        for (const Side side : sides) {
            of_patch[static_cast<std::size_t>(side)] = surroundings_of(patch, side);
        }
    }
    const auto beside = [&](const PatchSide& side) -> const Surroundings& {
        return around[static_cast<std::size_t>(side.patch)][static_cast<std::size_t>(side.side)];
    };
    const auto faces = [&](const PossibleSeam& pair) {
        const Surroundings& a = beside(pair.seam.a);
        const Surroundings& b = beside(pair.seam.b);
        return pair.distance <= share * std::min(a.least, b.least) && a.outwards.dot(b.outwards) < same_way;
    };
    return nearest_first(possible_seams(patches, faces), joined);
}

SeamFigures figures_of(const std::vector<BezierPatch>& patches, const Seam& seam) {
    SeamFigures figures;
    for (int k = 0; k <= places; ++k) {
        const double t = static_cast<double>(k) / places;
        const double of_b = seam.reversed ? 1.0 - t : t;
        figures.gap =
            std::max(figures.gap, (point_on(patches, seam.a, t) - point_on(patches, seam.b, of_b)).norm());
        const Vec2 at_a = place_on(seam.a.side, t);
        const Vec2 at_b = place_on(seam.b.side, of_b);
        const auto a = patches[static_cast<std::size_t>(seam.a.patch)].unit_normal(at_a.x(), at_a.y());
        const auto b = patches[static_cast<std::size_t>(seam.b.patch)].unit_normal(at_b.x(), at_b.y());
        if (a && b) { // which side is outside may differ from patch to patch
            figures.angle =
                std::max(figures.angle, std::min(angle_between(*a, *b), angle_between(*a, Vec3(-*b))));
        }
    }
    return figures;
}

} // namespace millwright::geometry
