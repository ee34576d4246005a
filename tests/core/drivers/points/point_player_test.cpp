// In computed time: whoever waits is as late as the test wants.
#include "core/drivers/points/point_player.h"

#include "tests/support/machines.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace millwright::drivers {
namespace {

using testing::HasSubstr;

class LateClock final : public Clock {
public:
    [[nodiscard]] double now() const override { return now_; }
    void wait(double seconds) override {
        now_ += seconds + late;
        late = 0.0;
    }
    double late = 0.0; ///< of the next awakening, s

private:
    double now_ = 100.0;
};

/// Keeps what is sent, and when.
class KeptLink final : public links::Link {
public:
    struct Kept {
        std::vector<std::string> records;
        std::vector<double> times;
        std::string says;
        std::optional<std::string> lost;
        std::string answer{};       ///< to each record; empty: none
        double answers_after = 0.0; ///< s
        std::size_t refused = 0;    ///< the record that is not obeyed, from 1
    };
    KeptLink(Kept& kept, Clock& clock) : kept_(kept), clock_(clock) {}

    [[nodiscard]] std::string name() const override { return "kept"; }
    void open() override {}
    void write(std::string_view bytes) override {
        kept_.records.emplace_back(bytes);
        kept_.times.push_back(clock_.now());
    }
    [[nodiscard]] std::string read() override {
        const bool due = !kept_.records.empty() && answered_ < kept_.records.size() &&
                         clock_.now() >= kept_.times.back() + kept_.answers_after;
        if (due && !kept_.answer.empty()) {
            answered_ = kept_.records.size();
            kept_.says += answered_ == kept_.refused ? "no\n" : kept_.answer + "\n";
        }
        return std::exchange(kept_.says, {});
    }
    void wait(double seconds) override { clock_.wait(std::min(seconds, 0.001)); }
    [[nodiscard]] std::optional<std::string> lost() const override { return kept_.lost; }
    void close() noexcept override {}

private:
    Kept& kept_;
    Clock& clock_;
    std::size_t answered_ = 0;
};

PointTrack track_of(std::vector<Vec3> points, double period) {
    PointTrack track{.period = period, .points = std::move(points), .blocks = {}, .stops = {}};
    for (std::size_t n = 0; n < track.points.size(); ++n) {
        track.blocks.push_back(static_cast<int>(n));
    }
    return track;
}

/// The points of the thesis: 36 from (0, 0) to (10, 10).
PointTrack diagonal(double period = 0.04) {
    std::vector<Vec3> points;
    for (int n = 0; n < 36; ++n) {
        points.emplace_back(n * 10.0 / 35.0, n * 10.0 / 35.0, 0.0);
    }
    return track_of(std::move(points), period);
}

const RecordFormat plain_record{.pattern = "{X},{Y},{Z}"};
const RecordFormat asking_record{.pattern = "{X} {Y}", .answer = "ok"};

struct PointPlayerBench {
    LateClock clock;
    KeptLink::Kept kept;
    kinematics::MachineModel model = test::machine("forming-table");
    KeptLink link{kept, clock};
    PointPlayer player;

    explicit PointPlayerBench(double period = 0.04,
                              const RecordFormat& format = plain_record,
                              std::vector<PointTrack::Stop> stops = {})
        : player(&link, clock, track(period, std::move(stops)), model, {.format = format}) {}

