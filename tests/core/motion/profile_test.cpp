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
