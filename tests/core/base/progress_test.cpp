#include "core/base/progress.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <vector>

namespace millwright {
namespace {

TEST(Progress, APartCoversItsStretchOfTheWhole) {
    std::vector<Progress::Report> seen;
    const Progress progress([&](const Progress::Report& report) { seen.push_back(report); }, {});
    progress.part(0.2, 0.6).report(0.5, "half of a part");
    progress.part(0.2, 0.6).part(0.5, 1.0).report(1.0);
    ASSERT_EQ(seen.size(), 2U);
    EXPECT_DOUBLE_EQ(seen[0].fraction, 0.4);
    EXPECT_DOUBLE_EQ(seen[1].fraction, 0.6);
    EXPECT_EQ(seen[1].text, "half of a part");
}

TEST(Progress, NeverFallsBack) {
    double last = 0.0;
    const Progress progress([&](const Progress::Report& report) { last = report.fraction; }, {});
    progress.report(0.7);
    progress.report(0.3);
    EXPECT_DOUBLE_EQ(last, 0.7);
}

TEST(Progress, ThrowsCancelledOnceStopped) {
    std::stop_source source;
    const Progress progress(nullptr, source.get_token());
    EXPECT_NO_THROW(progress.check());
    source.request_stop();
    EXPECT_TRUE(progress.part(0.0, 0.5).cancelled());
    EXPECT_THROW(progress.check(), Cancelled);
}

TEST(Progress, OfNobodyIsNeverCancelled) {
    const Progress progress;
    progress.report(1.0, "done");
    EXPECT_FALSE(progress.cancelled());
}

} // namespace
} // namespace millwright
