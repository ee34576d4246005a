#include "core/base/parallel.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace millwright {
namespace {

class ParallelFor : public ::testing::TestWithParam<int> {
protected:
    ParallelFor() { set_thread_count(GetParam()); }
    ~ParallelFor() override { set_thread_count(0); }
};

TEST_P(ParallelFor, VisitsEveryIndexOnce) {
    std::vector<int> visits(1003, 0);
    parallel_for(std::ssize(visits), 16, [&](std::ptrdiff_t i) { ++visits[static_cast<std::size_t>(i)]; });
    EXPECT_EQ(visits, std::vector<int>(1003, 1));
}

TEST_P(ParallelFor, GivesTheSameBytesAsTheSerialLoop) {
    std::vector<double> parallel(5000), serial(5000);
    const auto value = [](std::ptrdiff_t i) { return std::sin(static_cast<double>(i)) / 3.0; };
    for (std::ptrdiff_t i = 0; i < 5000; ++i) {
        serial[static_cast<std::size_t>(i)] = value(i);
    }
    parallel_for(5000, 7, [&](std::ptrdiff_t i) { parallel[static_cast<std::size_t>(i)] = value(i); });
    EXPECT_EQ(parallel, serial);
}

TEST_P(ParallelFor, RethrowsTheExceptionOfTheLowestChunk) {
    const auto body = [](std::ptrdiff_t i) {
        if (i % 100 == 37) {
            throw std::runtime_error(std::to_string(i));
        }
    };
    try {
        parallel_for(1000, 10, body);
        FAIL() << "nothing thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "37");
    }
}

TEST_P(ParallelFor, AnEmptyLoopCallsNothing) {
    parallel_for(0, 8, [](std::ptrdiff_t) { FAIL(); });
    EXPECT_THROW(parallel_for(10, 0, [](std::ptrdiff_t) {}), Defect);
}

TEST_P(ParallelFor, ALoopInsideALoopVisitsEveryIndexOnce) {
    std::vector<int> visits(64 * 64, 0);
    parallel_for(64, 1, [&](std::ptrdiff_t outer) {
        parallel_for(
            64, 4, [&](std::ptrdiff_t inner) { ++visits[static_cast<std::size_t>(64 * outer + inner)]; });
    });
    EXPECT_EQ(visits, std::vector<int>(64 * 64, 1));
}

// What a whole study has: hundreds of thousands of loops.
TEST_P(ParallelFor, TakesNoMoreMemoryTheOftenerItIsCalled) {
    const auto loops = [](int count) {
        std::atomic<int> sum = 0;
        for (int n = 0; n < count; ++n) {
            parallel_for(8, 1, [&](std::ptrdiff_t) { ++sum; });
        }
        return sum.load();
    };
    const auto resident_kb = [] {
        std::ifstream status("/proc/self/statm");
        std::ptrdiff_t all = 0, resident = 0;
        status >> all >> resident;
        return 4 * resident;
    };
    EXPECT_EQ(loops(500), 4000);
    const std::ptrdiff_t before = resident_kb();
    ASSERT_GT(before, 0);
    EXPECT_EQ(loops(4000), 32000);
    constexpr std::ptrdiff_t noise_kb = 8000;
    EXPECT_LT(resident_kb() - before, noise_kb);
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, ::testing::Values(1, 2, 7));

} // namespace
} // namespace millwright
