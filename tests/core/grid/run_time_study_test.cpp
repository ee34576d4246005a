#include "core/grid/run_time_study.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/grid/weight.h"

#include <gtest/gtest.h>

#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

namespace millwright::grid {
namespace {

/// Each look at a clock takes longer than the last one.
class GrowingClock {
public:
    double operator()() {
        step_ += 1.0;
        now_ += step_;
        return now_;
    }

private:
    double now_ = 0.0, step_ = 0.0;
};

// T23.
TEST(RunTimeStudy, ComparesEveryNumberOfThreadsWithTheFirst) {
    const int before = thread_count();
    const RunTimeStudy study =
        run_time_study({.sides = {5, 9}, .threads = {1, 2, 3}, .iterations = 3, .repeats = 2},
                       {.wall = GrowingClock(), .processor = [] { return 0.0; }},
                       Progress());
    EXPECT_EQ(thread_count(), before);
    ASSERT_EQ(study.runs.size(), 6U);
    ASSERT_EQ(study.profiles.size(), 2U);
    EXPECT_EQ(study.runs[0].side, 5);
    EXPECT_EQ(study.runs[2].threads, 3);
    EXPECT_EQ(study.runs[3].side, 9);
    EXPECT_DOUBLE_EQ(study.runs[0].speed_up, 1.0);
    // Look 1 is of the whole study, looks 2 and 3 are of the first run: 3 apart; each later run is 2 longer.
    // The fastest counts.
    EXPECT_DOUBLE_EQ(study.runs[0].wall, 3.0);
    EXPECT_DOUBLE_EQ(study.runs[1].wall, 5.0);
    EXPECT_DOUBLE_EQ(study.runs[1].speed_up, 0.6);
    EXPECT_DOUBLE_EQ(study.one_thread_share, 0.0) << "the processor's clock did not move";
    EXPECT_FALSE(study.other_cores);
    for (const RunTime& run : study.runs) {
        EXPECT_TRUE(run.same_nodes) << run.side << " " << run.threads;
    }
}

// Clocks that go on by themselves: per look at the wall clock the process uses 0.75 s, the machine 2 s.
TEST(RunTimeStudy, TellsWhatOtherProgramsUsed) {
    double now = 0.0;
    const StudyClocks clocks{.wall = [&] { return now += 1.0; },
                             .processor = [&] { return 0.75 * now; },
                             .machine = [&] { return std::optional(2.0 * now); }};
    const RunTimeStudy study =
        run_time_study({.sides = {5}, .threads = {2, 1}, .iterations = 3, .repeats = 20}, clocks, Progress());
    ASSERT_TRUE(study.other_cores);
    EXPECT_NEAR(*study.other_cores, 1.25, 0.1);
    double wall = 0.0, processor = 0.0; // 3 s of processor time in the 4 s of each run
    const RunTimeStudy shared =
        run_time_study({.sides = {5, 6}, .threads = {1, 2}, .iterations = 1, .repeats = 3},
                       {.wall = [&] { return wall += 4.0; }, .processor = [&] { return processor += 3.0; }},
                       Progress());
    EXPECT_DOUBLE_EQ(shared.one_thread_share, 0.75);
    EXPECT_FALSE(shared.other_cores);
    for (const RunTimeProfile& profile : shared.profiles) {
        for (const double part :
             {profile.weight, profile.equations, profile.update, profile.norm, profile.checks}) {
            EXPECT_GT(part, 0.0) << "by the processor's clock";
        }
    }
}

TEST(RunTimeStudy, RunsUntimedBeforeTheFirstRunAsLongAsAsked) {
    int looks = 0;
    const auto wall = [&] { return static_cast<double>(++looks); };
    const auto none = [] { return 0.0; };
    const RunTimeSettings cold{.sides = {5}, .iterations = 1, .repeats = 1};
    (void)run_time_study(cold, {.wall = wall, .processor = none}, Progress());
    const int looks_when_cold = std::exchange(looks, 0);
    RunTimeSettings warm = cold;
    warm.warm_up = 10.0;
    (void)run_time_study(warm, {.wall = wall, .processor = none}, Progress());
    EXPECT_EQ(looks, looks_when_cold + 1 + 10) << "the begin, and one look before each untimed run";
}

TEST(RunTimeStudy, StopsWhereItIsCancelled) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)run_time_study({.sides = {5}},
                                      {.wall = [] { return 0.0; }, .processor = [] { return 0.0; }},
                                      Progress([](const Progress::Report&) {}, stop.get_token())),
                 Cancelled);
}

TEST(WeightW1On, IsW1On25NodesAndAsWideOnMore) {
    const std::vector<Vec2> places{{10.0, 5.0}, {3.0, 4.0}, {12.5, 14.0}};
    std::vector<Vec2> twice;
    for (const Vec2& place : places) {
        twice.push_back(2.0 * place);
    }
    std::vector<double> w1(3), on_25(3), on_49(3);
    std::vector<Vec2> slope(3), slope_49(3);
    weight_w1()->values(places, w1);
    weight_w1()->gradients(places, slope);
    weight_w1_on(25)->values(places, on_25);
    weight_w1_on(49)->values(twice, on_49);
    weight_w1_on(49)->gradients(twice, slope_49);
    EXPECT_EQ(on_25, w1);
    for (std::size_t n = 0; n < places.size(); ++n) {
        EXPECT_DOUBLE_EQ(on_49[n], w1[n]);
        EXPECT_LT((2.0 * slope_49[n] - slope[n]).norm(), 1e-15 + 1e-12 * slope[n].norm());
    }
}

} // namespace
} // namespace millwright::grid
