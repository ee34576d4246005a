#include "ui/design_panels/no_gain_notes.h"

#include "tests/ui/person/person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::panels {
namespace {

using project::GridMethod;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

TEST(NoGainNotes, TellWhyAGridBesideTheProgramsIsTheUniformOne) {
    test::Person person{{1600, 1400}};
    person.open("assets/projects/dome.json");
    person.press_key(render::Key::f3);
    const auto change = [&](int nodes, GridMethod method) {
        person.app().edit("Change the grid",
                          [&](project::Project& p) {
                              p.grid.nu = p.grid.nv = nodes;
                              p.grid.method = method;
                          },
                          {});
        person.wait_idle();
    };
    change(5, GridMethod::tracks);
    ASSERT_EQ(person.app().look().evaluation(GridMethod::elliptic)->outcome.status,
              grid::OptimiserStatus::no_gain);
    EXPECT_THAT(no_gain_notes(person.app().look()),
                ElementsAre(StartsWith("Elliptic, same as uniform: No grid was better than the start grid")));
    person.keep("grid-no-gain");
    change(5, GridMethod::elliptic); // whose note is that of the program
    EXPECT_THAT(no_gain_notes(person.app().look()), IsEmpty());
    change(20, GridMethod::tracks); // where the elliptic grid is a better one
    EXPECT_THAT(no_gain_notes(person.app().look()), IsEmpty());
}

} // namespace
} // namespace millwright::panels
