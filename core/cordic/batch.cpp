#include "core/cordic/batch.h"

#include "core/base/error.h"
#include "core/cordic/kernel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace millwright::cordic {
namespace {

constexpr int batch_chunk = 256; // three arrays of it stay in the first-level cache
constexpr double most_word = 2147483647.0;
constexpr double spare = 64.0; // units that roundings of all steps may add
constexpr int sign_alone = 31; // a shift by more leaves the sign, as in the kernel's longer word

} // namespace

BatchRotator::BatchRotator(const NumberFormat& format, const Sequence& sequence)
    : format_(format), sequence_(sequence) {
    if (format.kind != NumberKind::fixed || format.word() != 32 || format.rounding != Rounding::truncate ||
        sequence.m == CoordinateSystem::hyperbolic) {
        throw Error("batches are of 32-bit fixed point that truncates, circular or linear");
    }
    const FixedArithmetic arithmetic(format);
    double sum = 0.0;
    for (int i = 0; i < sequence.step_count; ++i) {
        const auto angle = arithmetic.angle(sequence.m, sequence.shifts[static_cast<std::size_t>(i)]);
        angles_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(angle);
        sum += static_cast<double>(angle);
    }
    // A vector's length never exceeds its first one times the gain; in the linear system y grows by x sum
    // 2^-S.
    const double growth = sequence.m == CoordinateSystem::circular ? std::sqrt(2.0) * gain(sequence)
                                                                   : 1.0 + convergence_range(sequence);
    most_coordinate_ = static_cast<std::int32_t>((most_word - spare) / growth);
    most_angle_ = static_cast<std::int32_t>(std::max(most_word - spare - sum, 0.0));
    factor_ = sequence.multiplies ? inverse_gain(sequence) : 0;
}

std::int64_t
BatchRotator::rotate(std::span<std::int32_t> x, std::span<std::int32_t> y, std::span<std::int32_t> z) const {
    expects(x.size() == y.size() && y.size() == z.size(), "a batch has as many x as y and z");
    const Kernel<FixedArithmetic> kernel(FixedArithmetic(format_), sequence_);
    const auto fits = [&](std::size_t n) {
        const auto within = [](std::int32_t value, std::int32_t most) {
            return value <= most && value >= -most;
        };
        return within(x[n], most_coordinate_) && within(y[n], most_coordinate_) && within(z[n], most_angle_);
    };
    std::int64_t overflows = 0;
    for (std::size_t begin = 0; begin < x.size(); begin += batch_chunk) {
        const std::size_t end = std::min(x.size(), begin + batch_chunk);
        bool all = true;
        for (std::size_t n = begin; n < end; ++n) {
            all = fits(n) && all;
        }
        if (all) {
            rotate_chunk(x.data() + begin, y.data() + begin, z.data() + begin, static_cast<int>(end - begin));
            continue;
        }
        for (std::size_t n = begin; n < end; ++n) {
            bool overflow = false;
            const auto turned = kernel.rotated({x[n], y[n], z[n]}, overflow);
            x[n] = static_cast<std::int32_t>(turned.x);
            y[n] = static_cast<std::int32_t>(turned.y);
            z[n] = static_cast<std::int32_t>(turned.z);
            overflows += overflow ? 1 : 0;
        }
    }
    return overflows;
}

// (v ^ m) - m with m = 0 or -1 is v or -v: steps of both senses without a branch. Counts and shifts are the
// same for all elements of a loop, which makes it one of vector instructions.
void BatchRotator::rotate_chunk(std::int32_t* __restrict x,
                                std::int32_t* __restrict y,
                                std::int32_t* __restrict z,
                                int count) const {
    const std::int32_t turns_x = sequence_.m == CoordinateSystem::circular ? -1 : 0;
    for (int i = 0; i < sequence_.step_count; ++i) {
        const int shift = std::min<int>(sequence_.shifts[static_cast<std::size_t>(i)], sign_alone);
        const std::int32_t angle = angles_[static_cast<std::size_t>(i)];
        for (int n = 0; n < count; ++n) {
            const std::int32_t m = z[n] >> 31; // -1 for a negative angle
            const std::int32_t dx = (((y[n] >> shift) ^ m) - m) & turns_x;
            const std::int32_t dy = ((x[n] >> shift) ^ m) - m;
            x[n] -= dx;
            y[n] += dy;
            z[n] -= (angle ^ m) - m;
        }
    }
    if (sequence_.multiplies) {
        const FixedArithmetic arithmetic(format_);
        bool overflow = false;
        for (int n = 0; n < count; ++n) {
            x[n] = static_cast<std::int32_t>(arithmetic.scaled(x[n], factor_, overflow));
            y[n] = static_cast<std::int32_t>(arithmetic.scaled(y[n], factor_, overflow));
        }
        return;
    }
    for (int j = 0; j < sequence_.correction_count; ++j) {
        const int a = sequence_.corrections[static_cast<std::size_t>(j)];
        if (a == 0) {
            continue;
        }
        const int shift = std::min(std::abs(a), sign_alone);
        const std::int32_t m = a < 0 ? -1 : 0;
        for (int n = 0; n < count; ++n) {
            x[n] += ((x[n] >> shift) ^ m) - m;
            y[n] += ((y[n] >> shift) ^ m) - m;
        }
    }
}

} // namespace millwright::cordic
