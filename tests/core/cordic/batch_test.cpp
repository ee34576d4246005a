#include "core/cordic/batch.h"

#include "core/base/error.h"
#include "core/cordic/kernel.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace millwright::cordic {
namespace {

/// Random vectors up to 2^-`spare` of the word; every hundredth takes all of it.
std::vector<std::int32_t> numbers(int count, int spare, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::int32_t> made;
    for (int n = 0; n < count; ++n) {
        made.push_back(static_cast<std::int32_t>(random()) >> (n % 1000 == 999 ? 0 : spare));
    }
    return made;
}

class BatchRotatorOf : public testing::TestWithParam<BatchCode> {
protected:
    void SetUp() override {
        if (GetParam() == BatchCode::fastest && !has_fast_batches()) {
            GTEST_SKIP() << "this processor has only the portable instructions";
        }
    }
};

INSTANTIATE_TEST_SUITE_P(Codes,
                         BatchRotatorOf,
                         testing::Values(BatchCode::fastest, BatchCode::portable),
                         [](const auto& code) {
                             return code.param == BatchCode::fastest ? "Fastest" : "Portable";
                         });

TEST_P(BatchRotatorOf, HasTheBitsOfTheKernel) {
    constexpr int count = 5000;
    for (const Sequence& sequence : {thesis_sequence(),
                                     classic_sequence(CoordinateSystem::circular, 32),
                                     classic_sequence(CoordinateSystem::circular, 40),
                                     classic_sequence(CoordinateSystem::circular, 62),
                                     thesis_sequence(CoordinateSystem::linear)}) {
        for (const NumberFormat& format : {fixed_format(2, 30), fixed_format(3, 29), fixed_format(8, 24)}) {
            const Kernel<FixedArithmetic> kernel(FixedArithmetic(format), sequence);
            const auto x = numbers(count, 3, 1);
            const auto y = numbers(count, 3, 2);
            const auto z = numbers(count, 2, 3);
            auto bx = x;
            auto by = y;
            auto bz = z;
            const std::int64_t overflows = BatchRotator(format, sequence, GetParam()).rotate(bx, by, bz);
            std::int64_t expected = 0;
            for (std::size_t n = 0; n < x.size(); ++n) {
                bool overflow = false;
                const auto turned = kernel.rotated({x[n], y[n], z[n]}, overflow);
                expected += overflow ? 1 : 0;
                ASSERT_EQ(bx[n], turned.x) << n;
                ASSERT_EQ(by[n], turned.y) << n;
                ASSERT_EQ(bz[n], turned.z) << n;
            }
            EXPECT_EQ(overflows, expected);
            EXPECT_GT(expected, 0);
        }
    }
}

// What is left over behind whole registers is computed by the kernel.
TEST_P(BatchRotatorOf, HasTheBitsOfTheKernelInBatchesOfEveryLength) {
    const NumberFormat format = fixed_format(3, 29);
    const Sequence sequence = classic_sequence(CoordinateSystem::circular, 32);
    const Kernel<FixedArithmetic> kernel(FixedArithmetic(format), sequence);
    for (int count = 0; count < 600; count += count < 70 ? 1 : 37) {
        const auto x = numbers(count, 3, 4);
        const auto y = numbers(count, 3, 5);
        const auto z = numbers(count, 2, 6);
        auto bx = x;
        auto by = y;
        auto bz = z;
        EXPECT_EQ(BatchRotator(format, sequence, GetParam()).rotate(bx, by, bz), 0);
        for (std::size_t n = 0; n < x.size(); ++n) {
            bool overflow = false;
            const auto turned = kernel.rotated({x[n], y[n], z[n]}, overflow);
            ASSERT_EQ(bx[n], turned.x) << n << " of " << count;
            ASSERT_EQ(by[n], turned.y) << n << " of " << count;
            ASSERT_EQ(bz[n], turned.z) << n << " of " << count;
        }
    }
}

TEST(BatchRotator, RefusesWhatItCannotDo) {
    EXPECT_THROW(BatchRotator(fixed_format(2, 22), thesis_sequence()), Error);
    EXPECT_THROW(BatchRotator(binary32, thesis_sequence()), Error);
    EXPECT_THROW(BatchRotator(fixed_format(3, 29, Rounding::nearest), thesis_sequence()), Error);
    EXPECT_THROW(BatchRotator(fixed_format(3, 29), thesis_sequence(CoordinateSystem::hyperbolic)), Error);
}

} // namespace
} // namespace millwright::cordic