    static std::shared_ptr<const PointTrack> track(double period, std::vector<PointTrack::Stop> stops) {
        PointTrack made = diagonal(period);
        made.stops = std::move(stops);
        return std::make_shared<const PointTrack>(std::move(made));
    }
};

TEST(PointPlayer, SendsOnePointAPeriod) {
    PointPlayerBench bench;
    const PlayStatus status = bench.player.play({});
    EXPECT_EQ(status.state, PlayState::done);
    ASSERT_EQ(bench.kept.records.size(), 36U);
    EXPECT_EQ(bench.kept.records[0], "0.0000,0.0000,0.0000\n");
    EXPECT_EQ(bench.kept.records[1], "0.2857,0.2857,0.0000\n");
    EXPECT_EQ(bench.kept.records[35], "10.0000,10.0000,0.0000\n");
    for (std::size_t n = 1; n < bench.kept.times.size(); ++n) {
        EXPECT_NEAR(bench.kept.times[n] - bench.kept.times[n - 1], 0.04, 1e-9);
    }
    EXPECT_EQ(status.points, 36);
    EXPECT_NEAR(status.time, 1.4, 1e-12);
    EXPECT_LT(status.jitter.most, 1e-9);
}

// The rest until the second point, 40 ms, begins with an awakening that is 30 ms late after 20 ms: that point
// comes 10 ms late, the next one in its own time.
TEST(PointPlayer, MeasuresDelaysAndDoesNotAddThemUp) {
    PointPlayerBench bench;
    bench.clock.late = 0.03;
    const PlayStatus status = bench.player.play({});
    EXPECT_NEAR(bench.kept.times.back() - bench.kept.times.front(), 1.4, 1e-9);
    EXPECT_NEAR(status.jitter.most, 0.01, 1e-9);
    EXPECT_LT(status.jitter.median, 1e-6);
}

TEST(PointPlayer, PlaysFasterOrSlowerThanTheTime) {
    LateClock clock;
    KeptLink::Kept kept;
    KeptLink link(kept, clock);
    const auto track = std::make_shared<const PointTrack>(diagonal());
    PointPlayer player(&link, clock, track, test::machine("forming-table"), {.speed = 4.0});
    (void)player.play({});
    EXPECT_NEAR(kept.times.back() - kept.times.front(), 0.35, 1e-9);
}

TEST(PointPlayer, SendsNothingAfterAnEmergencyStop) {
    PointPlayerBench bench(0.4);
    std::size_t then = 0;
    const PlayStatus status = bench.player.play({}, [&](const PlayStatus& now) {
        EXPECT_NEAR(now.position.x(), (static_cast<double>(now.points) - 1.0) * 10.0 / 35.0, 1e-12);
        if (now.points == 12) {
            bench.player.emergency_stop();
            then = bench.kept.records.size();
        }
    });
    EXPECT_EQ(then, 12U);
    EXPECT_EQ(bench.kept.records.size(), then);
    EXPECT_EQ(status.state, PlayState::emergency_stop);
    EXPECT_NEAR(status.position.x(), 11.0 * 10.0 / 35.0, 1e-12);
    EXPECT_THROW((void)bench.player.play({}), Error);
}

TEST(PointPlayer, StopsForWhoAsksTheWorkToStop) {
    PointPlayerBench bench(0.4);
    std::stop_source stop;
    const PlayStatus status = bench.player.play(stop.get_token(), [&](const PlayStatus& now) {
        if (now.points == 5) {
            stop.request_stop();
        }
    });
    EXPECT_EQ(bench.kept.records.size(), 5U);
    EXPECT_EQ(status.state, PlayState::emergency_stop);
}

TEST(PointPlayer, StopsWhereTheTableComplainsOrIsGone) {
    PointPlayerBench complains(0.4);
    const PlayStatus said = complains.player.play(
        {}, [&](const PlayStatus& now) { complains.kept.says = now.points == 7 ? "limit Z\n" : ""; });
    EXPECT_EQ(complains.kept.records.size(), 7U);
    EXPECT_THAT(said.sentence, HasSubstr("the table sent 'limit Z'"));

    PointPlayerBench goes(0.4);
    const PlayStatus gone = goes.player.play({}, [&](const PlayStatus& now) {
        if (now.points == 7) {
            goes.kept.lost = "unplugged";
        }
    });
    EXPECT_EQ(goes.kept.records.size(), 7U);
    EXPECT_THAT(gone.sentence, HasSubstr("the link was lost: unplugged"));
}

TEST(PointPlayer, SendsNoPointBeforeTheOneBeforeWasAnswered) {
    PointPlayerBench slow(0.04, asking_record);
    slow.kept.answer = "ok";
    slow.kept.answers_after = 0.3;
    const PlayStatus status = slow.player.play({});
    EXPECT_EQ(status.state, PlayState::done) << status.sentence;
    EXPECT_EQ(status.points, 36);
    ASSERT_EQ(slow.kept.times.size(), 36U);
    for (std::size_t n = 1; n < slow.kept.times.size(); ++n) {
        EXPECT_GE(slow.kept.times[n] - slow.kept.times[n - 1], 0.3);
    }
    EXPECT_GT(status.jitter.most, 0.2);

    PointPlayerBench quick(0.04, asking_record);
    quick.kept.answer = "ok";
    quick.kept.answers_after = 0.01;
    EXPECT_EQ(quick.player.play({}).state, PlayState::done);
    EXPECT_NEAR(quick.kept.times.back() - quick.kept.times.front(), 1.4, 1e-9); // in its own time
}

TEST(PointPlayer, StopsWhereNoAnswerComesInTime) {
    const RecordFormat impatient{.pattern = "{X} {Y}", .answer = "ok", .patience = 1.0};
    PointPlayerBench silent(0.04, impatient);
    const PlayStatus status = silent.player.play({});
    EXPECT_EQ(status.state, PlayState::emergency_stop);
    EXPECT_EQ(status.sentence, "the table did not answer point 1 within 1 s");
    EXPECT_EQ(silent.kept.records.size(), 1U);
    EXPECT_EQ(status.sent, 1);
    EXPECT_EQ(status.points, 0);
    EXPECT_TRUE(status.unsure); // it may have gone there

    PointPlayerBench single(0.04, impatient);
    single.kept.answer = "ok";
    single.kept.answers_after = 0.01;
    bool said = false;
    const PlayStatus twice = single.player.play({}, [&](const PlayStatus& now) {
        if (now.points >= 7 && !std::exchange(said, true)) {
            single.kept.says = "ok\n";
        }
    });
    EXPECT_EQ(twice.sentence, "the table answered a point that was not sent");
}

TEST(PointPlayer, TellsWhereATableStandsThatRefusedAPoint) {
    PointPlayerBench bench(0.04, asking_record);
    bench.kept.answer = "ok";
    bench.kept.refused = 20;
    const PlayStatus status = bench.player.play({});
    EXPECT_EQ(status.sentence, "the table sent 'no'");
    EXPECT_EQ(status.sent, 20);
    EXPECT_EQ(status.points, 19);
    EXPECT_FALSE(status.unsure); // it says itself that it did not go there
    EXPECT_NEAR(status.position.x(), 18.0 * 10.0 / 35.0, 1e-12);
}

// Z stays 0 in these points, so that a record may leave it out; Y changes.
TEST(PointPlayer, RefusesRecordsThatLeaveOutWhatChanges) {
    EXPECT_NO_THROW(PointPlayerBench(0.04, {.pattern = "{X} {Y}"}));
    try {
        const PointPlayerBench bench(0.04, {.pattern = "{X} {Z}"});
        ADD_FAILURE() << "it is taken";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("omits Y, which the points change"));
    }
}

