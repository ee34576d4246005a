#include "core/grid/improver.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <stop_token>

namespace millwright::grid {
namespace {

/// Needs `steps` steps and does nothing in them.
class Counting final : public GridImprover {
public:
    explicit Counting(int steps) : left_(steps) {}

    bool advance(const Progress& progress) override {
        progress.check();
        ++state_.round;
        return --left_ > 0;
    }
    [[nodiscard]] const ImproverState& state() const override { return state_; }

private:
    int left_;
    ImproverState state_{
        .current = {}, .best = Grid::uniform(2, 2), .start = {}, .now = {}, .of_best = {}, .note = {}};
};

TEST(Run, AdvancesUntilThereIsNothingMoreToDo) {
    Counting improver(5);
    EXPECT_EQ(run(improver, Progress()).round, 5);
}

TEST(Run, EndsWhenCancelled) {
    Counting improver(5);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)run(improver, Progress(nullptr, stop.get_token())), Cancelled);
    EXPECT_EQ(improver.state().round, 0);
}

} // namespace
} // namespace millwright::grid
