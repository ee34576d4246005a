#include "ui/window/path_series.h"

#include "tests/ui/person/person.h"
#include "ui/window/view_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

namespace millwright::panels {
namespace {

using project::GridMethod;
using test::Person;
using ::testing::ElementsAre;
using toolpath::MoveKind;

/// Three moves of 10, 4 and 6 mm; the second goes from track to track.
plan::Evaluation three_moves() {
    plan::Evaluation evaluation{{grid::Grid::uniform(2, 2)}, {}, {}, {}, {}, {}, {}, {}};
    evaluation.field.moves = {{.kind = MoveKind::track, .closest = 0.1, .length = 10.0},
                              {.kind = MoveKind::cross, .closest = 9.0, .length = 4.0},
                              {.kind = MoveKind::track, .closest = 0.3, .length = 6.0}};
    return evaluation;
}

TEST(PathSeries, StandsInTheMiddleOfEachMoveAndLeavesOutTheWayFromTrackToTrack) {
    const ErrorOverPath series = error_over_path(three_moves());
    EXPECT_EQ(series.at, (std::vector<double>{5.0, 12.0, 17.0}));
    EXPECT_EQ(series.error[0], 0.1);
    EXPECT_TRUE(std::isnan(series.error[1]));
    EXPECT_EQ(series.error[2], 0.3);
}

TEST(PathSeries, MeasuresTheWayUpToAPlaceInAMove) {
    EXPECT_EQ(length_before(three_moves(), -1, 0.5), 0.0);
    EXPECT_EQ(length_before(three_moves(), 0, 0.5), 5.0);
    EXPECT_EQ(length_before(three_moves(), 2, 0.5), 17.0);
    EXPECT_EQ(length_before(three_moves(), 3, 0.0), 20.0);
}

class PlottedPaths : public ::testing::Test {
protected:
    PlottedPaths() {
        person_.open("assets/projects/dome.json"); // whose program follows the optimised tracks
        person_.app().edit("Change the grid", [](project::Project& p) { p.grid.nu = p.grid.nv = 8; }, {});
        person_.press_key(render::Key::f4);
        person_.wait_idle();
    }

    /// The last one is what the view draws, whatever is done.
    [[nodiscard]] std::vector<std::string> names() {
        const actions::FrameState now = person_.app().look();
        std::vector<std::string> names;
        for (const PlottedPath& path : plotted_paths(now)) {
            names.push_back(path.name);
        }
        if (!names.empty()) {
            EXPECT_EQ(plotted_paths(now).back().path, scene_of(now).shown);
        }
        return names;
    }
    void run(const char* action) {
        person_.app().run(action);
        person_.frames();
        person_.wait_idle();
    }

    Person person_{{1600, 1000}};
};

TEST_F(PlottedPaths, AreThatOnScreenAndTheUniformOneToCompareItWith) {
    EXPECT_THAT(names(), ElementsAre("Uniform", "Track optimiser, program path"));
    person_.keep("plotted-program");
    run("view.show_elliptic");
    EXPECT_THAT(names(), ElementsAre("Uniform", "Elliptic (same as uniform)"));
    run("view.show_uniform");
    EXPECT_THAT(names(), ElementsAre("Uniform"));
    person_.choose("inspector/error/beside", "elliptic");
    EXPECT_THAT(names(), ElementsAre("Elliptic (same as uniform)", "Uniform"));
    person_.frames();
    person_.keep("plotted-beside");
    person_.press_key(render::Key::f3);
    EXPECT_THAT(names(), ElementsAre("Uniform")) << "nothing stands beside it there";
}

TEST_F(PlottedPaths, OfAGridThatIsOnlyWatchedThereIsNoneAndTheProgramsStands) {
    run("grid.adapt");
    EXPECT_THAT(names(), ElementsAre("Uniform", "Elliptic (same as uniform)"));
    run("grid.chain"); // the second one that is watched has no path
    EXPECT_THAT(names(), ElementsAre("Uniform", "Track optimiser, program path"));
    person_.keep("plotted-watched");
    person_.press_key(render::Key::f4);
    EXPECT_THAT(names(), ElementsAre("Uniform", "Track optimiser, program path"));
    run("path.spiral");
    run("grid.adapt");
    run("grid.use_elliptic");
    ASSERT_EQ(person_.project().grid.method, GridMethod::elliptic);
    EXPECT_THAT(names(), ElementsAre("Uniform", "Spiral, program path"));
}

TEST_F(PlottedPaths, AreMarkedSoFarAndNoneWhereAFileIsOnScreen) {
    actions::FrameState now = person_.app().look();
    plan::PublishedPlan plan = *now.plan;
    plan::Evaluation coarse = *plan.plan.grid(GridMethod::tracks).evaluation;
    coarse.outcome.status = grid::OptimiserStatus::running;
    plan.plan.grid(GridMethod::tracks).evaluation =
        std::make_shared<const plan::Evaluation>(std::move(coarse));
    now.plan = std::make_shared<const plan::PublishedPlan>(std::move(plan));
    EXPECT_EQ(plotted_paths(now).back().name, "Track optimiser, program path (preliminary)");
    const auto file = person_.folder() / "part.ngc";
    std::ofstream(file) << "G21 G90 F600\nG1 X10\nM2\n";
    person_.open(file);
    EXPECT_TRUE(names().empty());
    person_.press_key(render::Key::f4);
    EXPECT_EQ(names().size(), 2U);
}

/// Its moves are not the program's: a click goes nowhere.
TEST_F(PlottedPaths, OnlyTheProgramsTakesTheTimelineAlong) {
    const auto plot = person_.place("lower/error");
    const widgets::Point late{plot.x + 0.8F * plot.w, plot.y + 0.5F * plot.h};
    run("view.show_uniform");
    const double before = person_.app().view_state().playback.time;
    person_.click_at(late);
    EXPECT_EQ(person_.app().view_state().playback.time, before);
    run("view.show_tracks");
    person_.click_at(late);
    EXPECT_GT(person_.app().view_state().playback.time, before);
}

} // namespace
} // namespace millwright::panels