TEST(PointPlayer, PlaysForTheEyesWithoutALink) {
    LateClock clock;
    PointPlayer player(
        nullptr, clock, std::make_shared<const PointTrack>(diagonal()), test::machine("forming-table"));
    EXPECT_EQ(player.play({}).state, PlayState::done);
}

// The point that was due when it was held is sent when it is resumed, and the others so much later.
TEST(PointPlayer, SendsNothingWhileItIsHeld) {
    PointPlayerBench bench(0.4);
    int glances = 0;
    std::size_t then = 0;
    const PlayStatus status = bench.player.play({}, [&](const PlayStatus& now) {
        if (now.state == PlayState::playing && now.points == 12 && glances == 0) {
            bench.player.hold();
            then = bench.kept.records.size();
        }
        if (now.state == PlayState::holding && ++glances == 50) {
            EXPECT_EQ(bench.kept.records.size(), then);
            bench.player.resume();
        }
    });
    EXPECT_EQ(then, 12U);
    EXPECT_EQ(status.state, PlayState::done);
    EXPECT_EQ(status.points, 36);
    EXPECT_NEAR(bench.kept.times[12] - bench.kept.times[11], 1.4, 0.03); // 0.4 s and 50 glances of 20 ms
    EXPECT_NEAR(bench.kept.times[35] - bench.kept.times[12], 23 * 0.4, 1e-6);
    EXPECT_LT(status.jitter.most, 1e-6);
}

