// The steps of a batch of rotations with the vectors in registers from the first step to the last. Included
// by each source file that is compiled for an instruction set of its own; everything here is local to that
// file, so that the linker cannot take the code of one for the other.
#pragma once

#include <cstddef>
#include <cstdint>

namespace millwright::cordic::internal {

/// Steps and corrections as a batch needs them. Shifts are 0 to 31.
struct BatchSteps {
    const std::int32_t* shifts = nullptr;
    const std::int32_t* angles = nullptr;
    int step_count = 0;
    const std::int32_t* corrections = nullptr; ///< negative: subtracts; 0 does nothing
    int correction_count = 0;
    bool circular = true; ///< else linear
};

/// Rotates `count` vectors in place, a multiple of the number that goes at a time. Nothing may overflow.
using BatchLoop = void (*)(
    const BatchSteps& steps, std::int32_t* x, std::int32_t* y, std::int32_t* z, std::ptrdiff_t count);

/// How many vectors a loop takes at a time.
inline constexpr int portable_batch = 8;
inline constexpr int avx2_batch = 16;

/// For a processor with AVX2; nullptr if the compiler made none.
[[nodiscard]] BatchLoop avx2_batch_loop();

namespace {

/// A register full of numbers.
template <int lanes> struct Register32 {
    typedef std::int32_t Lanes __attribute__((vector_size(lanes * sizeof(std::int32_t)))); // NOLINT
};

template <class Lanes> struct LaneVectors {
    Lanes x, y, z;

    void load(const std::int32_t* from_x, const std::int32_t* from_y, const std::int32_t* from_z) {
        __builtin_memcpy(&x, from_x, sizeof x);
        __builtin_memcpy(&y, from_y, sizeof y);
        __builtin_memcpy(&z, from_z, sizeof z);
    }
    void store(std::int32_t* to_x, std::int32_t* to_y, std::int32_t* to_z) const {
        __builtin_memcpy(to_x, &x, sizeof x);
        __builtin_memcpy(to_y, &y, sizeof y);
        __builtin_memcpy(to_z, &z, sizeof z);
    }
    /// (v ^ m) - m with m = 0 or -1 is v or -v: steps of both senses without a branch.
    template <bool circular> void turn(int shift, const Lanes& angle) {
        const Lanes m = z >> 31; // -1 for a negative angle
        const Lanes dx = ((y >> shift) ^ m) - m;
        const Lanes dy = ((x >> shift) ^ m) - m;
        if constexpr (circular) {
            x -= dx;
        }
        y += dy;
        z -= (angle ^ m) - m;
    }
    void correct(int shift, bool subtracts) {
        if (subtracts) {
            x -= x >> shift;
            y -= y >> shift;
        } else {
            x += x >> shift;
            y += y >> shift;
        }
    }
};

/// Two registers at a time: the steps of one fill the waits of the other.
template <int lanes, bool circular>
void rotate_lanes(
    const BatchSteps& steps, std::int32_t* x, std::int32_t* y, std::int32_t* z, std::ptrdiff_t count) {
    using Lanes = typename Register32<lanes>::Lanes;
    for (std::ptrdiff_t n = 0; n < count; n += 2 * lanes) {
        LaneVectors<Lanes> a;
        LaneVectors<Lanes> b;
        a.load(x + n, y + n, z + n);
        b.load(x + n + lanes, y + n + lanes, z + n + lanes);
        for (int i = 0; i < steps.step_count; ++i) {
            const Lanes angle = Lanes{} + steps.angles[i];
            a.template turn<circular>(steps.shifts[i], angle);
            b.template turn<circular>(steps.shifts[i], angle);
        }
        for (int j = 0; j < steps.correction_count; ++j) {
            const std::int32_t correction = steps.corrections[j];
            if (correction != 0) {
                const int shift = correction < 0 ? -correction : correction;
                a.correct(shift, correction < 0);
                b.correct(shift, correction < 0);
            }
        }
        a.store(x + n, y + n, z + n);
        b.store(x + n + lanes, y + n + lanes, z + n + lanes);
    }
}

template <int lanes>
void rotate_batch(
    const BatchSteps& steps, std::int32_t* x, std::int32_t* y, std::int32_t* z, std::ptrdiff_t count) {
    if (steps.circular) {
        rotate_lanes<lanes, true>(steps, x, y, z, count);
    } else {
        rotate_lanes<lanes, false>(steps, x, y, z, count);
    }
}

} // namespace
} // namespace millwright::cordic::internal
