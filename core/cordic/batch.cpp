#include "core/cordic/batch.h"

#include "core/base/error.h"
#include "core/cordic/internal/batch_lanes.h"
#include "core/cordic/kernel.h"

#include <algorithm>
#include <cmath>

namespace millwright::cordic {
namespace {

constexpr int batch_chunk = 256; // three arrays of it stay in the first-level cache
constexpr double most_word = 2147483647.0;
constexpr double spare = 64.0; // units that roundings of all steps may add
constexpr int sign_alone = 31; // a shift by more leaves the sign, as in the kernel's longer word

/// |value| <= most for all of them. One comparison each, without a branch.
bool all_within(const std::int32_t* values, std::size_t count, std::int32_t most) {
    const auto offset = static_cast<std::uint32_t>(most);
    std::uint32_t beyond = 0;
    for (std::size_t n = 0; n < count; ++n) {
        beyond |= static_cast<std::uint32_t>(values[n]) + offset > 2 * offset ? 1U : 0U;
    }
    return beyond == 0;
}

/// value times 1/k, which has gain_places, rounded down: what fits before fits behind.
void scale_all(std::int32_t* values, std::size_t count, std::int64_t factor) {
    for (std::size_t n = 0; n < count; ++n) {
        values[n] = static_cast<std::int32_t>((Int128{values[n]} * factor) >> gain_places);
    }
}

} // namespace

bool has_fast_batches() {
#if defined(__x86_64__)
    return internal::avx2_batch_loop() != nullptr && __builtin_cpu_supports("avx2");
#else
    return false;
#endif
}

BatchRotator::BatchRotator(const NumberFormat& format, const Sequence& sequence, BatchCode code)
    : format_(format), sequence_(sequence), code_(has_fast_batches() ? code : BatchCode::portable) {
    if (format.kind != NumberKind::fixed || format.word() != 32 || format.rounding != Rounding::truncate ||
        sequence.m == CoordinateSystem::hyperbolic) {
        throw Error("batches must be 32-bit fixed point with truncation, circular or linear");
    }
    const FixedArithmetic arithmetic(format);
    double sum = 0.0;
    for (int i = 0; i < sequence.step_count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const auto angle = arithmetic.angle(sequence.m, sequence.shifts[at]);
        angles_[at] = static_cast<std::int32_t>(angle);
        shifts_[at] = std::min(sequence.shifts[at], sign_alone);
        sum += static_cast<double>(angle);
    }
    for (std::size_t j = 0; j < corrections_.size(); ++j) {
        corrections_[j] = std::clamp(sequence.corrections[j], -sign_alone, sign_alone);
    }
    // A vector's length never exceeds its first one times the gain; in the linear system y grows by x sum
    // 2^-S.
    const double growth = sequence.m == CoordinateSystem::circular ? std::sqrt(2.0) * gain(sequence)
                                                                   : 1.0 + convergence_range(sequence);
    most_coordinate_ = static_cast<std::int32_t>((most_word - spare) / growth);
    most_angle_ = static_cast<std::int32_t>(std::max(most_word - spare - sum, 0.0));
    factor_ = sequence.multiplies ? inverse_gain(sequence) : 0;
}

bool BatchRotator::fit(const std::int32_t* x,
                       const std::int32_t* y,
                       const std::int32_t* z,
                       std::size_t count) const {
    return all_within(x, count, most_coordinate_) && all_within(y, count, most_coordinate_) &&
           all_within(z, count, most_angle_);
}

std::int64_t
BatchRotator::rotate(std::span<std::int32_t> x, std::span<std::int32_t> y, std::span<std::int32_t> z) const {
    expects(x.size() == y.size() && y.size() == z.size(), "a batch has as many x as y and z");
    const Kernel<FixedArithmetic> kernel(FixedArithmetic(format_), sequence_);
    const std::size_t at_a_time =
        code_ == BatchCode::fastest ? internal::avx2_batch : internal::portable_batch;
    std::int64_t overflows = 0;
    for (std::size_t begin = 0; begin < x.size(); begin += batch_chunk) {
        const std::size_t end = std::min(x.size(), begin + batch_chunk);
        std::size_t n = begin;
        if (fit(x.data() + begin, y.data() + begin, z.data() + begin, end - begin)) {
            const std::size_t whole = (end - begin) / at_a_time * at_a_time;
            rotate_whole(x.data() + begin, y.data() + begin, z.data() + begin, whole);
            n += whole;
        }
        for (; n < end; ++n) {
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

void BatchRotator::rotate_whole(std::int32_t* x, std::int32_t* y, std::int32_t* z, std::size_t count) const {
    const internal::BatchSteps steps{.shifts = shifts_.data(),
                                     .angles = angles_.data(),
                                     .step_count = sequence_.step_count,
                                     .corrections = corrections_.data(),
                                     .correction_count =
                                         sequence_.multiplies ? 0 : sequence_.correction_count,
                                     .circular = sequence_.m == CoordinateSystem::circular};
    const auto vectors = static_cast<std::ptrdiff_t>(count);
    if (code_ == BatchCode::fastest) {
        internal::avx2_batch_loop()(steps, x, y, z, vectors);
    } else {
        internal::rotate_batch<internal::portable_batch / 2>(steps, x, y, z, vectors);
    }
    if (sequence_.multiplies) {
        scale_all(x, count, factor_);
        scale_all(y, count, factor_);
    }
}

} // namespace millwright::cordic
