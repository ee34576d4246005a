#include "core/base/error.h"
#include "core/jobs/program_check.h"
#include "tests/support/jobs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>

namespace millwright::jobs {
namespace {

TEST(FeedCheck, TellsFeedsThatNoAxisReaches) {
    const auto table = std::make_shared<const kinematics::MachineModel>(test::machine("forming-table"));
    const double fastest = 60.0 * table->axis(0).max_velocity; // mm/min
    const auto told = [&](double feed, const char* more = "") {
        return feeds_not_reached(planned_job(
            fmt::format("G21 G90\nG0 Z5\nG1 X50 F{}\nG1 X100 Y50\n{}M2\n", feed, more), "part.ngc", table));
    };
    EXPECT_FALSE(told(fastest));
    const auto fast = told(1.2 * fastest); // not on the diagonal
    ASSERT_TRUE(fast);
    EXPECT_EQ(
        to_text(*fast),
        fmt::format(
            "part.ngc:3: {:.0f} mm/min exceeds the maximum speed of axis X (the machine will be slower)",
            1.2 * fastest));
    const auto both = told(2.0 * fastest, "G1 Y0\n");
    ASSERT_TRUE(both);
    EXPECT_NE(both->message.find("and so do 2 later feeds"), std::string::npos);
}

} // namespace
} // namespace millwright::jobs
