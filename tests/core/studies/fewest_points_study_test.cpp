#include "core/studies/fewest_points_study.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/plan/sample_projects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace millwright::studies {
namespace {

using test::asset_folders;
using testing::HasSubstr;
using testing::StartsWith;

TEST(FewestPointsStudy, TheTwoBellsNeedNotOnePointMoreThanAPrototype) {
    constexpr std::array tolerances{0.5};
    const auto rows = fewest_points({}, tolerances, asset_folders, Progress());
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_LE(rows[0].fewest.value(), 132); // 136 while moves were at most 0.4 of a track
    EXPECT_GE(rows[0].uniform.value(), 5 * rows[0].fewest.value());
    EXPECT_LE(rows[0].largest, 0.5);
    EXPECT_GT(rows[0].largest, 0.45);
}

TEST(FewestPointsStudy, IsTheSameOnAnyNumberOfThreads) {
    constexpr std::array tolerances{0.5};
    const FewestPointsCase of{"dome", "rotary-tilt-listing", 2};
    std::vector<std::string> texts;
    for (const int threads : {1, 3}) {
        set_thread_count(threads);
        texts.push_back(fewest_points_csv(of, fewest_points(of, tolerances, asset_folders, Progress())));
    }
    set_thread_count(0);
    EXPECT_EQ(texts[0], texts[1]);
    EXPECT_THAT(texts[0], StartsWith("surface,machine,tracks,tolerance_mm,uniform_points,fewest_points,"));
    EXPECT_THAT(texts[0], HasSubstr("\ndome,rotary-tilt-listing,2,0.5,"));
}

TEST(FewestPointsStudy, RefusesWhatItDoesNotKnowAndCanBeCancelled) {
    constexpr std::array tolerances{0.5};
    EXPECT_THROW((void)fewest_points({"dune"}, tolerances, asset_folders, Progress()), Error);
    EXPECT_THROW((void)fewest_points({"dome", "no-machine"}, tolerances, asset_folders, Progress()), Error);
    constexpr std::array none{0.0};
    EXPECT_THROW((void)fewest_points({}, none, asset_folders, Progress()), Defect);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)fewest_points({}, tolerances, asset_folders, Progress({}, stop.get_token())),
                 Cancelled);
}

} // namespace
} // namespace millwright::studies
