#include "core/cordic/pipeline.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <vector>

namespace millwright::cordic {
namespace {

template <class Arithmetic>
void expect_same_bits(const Arithmetic& arithmetic, const Sequence& sequence, Mode mode) {
    const Kernel<Arithmetic> kernel(arithmetic, sequence);
    Pipeline<Arithmetic> pipeline(kernel, mode);
    std::mt19937 random(37);
    std::uniform_real_distribution<double> number(-0.9, 0.9);
    std::vector<Vector3<typename Arithmetic::Number>> in;
    int results = 0;
    for (int clock = 0; clock < 500; ++clock) {
        bool overflow = false;
        const auto value = [&] { return arithmetic.from_double(number(random), overflow); };
        in.push_back({value(), value(), value()});
        const auto out = pipeline.clock(in.back());
        ASSERT_EQ(out.has_value(), clock >= pipeline.latency()) << "clock " << clock;
        if (out) {
            const auto& v = in[static_cast<std::size_t>(results++)];
            EXPECT_EQ(out->vector,
                      mode == Mode::rotation ? kernel.rotated(v, overflow) : kernel.vectored(v, overflow));
        }
    }
    EXPECT_EQ(results, 500 - pipeline.latency()); // one per clock behind the fill
}

TEST(Pipeline, GivesTheBitsOfTheIterationOncePerClock) {
    for (const Mode mode : {Mode::rotation, Mode::vectoring}) {
        expect_same_bits(FloatArithmetic<double>(), thesis_sequence(), mode);
        expect_same_bits(FloatArithmetic<float>(), thesis_sequence(), mode);
        expect_same_bits(FixedArithmetic(fixed_format(2, 22)), thesis_sequence(), mode);
        expect_same_bits(
            FixedArithmetic(fixed_format(4, 28)), classic_sequence(CoordinateSystem::circular, 24), mode);
    }
}

TEST(Pipeline, IsFilledAfter37ClocksAndLetsBubblesThrough) {
    const FloatArithmetic<double> arithmetic;
    Pipeline pipeline(Kernel(arithmetic, thesis_sequence()), Mode::rotation);
    EXPECT_EQ(pipeline.latency(), 29 + 8);
    pipeline.clock(Vector3<double>{1.0, 0.0, 0.5});
    for (int n = 1; n < 37; ++n) {
        EXPECT_FALSE(pipeline.clock(std::nullopt));
    }
    EXPECT_TRUE(pipeline.clock(std::nullopt));
    EXPECT_FALSE(pipeline.clock(std::nullopt));
}

} // namespace
} // namespace millwright::cordic
