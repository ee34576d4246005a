#include "ui/viewport/picture_facts.h"

#include "core/base/text.h"
#include "core/base/units.h"
#include "tests/ui/viewport/plans.h"

#include <gtest/gtest.h>

#include <limits>

namespace millwright::viewport {
namespace {

using project::GridMethod;

TEST(PictureFacts, PutTheErrorsBeforeAndAfterBelowEachOther) {
    const auto dome = test::planned(test::dome);
    const PictureFacts facts = picture_facts(dome.project, dome.plan, ViewKind::error);
    ASSERT_EQ(facts.rows.size(), 2U);
    const plan::Evaluation& after = *dome.plan.grid(GridMethod::tracks).evaluation;
    const std::vector<std::string> expected = {"optimised",
                                               fixed(after.closest.max, 3),
                                               fixed(after.closest.mean, 4),
                                               fixed(after.closest.lmean, 4),
                                               fixed(after.closest.p95, 4),
                                               fixed(to_degrees(after.closest.axis_max), 2),
                                               fixed(after.track_gap.value(), 2)};
    EXPECT_EQ(facts.rows[1], expected);
    EXPECT_EQ(facts.rows[0][0], "uniform");
    EXPECT_EQ(facts.rows[0][1], fixed(dome.plan.grid(GridMethod::uniform).evaluation->closest.max, 3));
}

TEST(PictureFacts, HaveACellForEveryColumn) {
    const auto dome = test::planned(test::dome);
    for (int k = 0; k < view_kind_count; ++k) {
        const PictureFacts facts = picture_facts(dome.project, dome.plan, static_cast<ViewKind>(k));
        ASSERT_FALSE(facts.rows.empty());
        for (const auto& row : facts.rows) {
            EXPECT_EQ(row.size(), facts.columns.size());
        }
    }
}

TEST(PictureFacts, NameProjectMachineAndSingularPoints) {
    const auto dome = test::planned(test::dome, "My dome");
    const PictureFacts facts = picture_facts(dome.project, dome.plan, ViewKind::grid);
    EXPECT_EQ(facts.title, "My dome");
    EXPECT_NE(facts.subtitle.find(dome.plan.cutting_setup->machine.name()), std::string::npos);
    const std::string count = std::to_string(dome.plan.singular_points.size()) + " singular point";
    EXPECT_NE(facts.subtitle.find(count), std::string::npos);
}

TEST(PictureFacts, SayOutOfReachWhereThereIsNoNumber) {
    auto dome = test::planned(test::dome);
    auto broken = std::make_shared<plan::Evaluation>(*dome.plan.grid(GridMethod::uniform).evaluation);
    broken->closest.max = std::numeric_limits<double>::infinity();
    dome.plan.grid(GridMethod::uniform).evaluation = broken;
    EXPECT_EQ(picture_facts(dome.project, dome.plan, ViewKind::error).rows[0][1], "out of reach");
}

TEST(PictureFacts, AreShortForAPlanWithoutResults) {
    EXPECT_TRUE(picture_facts({}, {}, ViewKind::error).rows.empty());
    EXPECT_TRUE(picture_facts({}, {}, ViewKind::design).rows.empty());
}

} // namespace
} // namespace millwright::viewport
