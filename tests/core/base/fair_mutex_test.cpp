#include "core/base/fair_mutex.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace millwright {
namespace {

TEST(FairMutex, KeepsOthersOut) {
    FairMutex mutex;
    int sum = 0;
    constexpr int each = 20000;
    {
        std::vector<std::jthread> threads;
        for (int n = 0; n < 3; ++n) {
            threads.emplace_back([&] {
                for (int k = 0; k < each; ++k) {
                    const std::scoped_lock lock(mutex);
                    ++sum;
                }
            });
        }
    }
    EXPECT_EQ(sum, 3 * each);
}

TEST(FairMutex, IsNotTakenWhileItIsHeld) {
    FairMutex mutex;
    ASSERT_TRUE(mutex.try_lock());
    bool taken = true;
    std::thread([&] { taken = mutex.try_lock(); }).join();
    EXPECT_FALSE(taken);
    mutex.unlock();
    EXPECT_TRUE(mutex.try_lock());
    mutex.unlock();
}

/// A thread that lets go for an instant alone, as that of a driver or an emulator.
TEST(FairMutex, IsHadByWhoWaitsBeforeItsHolderHasItAgain) {
    FairMutex mutex;
    std::atomic<int> turns = 0;
    const std::jthread worker([&](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            const std::scoped_lock lock(mutex);
            ++turns;
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
    });
    constexpr int asked = 200;
    int waited_for = 0; // turns of the worker
    for (int n = 0; n < asked; ++n) {
        for (const int before = turns; turns == before;) { // until the worker has it
        }
        const int before = turns;
        const std::scoped_lock lock(mutex);
        waited_for += turns - before;
    }
    EXPECT_LE(waited_for, 5 * asked); // one each, and more where this thread was put to sleep before it asked
}

} // namespace
} // namespace millwright
