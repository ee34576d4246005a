#include "core/base/published.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <stop_token>
#include <thread>

namespace millwright {
namespace {

/// Both numbers are the same in every one that is published.
struct Pair {
    int first = 0, second = 0;
    std::uint64_t revision = 0;
};

TEST(Published, WhatSomebodyLooksAtStaysAsItIs) {
    Published<Pair> published;
    EXPECT_EQ(published.latest(), nullptr);
    published.publish({1, 1});
    const auto seen = published.latest();
    published.publish({2, 2});
    EXPECT_EQ(seen->first, 1);
    EXPECT_EQ(published.latest()->first, 2);
    EXPECT_EQ(published.latest()->revision, seen->revision + 1);
    published.clear();
    EXPECT_EQ(published.latest(), nullptr);
    published.publish({3, 3});
    EXPECT_EQ(published.latest()->revision, 3U) << "revisions go on, so that none comes twice";
}

TEST(Published, WhatIsNoLongerWantedIsNotPublished) {
    Published<Pair> published;
    std::stop_source stop;
    const Progress progress([](const Progress::Report&) {}, stop.get_token());
    published.publish({1, 1}, progress);
    stop.request_stop();
    EXPECT_THROW(published.publish({2, 2}, progress), Cancelled);
    EXPECT_EQ(published.latest()->first, 1);
}

TEST(Published, IsWholeWhileAnotherThreadPublishes) {
    Published<Pair> published;
    published.publish({0, 0});
    std::atomic<bool> done = false;
    std::jthread worker([&] {
        for (int n = 1; n <= 20'000; ++n) {
            published.publish({n, n});
        }
        done = true;
    });
    std::uint64_t last = 0;
    while (!done) {
        const auto seen = published.latest();
        ASSERT_EQ(seen->first, seen->second);
        ASSERT_GE(seen->revision, last);
        last = seen->revision;
    }
}

} // namespace
} // namespace millwright