TEST(PointPlayer, RestsAtTheStopsOfItsTrackUntilAPersonResumes) {
    PointPlayerBench bench(0.4, plain_record, {{0, "put in tool 1"}, {20, "change to tool 2"}});
    std::vector<std::pair<std::string, std::size_t>> rests;
    const PlayStatus status = bench.player.play({}, [&](const PlayStatus& now) {
        if (now.state == PlayState::holding) {
            rests.emplace_back(now.sentence, bench.kept.records.size());
            bench.player.resume();
        }
    });
    EXPECT_EQ(status.state, PlayState::done);
    EXPECT_THAT(
        rests,
        testing::ElementsAre(testing::Pair("put in tool 1", 0U), testing::Pair("change to tool 2", 20U)));
    EXPECT_EQ(status.stops, 2);
    EXPECT_EQ(status.sentence, "");

    PointPlayerBench ends(0.4, plain_record, {{20, "change to tool 2"}});
    const PlayStatus stopped = ends.player.play({}, [&](const PlayStatus& now) {
        if (now.state == PlayState::holding) {
            ends.player.stop();
        }
    });
    EXPECT_EQ(stopped.state, PlayState::stopped);
    EXPECT_EQ(stopped.stops, 0);
    EXPECT_EQ(ends.kept.records.size(), 20U);
}

TEST(PointPlayer, RefusesWhatCannotBePlayed) {
    const test::WithoutTraps without_traps;
    LateClock clock;
    const auto model = test::machine("forming-table");
    const auto player = [&](PointTrack track, const PlayerOptions& options = {}) {
        const PointPlayer made(
            nullptr, clock, std::make_shared<const PointTrack>(std::move(track)), model, options);
    };
    EXPECT_THROW(player({}), Error);
    EXPECT_THROW(player(diagonal(0.0)), Error);
    EXPECT_THROW(player(diagonal(), {.speed = std::nan("")}), Error);
    EXPECT_THROW(player(diagonal(), {.format = {.pattern = "{A}"}}), Error);
    EXPECT_NO_THROW(player(diagonal()));
}

TEST(CheckPoints, FindsWhatIsOutsideOrTooFastOnceAnAxis) {
    const auto model = test::machine("forming-table");
    EXPECT_TRUE(check_points(diagonal(0.04), model, "p").empty());
    // 0.2857 mm in 0.02 s is 14.3 mm/s, and X and Y go 10.
    const auto fast = check_points(diagonal(0.02), model, "p");
    ASSERT_EQ(fast.size(), 2U);
    EXPECT_EQ(fast.front().place.line, 2);
    const auto far = check_points(track_of({Vec3(0, 0, 0), Vec3(0.0, 550.1, 0.0)}, 100.0), model, "p");
    ASSERT_EQ(far.size(), 1U);
    EXPECT_THAT(far.front().message, HasSubstr("axis Y would move to 550.100"));
}

// The axes go 10 mm/s: not a hair more, of the points as they are written.
TEST(CheckPoints, RefusesAHairMoreThanAnAxisGoes) {
    const auto model = test::machine("forming-table");
    const auto found = [&](double way) {
        return check_points(track_of({Vec3(1.7, 0, 0), Vec3(1.7 + way, 0, 0)}, 0.04), model, "p");
    };
    EXPECT_TRUE(found(0.4).empty());
    ASSERT_EQ(found(0.4001).size(), 1U);
    EXPECT_EQ(found(0.4001).front().message,
              "axis X would move 0.4001 mm in 0.04 s at 10.0025 mm/s, but its maximum is 10 mm/s");
    EXPECT_TRUE(found(0.40004).empty()); // written as 0.4
    EXPECT_FALSE(found(0.40006).empty());
}

} // namespace
} // namespace millwright::drivers
