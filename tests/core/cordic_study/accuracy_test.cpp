#include "core/cordic_study/accuracy.h"

#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace millwright::cordic {
namespace {

void expect_proven(const NumberFormat& format, const Sequence& sequence, const Sampling& sampling) {
    const Accuracy found = measure_accuracy(format, sequence, sampling, Progress());
    // Coordinates are rounded into the format first, which may make the vector longer by that much.
    const double length = 1.0 + resolution(format);
    const RotationBound rotation = rotation_bound(format, sequence, length);
    const double shortest = 1.0 - resolution(format);
    const VectoringBound vectoring = vectoring_bound(format, sequence, shortest);
    const double most_length = vectoring_bound(format, sequence, length).length;
    const auto where = to_text(format) + " " + std::string(to_text(format.rounding)) + ", " +
                       std::to_string(sequence.step_count) + " steps";
    EXPECT_LE(found.rotation, rotation.total) << where;
    EXPECT_LE(found.angle, vectoring.angle) << where;
    EXPECT_LE(found.length, most_length) << where;
    // A bound that is never nearly reached says little.
    // In the linear system z is a sum of powers of two, which floating point does not round as the bound
    // allows.
    const double part = sequence.m == CoordinateSystem::linear ? 0.02 : 0.04;
    EXPECT_GE(found.rotation, part * rotation.total) << where;
    EXPECT_GE(found.angle, part * vectoring.angle) << where;
}

TEST(AccuracyBound, HoldsForEveryAngleOfSixteenBits) {
    for (const Rounding rounding :
         {Rounding::truncate, Rounding::toward_zero, Rounding::nearest, Rounding::nearest_even}) {
        expect_proven(fixed_format(2, 14, rounding), thesis_sequence(), {});
        expect_proven(fixed_format(2, 14, rounding), classic_sequence(CoordinateSystem::circular, 15), {});
    }
    for (int steps = 4; steps <= 20; ++steps) {
        expect_proven(fixed_format(2, 14), classic_sequence(CoordinateSystem::circular, steps), {});
    }
}

TEST(AccuracyBound, HoldsForEveryAngleOfOtherShortWords) {
    expect_proven(fixed_format(2, 6), thesis_sequence(), {});
    expect_proven(fixed_format(3, 9), classic_sequence(CoordinateSystem::circular, 12), {});
    expect_proven(
        fixed_format(4, 14, Rounding::nearest), classic_sequence(CoordinateSystem::circular, 16), {});
}

TEST(AccuracyBound, HoldsForRandomAnglesOfLongWordsAndFloatingPoint) {
    for (const NumberFormat& format :
         {fixed_format(2, 22), fixed_format(2, 30), fixed_format(2, 62), binary32, binary64}) {
        for (const Sequence& sequence : {thesis_sequence(),
                                         classic_sequence(CoordinateSystem::circular, 12),
                                         classic_sequence(CoordinateSystem::circular, 24)}) {
            expect_proven(format, sequence, {.random = 50'000});
        }
    }
}

TEST(AccuracyBound, HoldsInTheLinearAndTheHyperbolicSystem) {
    for (const auto m : {CoordinateSystem::linear, CoordinateSystem::hyperbolic}) {
        const int integer_bits = measured_integer_bits(m);
        for (const Rounding rounding :
             {Rounding::truncate, Rounding::toward_zero, Rounding::nearest, Rounding::nearest_even}) {
            expect_proven(fixed_format(integer_bits, 16 - integer_bits, rounding), thesis_sequence(m), {});
            expect_proven(
                fixed_format(integer_bits, 16 - integer_bits, rounding), classic_sequence(m, 14), {});
        }
        for (const NumberFormat& format :
             {fixed_format(integer_bits, 24), fixed_format(integer_bits, 58), binary32, binary64}) {
            for (const Sequence& sequence :
                 {thesis_sequence(m), classic_sequence(m, 12), classic_sequence(m, 24)}) {
                expect_proven(format, sequence, {.random = 50'000});
            }
        }
    }
}

TEST(AccuracyBound, GrowsAsTheVectorBecomesShort) {
    const NumberFormat format = fixed_format(8, 24);
    double before = 0.0;
    for (const double length : {1.0, 0.1, 0.01, 0.001, 0.0001}) {
        const double angle = vectoring_bound(format, thesis_sequence(), length).angle;
        EXPECT_GT(angle, before);
        before = angle;
    }
    EXPECT_DOUBLE_EQ(vectoring_bound(format, thesis_sequence(), 1e-8).angle, 3.14159265358979323846);
    EXPECT_GE(vectoring_bound(format, thesis_sequence(), 0.001).angle,
              4.18e-4); // the worst direction measured
}

TEST(AccuracyMeasurement, IsTheSameOnAnyNumberOfThreads) {
    const auto measure = [] {
        return measure_accuracy(fixed_format(2, 22), thesis_sequence(), {.random = 50'000}, Progress());
    };
    set_thread_count(1);
    const Accuracy one = measure();
    set_thread_count(7);
    const Accuracy seven = measure();
    set_thread_count(0);
    EXPECT_EQ(one.rotation, seven.rotation);
    EXPECT_EQ(one.angle, seven.angle);
    EXPECT_EQ(one.length, seven.length);
}

} // namespace
} // namespace millwright::cordic
