#include "core/plan/set_up_work.h"

#include "core/project/assets.h"

#include <gtest/gtest.h>

#include <atomic>

namespace millwright::plan {
namespace {

SetUpStudySettings quick() {
    SetUpStudySettings settings;
    settings.places = 5;
    settings.nodes = 6;
    return settings;
}

project::Project dome_on_ac_table() {
    project::Project project = project::project_from_preset("dome");
    project.machine.file = "ac-table";
    project.machine.workpiece_offset = Vec3(30.0, 20.0, 10.0);
    return project;
}

TEST(SetUpWorker, FindsABetterPlaceInTheBackground) {
    std::atomic<int> woken = 0;
    SetUpWorker worker([&] { ++woken; });
    EXPECT_EQ(worker.latest(), nullptr);
    const project::Project project = dome_on_ac_table();
    const Folders folders{{}, project::assets_folder()};
    worker.request(project, folders, quick());
    worker.wait_idle();
    const auto found = worker.latest();
    ASSERT_TRUE(found && found->study);
    EXPECT_GT(woken, 0);
    EXPECT_LT(found->study->search.best.cost, found->study->search.start.cost);
    EXPECT_EQ(found->study->map.costs.size(), 25U);
    EXPECT_EQ(toolpath::offset_of(found->now), *project.machine.workpiece_offset);

    // What was promised is what the project costs there.
    const project::Project accepted = with_set_up(project, found->study->search.best.place);
    EXPECT_TRUE(same_but_for_place(project, accepted));
    const CuttingSetup there = cutting_setup_of(accepted, folders);
    const toolpath::SetUpCost cost = set_up_cost(there, quick());
    EXPECT_NEAR(cost.at(cost.start(), {}), found->study->search.best.cost, 1e-9);
}

TEST(SetUpWorker, TellsWhyThereIsNone) {
    SetUpWorker worker([] {});
    project::Project project = dome_on_ac_table();
    project.machine.file = "no-such-machine";
    worker.request(project, {{}, project::assets_folder()}, quick());
    worker.wait_idle();
    const auto found = worker.latest();
    ASSERT_TRUE(found && found->failure);
    EXPECT_NE(found->failure->message.find("no-such-machine"), std::string::npos);
    EXPECT_FALSE(found->study);
}

TEST(SetUpWorker, TheLastOneAskedForIsTheOneThatIsFound) {
    SetUpWorker worker([] {});
    const project::Project project = dome_on_ac_table();
    SetUpStudySettings other = quick();
    other.goal = toolpath::SetUpGoal::travel;
    worker.request(project, {{}, project::assets_folder()}, quick());
    worker.request(project, {{}, project::assets_folder()}, other);
    worker.wait_idle();
    ASSERT_NE(worker.latest(), nullptr);
    EXPECT_EQ(worker.latest()->settings, other);
}

TEST(SetUpWorker, APlaceIsNotForAnotherPartOrMachine) {
    const project::Project project = dome_on_ac_table();
    project::Project other = project;
    other.machine.workpiece_offset = Vec3(1.0, 2.0, 3.0);
    other.grid.nu = 33;
    EXPECT_TRUE(same_but_for_place(project, other));
    other.machine.file = "ca-head";
    EXPECT_FALSE(same_but_for_place(project, other));
    other = project;
    other.surface.patches[0].point(0, 0).z() += 1.0;
    EXPECT_FALSE(same_but_for_place(project, other));
}

} // namespace
} // namespace millwright::plan
