// Many rotations at once: 32-bit fixed point, the same steps for all, so that one instruction turns four
// vectors, or eight where the processor has AVX2. The same bits as the kernel.
#pragma once

#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace millwright::cordic {

/// Which instructions a batch is computed with.
enum class BatchCode : std::uint8_t {
    fastest, ///< that this processor has
    portable ///< that every processor of its kind has
};

class BatchRotator {
public:
    /// `format` is fixed point of 32 bits that truncates, `sequence` circular or linear. Throws Error
    /// otherwise.
    BatchRotator(const NumberFormat& format, const Sequence& sequence, BatchCode code = BatchCode::fastest);

    /// Rotates (x[n], y[n]) by z[n], in place; z becomes what is left. All three have one length. Where a
    /// value of the iteration might not fit the word, the vector is computed by the kernel. Returns how many
    /// overflowed: these are held at the end of the range.
    [[nodiscard]] std::int64_t
    rotate(std::span<std::int32_t> x, std::span<std::int32_t> y, std::span<std::int32_t> z) const;

private:
    [[nodiscard]] bool
    fit(const std::int32_t* x, const std::int32_t* y, const std::int32_t* z, std::size_t count) const;
    /// So many that the loop has no rest.
    void rotate_whole(std::int32_t* x, std::int32_t* y, std::int32_t* z, std::size_t count) const;

    NumberFormat format_;
    Sequence sequence_;
    BatchCode code_;
    std::array<std::int32_t, most_steps> shifts_{};
    std::array<std::int32_t, most_steps> angles_{};
    std::array<std::int32_t, most_corrections> corrections_{};
    std::int32_t most_coordinate_ = 0; ///< up to here nothing overflows
    std::int32_t most_angle_ = 0;
    std::int64_t factor_ = 0; ///< 1/k of a sequence that multiplies
};

/// Whether this processor has the instructions that the fastest code needs beside the portable ones.
[[nodiscard]] bool has_fast_batches();

} // namespace millwright::cordic
