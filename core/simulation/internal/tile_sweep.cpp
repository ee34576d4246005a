#include "core/simulation/internal/tile_sweep.h"

#include "core/base/units.h"

#include <algorithm>
#include <cmath>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace millwright::simulation {

namespace {

// NOLINTNEXTLINE(modernize-avoid-c-arrays)
using OutlineNormals = double[SweptOutline::directions][2];

struct OutlineDirections {
    OutlineDirections() {
        for (std::size_t n = 0; n < SweptOutline::directions; ++n) {
            const double angle = pi * static_cast<double>(n) / static_cast<double>(SweptOutline::directions);
            normals[n][0] = std::cos(angle);
            normals[n][1] = std::sin(angle);
        }
    }
    OutlineNormals normals{};
};

/// How far the body reaches from its tip in a direction whose cosine with the axis is `cosine`, or a little
/// more.
double reach(const BodyZones& zones, double cosine) {
    const toolpath::ProfileShape& shape = zones.shape;
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    return std::max({cosine * zones.center + sine * shape.flat + shape.corner,
                     cosine * zones.flank_end + sine * shape.radius,
                     cosine * shape.top + sine * shape.radius});
}

} // namespace

// NOLINTNEXTLINE(modernize-avoid-c-arrays)
const double (&SweptOutline::normals())[directions][2] {
    static const OutlineDirections made;
    return made.normals;
}

bool SweptOutline::meets_rectangle(double u, double v, double half_u, double half_v) const {
    const auto& along = normals();
    for (std::size_t n = 0; n < directions; ++n) {
        const double at = along[n][0] * u + along[n][1] * v;
        const double half = std::abs(along[n][0]) * half_u + std::abs(along[n][1]) * half_v;
        if (at + half < low[n] || at - half > high[n]) {
            return false;
        }
    }
    return true;
}

TileMotion::TileMotion(const BodyZones& of, const StepMotion& motion, int k)
    : zones(&of), turn(motion.turn), bend(motion.bend), moves(motion.moves) {
    for (std::size_t n = 0; n < 3; ++n) {
        const int from = (k + 1 + static_cast<int>(n)) % 3;
        tip[n] = motion.tip[from];
        way[n] = motion.way[from];
        middle[n] = motion.middle[from];
        across[n] = motion.across[from];
    }
    const double c = std::cos(0.5 * turn), s = std::sin(0.5 * turn);
    // Between its ends a point of the body bulges by no more than turn^2 / 8 of its distance from the tip.
    const double far = std::max(std::abs(of.shape.top), std::abs(of.shape.bottom)) + of.shape.radius;
    constexpr double rounding = 1e-9; // mm
    const double bulge = 0.125 * turn * turn * far + rounding;
    for (std::size_t n = 0; n < SweptOutline::directions; ++n) {
        const auto& [nu, nv] = SweptOutline::normals()[n];
        double high = -missed, low = missed;
        for (const double sense : {-1.0, 1.0}) {
            const double f = sense > 0.0 ? 1.0 : 0.0;
            const double at = nu * (tip[0] + f * way[0]) + nv * (tip[1] + f * way[1]);
            const double cosine =
                nu * (c * middle[0] + sense * s * across[0]) + nv * (c * middle[1] + sense * s * across[1]);
            high = std::max(high, at + reach(of, cosine));
            low = std::min(low, at - reach(of, -cosine));
        }
        outline.low[n] = low - bulge;
        outline.high[n] = high + bulge;
    }
}

namespace {

#define LANES_NAME registers_of_2
#define LANES_WIDTH 2
#include "core/simulation/internal/tile_sweep.inc"
#undef LANES_NAME
#undef LANES_WIDTH

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define LANES_WIDE
#pragma GCC push_options
#pragma GCC target("avx2")
#define LANES_NAME registers_of_4
#define LANES_WIDTH 4
#include "core/simulation/internal/tile_sweep.inc"
#undef LANES_NAME
#undef LANES_WIDTH
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl")
#define LANES_NAME registers_of_8
#define LANES_WIDTH 8
#include "core/simulation/internal/tile_sweep.inc"
#undef LANES_NAME
#undef LANES_WIDTH
#pragma GCC pop_options
#endif

std::vector<TileSweep> runnable_sweeps() {
    std::vector<TileSweep> found{
        {registers_of_2::outline, registers_of_2::look, registers_of_2::attempt, registers_of_2::search, 2}};
#if defined(LANES_WIDE)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2")) {
        found.push_back({registers_of_4::outline,
                         registers_of_4::look,
                         registers_of_4::attempt,
                         registers_of_4::search,
                         4});
    }
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl")) {
        found.push_back({registers_of_8::outline,
                         registers_of_8::look,
                         registers_of_8::attempt,
                         registers_of_8::search,
                         8});
    }
#endif
    return found;
}

} // namespace

std::span<const TileSweep> tile_sweeps() {
    static const std::vector<TileSweep> found = runnable_sweeps();
    return found;
}

const TileSweep& tile_sweep() {
    return tile_sweeps().back();
}

} // namespace millwright::simulation
