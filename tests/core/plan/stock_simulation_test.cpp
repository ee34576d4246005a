#include "core/plan/stock_simulation.h"

#include "core/plan/stock_work.h"
#include "tests/core/plan/sample_projects.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

namespace millwright::plan {
namespace {

/// The dome, cut by a ball from a block that is a little larger.
project::Project cut_dome() {
    project::Project project = test::small_sample("dome", 6);
    project.grid.method = project::GridMethod::uniform;
    project.tool = {.cutter = toolpath::CutterKind::ball, .diameter_mm = 12.0, .length_mm = 60.0};
    return project;
}

StockJob job_of(const project::Project& project) {
    const Plan plan = make_plan(project, test::sample_folders, {}, Scope::program);
    StockJob job{.project = project,
                 .surface = plan.surface,
                 .cutting_setup = plan.cutting_setup,
                 .program = plan.program,
                 .listing = plan.listing,
                 .machine_solids = nullptr,
                 .settings = {}};
    job.settings.resolution = 1.5;
    return job;
}

const StockJob& dome_job() {
    static const StockJob job = job_of(cut_dome());
    return job;
}

bool has_holder(const StockEvent& event) {
    return event.kind == StockEventKind::collision && event.bodies.find("holder") != std::string::npos;
}

TEST(PartHeights, AreDistancesAlongTheNormalWithinTheFace) {
    const CuttingSetup& setup = *dome_job().cutting_setup;
    const PartHeights heights(setup);
    for (const double height : {-1.5, -0.01, 0.0, 0.02, 2.0}) {
        for (const Vec2& uv : {Vec2(0.2, 0.7), Vec2(0.5, 0.4), Vec2(0.9, 0.1)}) {
            const Vec3 normal = *setup.patch.unit_normal(uv.x(), uv.y()) * (setup.flipped ? -1.0 : 1.0);
            const Vec3 point = setup.patch.position(uv.x(), uv.y()) + height * normal;
            const auto found = heights.at(point);
            ASSERT_TRUE(found);
            EXPECT_NEAR(*found, height, 1e-6);
        }
    }
    const Vec3 beside = setup.patch.position(0.0, 0.0) - Vec3(20.0, 20.0, 0.0);
    EXPECT_FALSE(heights.at(beside));
}

TEST(StockSimulation, TellsWhatTheProgramLeaves) {
    StockSimulation simulation(dome_job(), {});
    const StockResult& result = *simulation.result();
    EXPECT_GT(result.cut.removed_volume(), 0.0);
    EXPECT_LT(result.cut.removed_volume(), result.cut.stock_volume);
    EXPECT_EQ(result.points.size(), result.deviations.size());
    const auto summary = simulation::summary_of(result.points, result.deviations, 0.1);
    ASSERT_TRUE(summary.excess);
    EXPECT_GT(summary.in_excess, 0.2) << "six tracks of a ball leave scallops";
    EXPECT_GT(result.engagement.feed_time, 0.0);
    EXPECT_EQ(result.cut.field, nullptr);
}

TEST(StockSimulation, GoesToAnyBlockAndBack) {
    StockSimulation simulation(dome_job(), {});
    const int all = dome_job().program->block_count();
    const StockPicture whole = simulation.picture_before(all, {});
    const StockPicture uncut = simulation.picture_before(0, {});
    EXPECT_EQ(uncut.block, 0);
    EXPECT_TRUE(
        std::ranges::all_of(uncut.mesh.moves, [](int move) { return move == simulation::stock_surface; }));
    EXPECT_TRUE(std::ranges::none_of(uncut.heights, [](const auto& height) {
        return height && *height < 0.0;
    })) << "the underside of the stock is no gouge";
    const StockPicture half = simulation.picture_before(all / 2, {});
    EXPECT_NE(half.mesh.points, whole.mesh.points);
    const StockPicture again = simulation.picture_before(all, {});
    EXPECT_EQ(again.mesh.points, whole.mesh.points);
    EXPECT_EQ(again.heights, whole.heights);
}

/// Where the exact figures say that most is left, the picture says it too, to its resolution.
TEST(StockSimulation, ThePictureAgreesWithTheFigures) {
    StockSimulation simulation(dome_job(), {});
    const StockResult& result = *simulation.result();
    const StockPicture picture = simulation.picture_before(dome_job().program->block_count(), {});
    double compared = 0.0, apart = 0.0;
    for (std::size_t n = 0; n < result.points.size(); n += 37) {
        const Vec3 place = result.points[n].point + result.deviations[n].height * result.points[n].normal;
        double nearest = 1e9, height = 0.0;
        for (std::size_t k = 0; k < picture.heights.size(); ++k) {
            const double away = (picture.mesh.points[k] - place).norm();
            if (picture.heights[k] && away < nearest) {
                nearest = away;
                height = *picture.heights[k];
            }
        }
        if (nearest < 1.5) {
            compared += 1.0;
            apart += std::abs(height - result.deviations[n].height);
        }
    }
    ASSERT_GT(compared, 50.0);
    EXPECT_LT(apart / compared, 0.3) << "a fifth of a cell";
}

TEST(StockSimulation, AHolderThatMeetsThePartIsListedWithItsLine) {
    project::Project project = cut_dome();
    project.tool.length_mm = 14.0;
    project.tool.holder_diameter_mm = 80.0;
    project.tool.holder_length_mm = 40.0;
    const StockJob job = job_of(project);
    const StockSimulation simulation(job, {});
    const auto& events = simulation.result()->events;
    const auto found = std::ranges::find_if(events, has_holder);
    ASSERT_NE(found, events.end());
    EXPECT_GT(found->depth, 0.0);
    EXPECT_EQ(found->line, job.listing->line_of_block[static_cast<std::size_t>(found->block)]);
    const StockSimulation without(dome_job(), {});
    EXPECT_TRUE(std::ranges::none_of(without.result()->events, has_holder));
}

TEST(StockSimulation, APointIsRefused) {
    StockJob job = dome_job();
    job.project.tool = {};
    EXPECT_THROW(StockSimulation(job, {}), Error);
}

TEST(StockSimulation, AStockByItsTextTakesThePlaceOfTheBox) {
    StockJob job = dome_job();
    job.settings.stock = "box:30,40,50@-15,-20,-50";
    const StockSimulation simulation(job, {});
    EXPECT_DOUBLE_EQ(simulation.result()->cut.stock_volume, 60'000.0);
    job.settings.stock = "brick";
    EXPECT_THROW(StockSimulation(job, {}), Error);
}

TEST(StockSimulation, WarnsOfAStockThatNoMoveMeetsAndOfATooNarrowTool) {
    EXPECT_TRUE(StockSimulation(dome_job(), {}).result()->warnings.empty());
    StockJob job = dome_job();
    job.settings.stock = "box:30,40,50@300,300,-50";
    job.settings.resolution = 7.0; // wider than the ball's radius of 6 mm
    const StockSimulation simulation(job, {});
    const auto& warnings = simulation.result()->warnings;
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_EQ(warnings[0].message.find("a tool of 12 mm is narrower than two lines"), 0U)
        << warnings[0].message;
    EXPECT_EQ(warnings[1].message.find("no move meets the stock"), 0U) << warnings[1].message;
}

TEST(StockSimulation, TheBoxAroundAFlatPartNeedsAnAllowance) {
    StockJob job = dome_job();
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    net.point(1, 0) = {20.0, 0.0, 0.0};
    net.point(0, 1) = {0.0, 20.0, 0.0};
    net.point(1, 1) = {20.0, 20.0, 0.0};
    job.surface = std::make_shared<const geometry::Surface>(std::vector{geometry::BezierPatch(net)});
    job.settings.allowance = 0.0;
    try {
        const StockSimulation taken(job, {});
        FAIL() << "taken";
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().message, "The part is flat.");
        EXPECT_EQ(error.diagnostic().hint, "Choose an allowance above 0.");
    }
}

TEST(StockForecast, OfAFlatPartSaysThatItCannotBeCut) {
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    net.point(1, 0) = {20.0, 0.0, 0.0};
    net.point(0, 1) = {0.0, 20.0, 0.0};
    net.point(1, 1) = {20.0, 20.0, 0.0};
    const geometry::Surface flat(std::vector{geometry::BezierPatch(net)});
    StockSettings settings;
    settings.allowance = 0.0;
    EXPECT_NE(forecast_of(&flat, settings, {}).fault.find("flat"), std::string::npos);
    settings.allowance = 1.0;
    const StockForecast around = forecast_of(&flat, settings, {});
    EXPECT_TRUE(around.fault.empty());
    EXPECT_GT(around.bytes, 0U);
    settings.stock = "box:10,10,10";
    EXPECT_EQ(forecast_of(nullptr, settings, {}),
              forecast_of(simulation::BoxStock{Vec3::Zero(), Vec3::Constant(10.0)}, {}));
}

TEST(StockWorker, ForecastsInTheBackground) {
    StockWorker worker([] {});
    worker.forecast(dome_job().surface, {});
    worker.wait_idle();
    ASSERT_TRUE(worker.view().forecast);
    const StockForecast before = *worker.view().forecast;
    StockSettings larger;
    larger.allowance = 10.0;
    worker.forecast(dome_job().surface, larger);
    worker.wait_idle();
    EXPECT_GT(worker.view().forecast->resolution, before.resolution) << "a larger box";
    larger.stock = "missing.stl";
    worker.forecast(nullptr, larger);
    worker.wait_idle();
    EXPECT_FALSE(worker.view().forecast);
}

TEST(StockText, AProjectsStockIsItsTextAndBack) {
    project::StockInput input;
    EXPECT_EQ(stock_text(input), input.shape);
    input = with_stock(input, "/parts/block.stl@1,-2,0.25");
    EXPECT_FALSE(input.around_part);
    EXPECT_EQ(input.file, "/parts/block.stl");
    EXPECT_EQ(input.position, Vec3(1.0, -2.0, 0.25));
    EXPECT_EQ(stock_text(input), "/parts/block.stl@1,-2,0.25");
    input = with_stock(input, "cylinder:20,30");
    EXPECT_TRUE(input.file.empty());
    EXPECT_EQ(stock_text(input), "cylinder:20,30");
    EXPECT_THROW((void)with_stock(input, "brick"), Error);
}

TEST(StockText, AMeshFileIsBesideTheProject) {
    namespace fs = std::filesystem;
    const test::ScratchFolder scratch;
    const fs::path folder = scratch.path();
    fs::create_directories(folder / "meshes");
    std::ofstream(folder / "meshes/block.stl") << "solid block\nendsolid block\n";
    const std::string whole = (fs::absolute(folder) / "meshes/block.stl").lexically_normal().string();
    EXPECT_EQ(with_whole_path("meshes/block.stl@1,2,3", folder), whole + "@1,2,3");
    EXPECT_EQ(with_whole_path(whole, {}), whole);
    EXPECT_EQ(with_whole_path("box:9,9,9", {}), "box:9,9,9");
    EXPECT_THROW((void)with_whole_path("meshes/block.stl", {}), Error);
    EXPECT_THROW((void)with_whole_path("brick", folder), Error);
    try {
        (void)with_whole_path("meshes/other.stl", folder);
        FAIL() << "taken";
    } catch (const Error& error) {
        EXPECT_NE(error.diagnostic().message.find("meshes/other.stl"), std::string::npos);
    }
}

TEST(StockSettings, AnotherStockResolutionToleranceOrClearanceNeedsAnotherSimulation) {
    const StockSettings box;
    EXPECT_TRUE(give_the_same(box, box));
    const auto changed = [](StockSettings settings, auto change) {
        change(settings);
        return settings;
    };
    EXPECT_FALSE(give_the_same(box, changed(box, [](StockSettings& s) { s.allowance = 3.0; })));
    EXPECT_FALSE(give_the_same(box, changed(box, [](StockSettings& s) { s.resolution = 0.5; })));
    EXPECT_FALSE(give_the_same(box, changed(box, [](StockSettings& s) { s.tolerance = 0.2; })));
    EXPECT_FALSE(give_the_same(box, changed(box, [](StockSettings& s) { s.clearance = 0.0; })));
    const StockSettings own = changed(box, [](StockSettings& s) { s.stock = "box:9,9,9"; });
    EXPECT_FALSE(give_the_same(box, own));
    EXPECT_FALSE(give_the_same(own, box));
    EXPECT_TRUE(give_the_same(own, changed(own, [](StockSettings& s) { s.allowance = 3.0; })));
}

TEST(StockForecast, GrowsWithTheSquareOfTheResolution) {
    const simulation::Stock stock = simulation::BoxStock{Vec3::Zero(), Vec3(100.0, 100.0, 100.0)};
    const StockForecast coarse = forecast_of(stock, 1.0), fine = forecast_of(stock, 0.5);
    EXPECT_NEAR(static_cast<double>(fine.bytes) / static_cast<double>(coarse.bytes), 4.0, 0.2);
    EXPECT_GT(forecast_of(stock, 1e-3).bytes, fine.most_bytes);
    EXPECT_LE(forecast_of(stock, {}).bytes, fine.most_bytes);
    EXPECT_NEAR(forecast_of(stock, {}).resolution, 0.25, 1e-9);
}

TEST(StockWorker, SimulatesAndShowsTheNewestBlock) {
    StockWorker worker([] {});
    worker.show(3);
    EXPECT_EQ(worker.view().picture, nullptr) << "there is nothing to be seen";
    worker.request(dome_job());
    worker.wait_idle();
    ASSERT_NE(worker.view().result, nullptr);
    for (const int block : {40, 3, 7, 20}) {
        worker.show(block);
    }
    worker.wait_idle();
    ASSERT_NE(worker.view().picture, nullptr);
    EXPECT_EQ(worker.view().picture->block, 20);
    EXPECT_EQ(worker.view().picture->result, worker.view().result);
}

TEST(StockWorker, WhatIsReleasedIsNoLongerDrawn) {
    StockWorker worker([] {});
    worker.request(dome_job());
    worker.wait_idle();
    worker.show(20);
    worker.release();
    worker.wait_idle();
    worker.show(3);
    worker.wait_idle();
    EXPECT_NE(worker.view().result, nullptr);
    EXPECT_EQ(worker.view().picture, nullptr);
    worker.request(dome_job());
    worker.wait_idle();
    worker.show(3);
    worker.wait_idle();
    ASSERT_NE(worker.view().picture, nullptr);
    EXPECT_EQ(worker.view().picture->block, 3);
}

TEST(StockWorker, WhatIsCancelledOrFailsLeavesTheLastResult) {
    StockWorker worker([] {});
    worker.request(dome_job());
    worker.wait_idle();
    const auto before = worker.view().result;
    ASSERT_NE(before, nullptr);
    worker.request(dome_job());
    worker.cancel();
    worker.wait_idle();
    EXPECT_EQ(worker.view().result, before);
    StockJob wrong = dome_job();
    wrong.settings.resolution = 1e-3;
    worker.request(wrong);
    worker.wait_idle();
    EXPECT_EQ(worker.view().result, before);
    ASSERT_TRUE(worker.view().failure);
    EXPECT_NE(worker.view().failure->message.find("MB"), std::string::npos);
    worker.show(2);
    worker.wait_idle();
    EXPECT_TRUE(worker.view().failure)
        << "a picture of the last result does not change why the next one failed";
}

} // namespace
} // namespace millwright::plan
