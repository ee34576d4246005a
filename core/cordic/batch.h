// Many rotations at once: 32-bit fixed point, the same steps for all, so that the compiler makes vector
// instructions of them. The same bits as the kernel.
#pragma once

#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"

#include <array>
#include <cstdint>
#include <span>

namespace millwright::cordic {

class BatchRotator {
public:
    /// `format` is fixed point of 32 bits that truncates, `sequence` circular or linear. Throws Error
    /// otherwise.
    BatchRotator(const NumberFormat& format, const Sequence& sequence);

    /// Rotates (x[n], y[n]) by z[n], in place; z becomes what is left. All three have one length. Where a
    /// value of the iteration might not fit the word, the vector is computed by the kernel. Returns how many
    /// overflowed: these are held at the end of the range.
    [[nodiscard]] std::int64_t
    rotate(std::span<std::int32_t> x, std::span<std::int32_t> y, std::span<std::int32_t> z) const;

private:
    void rotate_chunk(std::int32_t* x, std::int32_t* y, std::int32_t* z, int count) const;

    NumberFormat format_;
    Sequence sequence_;
    std::array<std::int32_t, most_steps> angles_{};
    std::int32_t most_coordinate_ = 0; ///< up to here nothing overflows
    std::int32_t most_angle_ = 0;
    std::int64_t factor_ = 0; ///< 1/k of a sequence that multiplies
};

} // namespace millwright::cordic
