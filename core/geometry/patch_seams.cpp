#include "core/geometry/patch_seams.h"

#include <algorithm>
#include <array>
#include <cmath>

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

void add_possible_seams(std::vector<PossibleSeam>& found,
                        const std::vector<BezierPatch>& patches,
                        int a,
                        int b,
                        double tolerance) {
    for (const Side of_a : sides) {
        for (const Side of_b : sides) {
            for (const bool reversed : {false, true}) {
                const Seam seam{{a, of_a}, {b, of_b}, reversed};
                const auto apart = [&](double t) {
                    return (point_on(patches, seam.a, t) - point_on(patches, seam.b, reversed ? 1.0 - t : t))
                        .norm();
                };
                if (const double distance = std::max(apart(0.0), apart(1.0)); distance <= tolerance) {
                    found.push_back({seam, distance});
                }
            }
        }
    }
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
    std::vector<PossibleSeam> found;
    const auto count = static_cast<int>(patches.size());
    for (int a = 0; a < count; ++a) {
        for (int b = a + 1; b < count; ++b) {
            add_possible_seams(found, patches, a, b, tolerance);
        }
    }
    std::ranges::stable_sort(found, {}, &PossibleSeam::distance);
    std::vector<Seam> seams;
    for (const PossibleSeam& next : found) {
        const auto taken = [&](const Seam& seam) {
            const auto has = [&](const PatchSide& side) { return seam.a == side || seam.b == side; };
            return has(next.seam.a) || has(next.seam.b);
        };
        if (std::ranges::none_of(seams, taken)) {
            seams.push_back(next.seam);
        }
    }
    return seams;
}

SeamFigures figures_of(const std::vector<BezierPatch>& patches, const Seam& seam) {
    constexpr int places = 64;
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
