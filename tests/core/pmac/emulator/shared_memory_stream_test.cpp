#include "core/pmac/emulator/shared_memory_stream.h"

#include "tests/support/reason.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace millwright::pmac {
namespace {

using test::reason;
using testing::HasSubstr;

std::vector<SharedMemoryStream::Point> arc(int count) {
    std::vector<SharedMemoryStream::Point> points;
    for (int n = 0; n < count; ++n) {
        const double turn = 6.283185307179586 * n / (count - 1);
        points.push_back({10.0 * std::sin(turn), 5.0 - 5.0 * std::cos(turn), 0.1 * n});
    }
    return points;
}

TEST(SharedMemoryStreamP9, EveryPointIsTakenInTurnAndAcknowledgedByEqu1) {
    const auto points = arc(200);
    SharedMemoryStream stream(points, 20.0);
    std::vector<std::int32_t> words;
    int flags = 0;
    while (!stream.finished()) {
        const SharedMemoryBuffer before = stream.buffer();
        stream.advance(1.0);
        const SharedMemoryBuffer& now = stream.buffer();
        EXPECT_LE(now.sent - now.taken, 1) << "one point at most is under way";
        if (now.sent > before.sent) {
            words.push_back(now.words[0]);
            flags += now.ready ? 1 : 0;
        }
    }
    ASSERT_EQ(words.size(), points.size());
    for (std::size_t n = 0; n < points.size(); ++n) {
        EXPECT_EQ(words[n], std::lround(1000.0 * points[n][0])) << n;
    }
    EXPECT_EQ(flags, 200) << "M155, which the card clears";
    EXPECT_EQ(stream.buffer().taken, 200);
    EXPECT_FALSE(stream.buffer().ready);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(stream.buffer().position[axis], points.back()[axis], 0.02);
    }
    // The card blends the moves: as long as all of them, and what it takes to begin and end.
    EXPECT_NEAR(stream.buffer().time, 200 * stream.move_time(), 10 * stream.move_time() + 1.0);
}

TEST(SharedMemoryStreamP9, StopsAtThePointThatTheCardHas) {
    SharedMemoryStream stream(arc(200), 20.0);
    while (stream.buffer().taken < 50) {
        stream.advance(1.0);
    }
    stream.stop();
    EXPECT_FALSE(stream.buffer().runs);
    for (int n = 0; n < 100 && !stream.finished(); ++n) {
        stream.advance(0.1);
    }
    EXPECT_TRUE(stream.finished());
    EXPECT_LE(stream.buffer().taken, 52);
}

TEST(SharedMemoryStreamP9, RefusesWhatNoWordHolds) {
    EXPECT_THAT(reason([] { SharedMemoryStream none({}, 10.0); }), HasSubstr("no point"));
    EXPECT_THAT(reason([] { SharedMemoryStream far({{9000.0, 0.0, 0.0}}, 10.0); }), HasSubstr("do not fit"));
}

} // namespace
} // namespace millwright::pmac
