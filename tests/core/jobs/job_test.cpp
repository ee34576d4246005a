#include "core/jobs/job.h"

#include "core/base/error.h"
#include "tests/support/jobs.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace millwright::jobs {
namespace {

using ::testing::HasSubstr;

program::Program good_program() {
    return test::post_over("dome", test::machine("rotary-tilt-listing"), 4, 4).program;
}

TEST(Preflight, FindsNothingWrongWithAGoodJob) {
    EXPECT_TRUE(preflight(test::dome_job()).empty());
}

TEST(Preflight, FindsAProgramForOtherAxes) {
    Job job = test::dome_job();
    job.machine = std::make_shared<const kinematics::MachineModel>(test::machine("ac-table"));
    const auto found = preflight(job);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_THAT(found[0].message, HasSubstr("XYZAB"));
}

TEST(Preflight, NamesTheLineAxisAndRangeOncePerAxis) {
    program::Program program = good_program();
    program.blocks[7].target[0] = 600.0;
    program.blocks[8].target[0] = 700.0;
    const Job job = test::job_of(program);
    const auto found = preflight(job);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].message, "axis X would move to 600.000, outside -500.000 ... 500.000 mm");
    EXPECT_EQ(found[0].place.line, job.listing->line_of_block[7]);
}

TEST(Preflight, FindsTargetsAndDurationsThatAreNoNumbers) {
    const test::WithoutTraps numbers_that_are_none;
    Job job = test::job_of(good_program());
    program::Program spoiled = *job.program;
    const auto feed =
        std::find_if(spoiled.blocks.begin(), spoiled.blocks.end(), [](const program::Block& block) {
            return block.kind == program::BlockKind::feed;
        });
    feed->target[1] = std::numeric_limits<double>::quiet_NaN();
    feed->duration = 0.0;
    job.program = std::make_shared<const program::Program>(spoiled);
    EXPECT_EQ(preflight(job).size(), 2U);
}

TEST(Preflight, FindsAProgramWithoutAnEnd) {
    program::Program program = good_program();
    program.blocks.pop_back();
    const auto found = preflight(test::job_of(program));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_THAT(found[0].message, HasSubstr("no end block"));
}

TEST(Preflight, RefusesAListingOfAnotherProgram) {
    Job job = test::dome_job();
    job.listing = std::make_shared<const program::Listing>();
    EXPECT_THROW((void)preflight(job), Defect);
}

TEST(ProgramHash, IsFnv1aOf64Bits) {
    // Test vectors of the FNV specification (Fowler, Noll, Vo; draft-eastlake-fnv).
    EXPECT_EQ(program_hash(""), "cbf29ce484222325");
    EXPECT_EQ(program_hash("a"), "af63dc4c8601ec8c");
    EXPECT_EQ(program_hash("foobar"), "85944171f73967e8");
}

} // namespace
} // namespace millwright::jobs
