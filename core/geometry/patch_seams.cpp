#include "core/geometry/patch_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

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

/// Where the sides of a patch end, and the box around that.
struct Ends {
    std::array<std::array<Vec3, 2>, sides.size()> of_side;
    Box3 box;
};

std::vector<Ends> ends_of(const std::vector<BezierPatch>& patches) {
    std::vector<Ends> ends(patches.size());
    for (std::size_t n = 0; n < patches.size(); ++n) {
        for (const Side side : sides) {
            for (const std::size_t end : {0U, 1U}) {
                const Vec2 uv = place_on(side, static_cast<double>(end));
                const Vec3 at = patches[n].position(uv.x(), uv.y());
                ends[n].of_side[static_cast<std::size_t>(side)][end] = at;
                ends[n].box.extend(at);
            }
        }
    }
    return ends;
}

/// Pairs of patches, the lower number first and in that order, whose sides can end within what both reach.
std::vector<std::pair<int, int>> near_pairs(const std::vector<Ends>& ends, const std::vector<double>& reach) {
    const auto at = [](const auto& of_patches, int n) -> const auto& {
        return of_patches[static_cast<std::size_t>(n)];
    };
    Box3 all;
    for (const Ends& of_patch : ends) {
        all.extend(of_patch.box);
    }
    int axis = 0;
    all.sizes().maxCoeff(&axis);
    const auto start = [&](int n) { return at(ends, n).box.min()[axis]; };
    std::vector<int> along(ends.size());
    std::iota(along.begin(), along.end(), 0);
    std::ranges::stable_sort(along, {}, start);
    std::vector<std::pair<int, int>> pairs;
    for (auto a = along.begin(); a != along.end(); ++a) {
        const double end = at(ends, *a).box.max()[axis] + at(reach, *a);
        for (auto b = a + 1; b != along.end() && start(*b) <= end; ++b) {
            if (at(ends, *a).box.exteriorDistance(at(ends, *b).box) <=
                std::min(at(reach, *a), at(reach, *b))) {
                pairs.push_back(std::minmax(*a, *b));
            }
        }
    }
    std::ranges::sort(pairs);
    return pairs;
}

/// Of every pair of sides of patches that are near enough, both ways round, those for which `close` is true.
template <typename Close>
std::vector<PossibleSeam>
possible_seams(const std::vector<BezierPatch>& patches, const std::vector<double>& reach, Close close) {
    const std::vector<Ends> ends = ends_of(patches);
    const auto ends_at = [&](const PatchSide& side) {
        return ends[static_cast<std::size_t>(side.patch)].of_side[static_cast<std::size_t>(side.side)];
    };
    std::vector<PossibleSeam> found;
    for (const auto& [a, b] : near_pairs(ends, reach)) {
        for (const Side of_a : sides) {
            for (const Side of_b : sides) {
                for (const bool reversed : {false, true}) {
                    const Seam seam{{a, of_a}, {b, of_b}, reversed};
                    const auto from = ends_at(seam.a), to = ends_at(seam.b);
                    const double distance = std::max((from[0] - to[reversed ? 1 : 0]).norm(),
                                                     (from[1] - to[reversed ? 0 : 1]).norm());
                    if (close(PossibleSeam{seam, distance})) {
                        found.push_back({seam, distance});
                    }
                }
            }
        }
    }
    return found;
}

/// Nearest first, no side twice nor in `taken`.
std::vector<Seam>
nearest_first(std::vector<PossibleSeam> found, const std::vector<Seam>& taken, std::size_t patches) {
    std::vector<std::array<bool, sides.size()>> in_one(patches);
    const auto is_in_one = [&](const PatchSide& side) -> bool& {
        return in_one[static_cast<std::size_t>(side.patch)][static_cast<std::size_t>(side.side)];
    };
    for (const Seam& seam : taken) {
        is_in_one(seam.a) = is_in_one(seam.b) = true;
    }
    std::ranges::stable_sort(found, {}, &PossibleSeam::distance);
    std::vector<Seam> seams;
    for (const auto& [seam, distance] : found) {
        if (!is_in_one(seam.a) && !is_in_one(seam.b)) {
            is_in_one(seam.a) = is_in_one(seam.b) = true;
            seams.push_back(seam);
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
    const std::vector<double> reach(patches.size(), tolerance);
    return nearest_first(possible_seams(patches, reach, close), {}, patches.size());
}

std::vector<Seam> open_seams_of(const std::vector<BezierPatch>& patches, const std::vector<Seam>& joined) {
    constexpr double share = 0.25;   // of the patches' lengths
    constexpr double same_way = 0.5; // cosine of 60 degrees
    std::vector<std::array<Surroundings, sides.size()>> around;
    std::vector<double> reach;
    for (const BezierPatch& patch : patches) {
        auto& of_patch = around.emplace_back();
        double& farthest = reach.emplace_back(0.0);
        for (const Side side : sides) {
            const Surroundings& beside = of_patch[static_cast<std::size_t>(side)] =
                surroundings_of(patch, side);
            farthest = std::max(farthest, share * beside.least);
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
    return nearest_first(possible_seams(patches, reach, faces), joined, patches.size());
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
