// The norm of every iteration in the Grid workspace.
#include "tests/ui/person/person.h"

#include <gtest/gtest.h>

namespace millwright::panels {
namespace {

using test::Person;

TEST(NormPlot, StandsBelowAnAdaptationThatIsWatchedAndAGridThatWasMade) {
    Person person({1600, 1400});
    person.press_key(render::Key::f3);
    person.wait_idle();
    EXPECT_TRUE(person.sees("inspector/elliptic/norms")) << "of the elliptic grid that was made to compare";
    person.app().edit(
        "Refresh seldom", [](project::Project& p) { p.grid.elliptic.iterations_per_step = 25; }, {});
    person.wait_idle();
    person.click("inspector/watch/grid_adapt");
    person.wait_idle();
    const auto watched = person.app().look().watched;
    ASSERT_TRUE(watched && watched->state);
    EXPECT_EQ(static_cast<int>(watched->state->norms.size()), watched->state->iteration);
    EXPECT_TRUE(person.sees("inspector/watch/norms"));
    EXPECT_FALSE(person.sees("inspector/elliptic/norms"));
    person.keep("grid-norms");
}

TEST(NormPlot, AStepHasTheIterationsOfTheSetting) {
    Person person({1600, 1400});
    person.app().edit(
        "Refresh seldom", [](project::Project& p) { p.grid.elliptic.iterations_per_step = 7; }, {});
    person.press_key(render::Key::f3);
    person.wait_idle();
    person.app().run("grid.adapt");
    person.app().run("grid.pause");
    person.wait_idle();
    person.app().run("grid.reset");
    person.wait_idle();
    person.app().run("grid.step");
    person.wait_idle();
    const auto watched = person.app().look().watched;
    ASSERT_TRUE(watched && watched->state);
    EXPECT_EQ(watched->state->iteration, 7);
}

} // namespace
} // namespace millwright::panels
