// What CORDIC in software costs, beside the mathematics library: a rotation by an angle each. The library is
// faster on any processor with a multiplier; CORDIC is for hardware without one.
#include "core/cordic/batch.h"
#include "core/cordic/kernel.h"
#include "core/cordic/processor.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace millwright::cordic {
namespace {

constexpr int batch = 4096;

std::vector<double> angles() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1.5, 1.5);
    std::vector<double> made(batch);
    for (double& angle : made) {
        angle = any(random);
    }
    return made;
}

void library_rotation(benchmark::State& state) {
    const auto z = angles();
    for (auto _ : state) {
        double sum = 0.0;
        for (const double angle : z) {
            sum += 0.5 * std::cos(angle) - 0.25 * std::sin(angle) + 0.25 * std::cos(angle) +
                   0.5 * std::sin(angle);
        }
        benchmark::DoNotOptimize(sum);
    }
    state.SetItemsProcessed(state.iterations() * batch);
}
BENCHMARK(library_rotation);

template <class Arithmetic>
void rotate_all(benchmark::State& state, const Arithmetic& arithmetic, const Sequence& sequence) {
    const Kernel<Arithmetic> kernel(arithmetic, sequence);
    bool overflow = false;
    std::vector<typename Arithmetic::Number> z;
    for (const double angle : angles()) {
        z.push_back(arithmetic.from_double(angle, overflow));
    }
    const auto x = arithmetic.from_double(0.5, overflow);
    const auto y = arithmetic.from_double(0.25, overflow);
    for (auto _ : state) {
        for (const auto angle : z) {
            benchmark::DoNotOptimize(kernel.rotated({x, y, angle}, overflow));
        }
    }
    state.SetItemsProcessed(state.iterations() * batch);
}

void kernel_f64(benchmark::State& state) {
    rotate_all(state, FloatArithmetic<double>(), thesis_sequence());
}
BENCHMARK(kernel_f64);

void kernel_f32(benchmark::State& state) {
    rotate_all(state, FloatArithmetic<float>(), thesis_sequence());
}
BENCHMARK(kernel_f32);

void kernel_q3_29(benchmark::State& state) {
    rotate_all(state, FixedArithmetic(fixed_format(3, 29)), thesis_sequence());
}
BENCHMARK(kernel_q3_29);

void batches(benchmark::State& state, const Sequence& sequence, BatchCode code = BatchCode::fastest) {
    if (code == BatchCode::fastest && !has_fast_batches()) {
        state.SkipWithError("this processor has only the portable instructions");
        return;
    }
    const FixedArithmetic arithmetic(fixed_format(3, 29));
    const BatchRotator rotator(fixed_format(3, 29), sequence, code);
    std::vector<std::int32_t> z;
    bool overflow = false;
    for (const double angle : angles()) {
        z.push_back(static_cast<std::int32_t>(arithmetic.from_double(angle, overflow)));
    }
    std::vector<std::int32_t> x(batch);
    std::vector<std::int32_t> y(batch);
    for (auto _ : state) {
        std::fill(x.begin(), x.end(), 1 << 28);
        std::fill(y.begin(), y.end(), 1 << 27);
        auto left = z;
        benchmark::DoNotOptimize(rotator.rotate(x, y, left));
        benchmark::DoNotOptimize(x.data());
    }
    state.SetItemsProcessed(state.iterations() * batch);
}

void batch_q3_29_29_steps(benchmark::State& state) {
    batches(state, thesis_sequence());
}
BENCHMARK(batch_q3_29_29_steps);

void batch_q3_29_32_steps(benchmark::State& state) {
    batches(state, classic_sequence(CoordinateSystem::circular, 32));
}
BENCHMARK(batch_q3_29_32_steps);

void batch_q3_29_32_steps_portable(benchmark::State& state) {
    batches(state, classic_sequence(CoordinateSystem::circular, 32), BatchCode::portable);
}
BENCHMARK(batch_q3_29_32_steps_portable);

/// Clocks of the whole processor per second: an arc of 10,000 chords.
void processor_clocks(benchmark::State& state, const NumberFormat& format) {
    Image image{.format = format};
    const auto mov = [&](Register target, double value) {
        bool overflow = false;
        const Word word = with_arithmetic(format, [&](const auto& arithmetic) {
            return arithmetic.to_word(arithmetic.from_double(value, overflow));
        });
        append(image.code, {Opcode::mov, target, to_immediate(format, word)}, format);
    };
    mov(Register::X0, 10.0);
    mov(Register::Vmax, 1.0);
    mov(Register::Dz, 0.000628);
    append(image.code, {Opcode::mov, Register::N, 10'000}, format);
    append(image.code, {.opcode = Opcode::g03}, format);
    append(image.code, {.opcode = Opcode::hlt}, format);
    Processor processor({}, image);
    std::int64_t clocks = 0;
    for (auto _ : state) {
        processor.reset();
        clocks += processor.run(10'000'000);
    }
    state.SetItemsProcessed(clocks);
}

void processor_f64(benchmark::State& state) {
    processor_clocks(state, binary64);
}
BENCHMARK(processor_f64);

void processor_f32(benchmark::State& state) {
    processor_clocks(state, binary32);
}
BENCHMARK(processor_f32);

void processor_q8_24(benchmark::State& state) {
    processor_clocks(state, fixed_format(8, 24));
}
BENCHMARK(processor_q8_24);

} // namespace
} // namespace millwright::cordic
