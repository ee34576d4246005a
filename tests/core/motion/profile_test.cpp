#include "core/motion/internal/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace millwright::motion::internal {
namespace {

std::vector<Zone> random_zones(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<Zone> zones;
    double end = 3.0;
    const int count = 1 + static_cast<int>(40.0 * share(random));
    for (int n = 0; n < count; ++n) {
        end += share(random) < 0.2 ? 0.0 : std::pow(share(random), 3.0);
        const double value = share(random) < 0.1 ? 0.0 : share(random);
        zones.push_back({end, value, share(random) < 0.2 ? 0.0 : value, {}});
    }
    return zones;
}

/// The least of all zones whose stretch, made longer by its reach at both ends, holds the place.
double least_at(const std::vector<Zone>& zones, double begin, double place) {
    double least = std::numeric_limits<double>::infinity();
    for (const Zone& zone : zones) {
        if (place >= begin - zone.reach && place <= zone.end + zone.reach) {
            least = std::min(least, zone.value);
        }
        begin = zone.end;
    }
    return least;
}

double value_at(const Profile& profile, double place) {
    return std::ranges::upper_bound(profile, place, {}, &Step::end)->value;
}

TEST(Profile, IsTheLeastOfAllZonesThatReachAPlace) {
    std::mt19937 random(16);
    for (int run = 0; run < 300; ++run) {
        const std::vector<Zone> zones = random_zones(random);
        const double begin = 3.0;
        const Profile profile = profile_of(zones, begin);
        EXPECT_EQ(profile.back().end, zones.back().end);
        std::uniform_real_distribution<double> place(begin, zones.back().end);
        for (int k = 0; k < 200 && begin < zones.back().end; ++k) {
            const double at = place(random);
            ASSERT_EQ(value_at(profile, at), least_at(zones, begin, at)) << "run " << run << " at " << at;
        }
    }
}

// At rest the filter comes to rest, too: what held before does not hold behind it, nor the other way round.
TEST(Profile, NoLimitHoldsAcrossARest) {
    const Cause none;
    for (const bool rests : {true, false}) {
        const Profile slow_before = profile_of({{1.0, 1.0, 0.5, none, rests}, {2.0, 5.0, 0.5, none}}, 0.0);
        EXPECT_EQ(value_at(slow_before, 0.9), 1.0);
        EXPECT_EQ(value_at(slow_before, 1.1), rests ? 5.0 : 1.0);
        const Profile slow_behind = profile_of({{1.0, 5.0, 0.5, none, rests}, {2.0, 1.0, 0.5, none}}, 0.0);
        EXPECT_EQ(value_at(slow_behind, 0.9), rests ? 5.0 : 1.0);
        EXPECT_EQ(value_at(slow_behind, 1.1), 1.0);
        // A limit from before that cuts the zone at whose end the axes rest.
        const Profile cut =
            profile_of({{1.0, 1.0, 0.5, none}, {3.0, 5.0, 0.5, none, rests}, {4.0, 2.0, 0.5, none}}, 0.0);
        EXPECT_EQ(value_at(cut, 1.4), 1.0);
        EXPECT_EQ(value_at(cut, 2.9), rests ? 5.0 : 2.0);
    }
}

TEST(Profile, KeepsAPointThatDoesNotReachAnywhere) {
    const Profile profile = profile_of({{1.0, 5.0, 1.0, {}}, {1.0, 0.0, 0.0, {}}, {2.0, 5.0, 1.0, {}}}, 0.0);
    ASSERT_EQ(profile.size(), 3U);
    EXPECT_EQ(profile[1].value, 0.0);
    EXPECT_EQ(profile[1].end, 1.0);
}

TEST(Profile, JoinsNeighboursThatAreAlike) {
    const Profile profile = profile_of({{1.0, 5.0, 0.1, {}}, {2.0, 5.0, 0.1, {}}, {3.0, 5.0, 0.1, {}}}, 0.0);
    EXPECT_EQ(profile.size(), 1U);
    EXPECT_EQ(profile.back().end, 3.0);
}

} // namespace
} // namespace millwright::motion::internal
