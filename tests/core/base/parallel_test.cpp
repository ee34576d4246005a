#include "core/base/parallel.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <cmath>
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

INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, ::testing::Values(1, 2, 7));

} // namespace
} // namespace millwright
