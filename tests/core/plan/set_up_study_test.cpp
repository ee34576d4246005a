#include "core/plan/set_up_study.h"

#include "core/base/error.h"
#include "core/plan/set_up_reach.h"
#include "tests/core/plan/sample_projects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace millwright::plan {
namespace {

using test::asset_folders;
using testing::AllOf;
using testing::HasSubstr;
using toolpath::SetUpParameter;

SetUpStudySettings small_settings() {
    SetUpStudySettings settings;
    settings.places = 5;
    settings.nodes = 6;
    return settings;
}

TEST(SetUpStudy, TheBestIsNotWorseThanAnyPlaceOfTheMap) {
    project::Project project = project::project_from_preset("dome");
    const CuttingSetup cutting_setup = cutting_setup_of(project, asset_folders);
    const SetUpStudy study = set_up_study(cutting_setup, small_settings(), Progress());
    EXPECT_LT(study.search.best.cost, 0.7 * study.search.start.cost);
    ASSERT_EQ(study.map.costs.size(), 25U);
    EXPECT_LE(study.search.best.cost, *std::ranges::min_element(study.map.costs) * 1.02);
}

TEST(SetUpStudy, AProjectWithThePartThereCostsWhatWasFound) {
    project::Project project = project::project_from_preset("two-bell");
    project.machine.file = "ca-head";
    SetUpStudySettings settings = small_settings();
    settings.turn_reach = 1.0;
    settings.across = SetUpParameter::turn;
    const CuttingSetup cutting_setup = cutting_setup_of(project, asset_folders);
    toolpath::SetUpPlace place = set_up_cost(cutting_setup, settings).start();
    place += toolpath::SetUpPlace(5.0, -3.0, 2.0, 0.6);
    const project::Project there = with_set_up(project, place);
    EXPECT_EQ(there.machine.workpiece_offset.value(), toolpath::offset_of(place));
    EXPECT_NE(there.surface.patches, project.surface.patches);
    EXPECT_TRUE(project::faults_of(there).empty());
    const toolpath::SetUpCost cost = set_up_cost(cutting_setup_of(there, asset_folders), settings);
    EXPECT_NEAR(
        cost.at(cost.start(), Progress()), set_up_cost(cutting_setup, settings).at(place, Progress()), 1e-9);
}

/// The dome 20 times as large.
project::Project large_dome() {
    project::Project project = project::project_from_preset("dome");
    for (geometry::ControlNet& net : project.surface.patches) {
        for (Vec3& point : net.points) {
            point *= 20.0;
        }
    }
    return project;
}

TEST(SetUpStudy, APartOutOfReachEverywhereIsRefusedWithTheAxisAndItsLimits) {
    try {
        (void)set_up_study(cutting_setup_of(large_dome(), asset_folders), small_settings(), Progress());
        FAIL() << "nothing thrown";
    } catch (const Error& error) {
        EXPECT_THAT(error.diagnostic().message,
                    AllOf(HasSubstr("from any position in the search range (a -1060.0 ... -940.0 mm, b "),
                          HasSubstr("; at the current position, path point "),
                          HasSubstr(" cannot be reached: axis Y would have to move to "),
                          HasSubstr(", outside -500.000 ... 500.000 mm")));
        EXPECT_NE(error.diagnostic().hint, "");
    }
}

TEST(SetUpStudy, AStartOutOfReachHasItsReasonAndTheBestHasNone) {
    project::Project project = project::project_from_preset("dome");
    project.machine.workpiece_offset = Vec3(900.0, 0.0, 175.0);
    const CuttingSetup cutting_setup = cutting_setup_of(project, asset_folders);
    const SetUpStudy study = set_up_study(cutting_setup, small_settings(), Progress());
    const auto why = [&](const toolpath::SetUpPlace& place) {
        return why_out_of_reach(cutting_setup, small_settings(), place).value_or("in reach");
    };
    EXPECT_THAT(why(study.search.start.place), HasSubstr(" cannot be reached: axis "));
    EXPECT_EQ(why(study.search.best.place), "in reach");
}

TEST(SetUpStudy, TheMapForSpreadsheetsIsInPeoplesUnits) {
    toolpath::SetUpMap map{
        SetUpParameter::turn, SetUpParameter::c, {0.0, 1.5707963267948966}, {10.0, 20.0}, {}, {}};
    map.costs = {1.0, 2.0, 3.0, std::numeric_limits<double>::infinity()};
    map.axis_max = {0.5235987755982988, 0.0, std::nullopt, std::nullopt};
    EXPECT_EQ(set_up_csv(map),
              "turn_deg,c_mm,cost_mm,axis_deg_to_curve\n"
              "0.0000,10.0000,1.000000,30.0000\n90.0000,10.0000,2.000000,0.0000\n"
              "0.0000,20.0000,3.000000,\n90.0000,20.0000,,\n");
}

TEST(SetUpStudy, RefusesWhatMakesNoSenseAndCanBeCancelled) {
    const CuttingSetup cutting_setup = cutting_setup_of(project::project_from_preset("dome"), asset_folders);
    SetUpStudySettings same = small_settings();
    same.up = same.across;
    EXPECT_THROW((void)set_up_study(cutting_setup, same, Progress()), Defect);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)set_up_study(cutting_setup, small_settings(), Progress({}, stop.get_token())),
                 Cancelled);
}

} // namespace
} // namespace millwright::plan
