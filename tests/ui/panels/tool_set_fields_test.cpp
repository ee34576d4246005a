// The constants of the thesis's machine in the Toolpath workspace.
#include "tests/ui/panels/person.h"

#include <gtest/gtest.h>

namespace millwright::panels {
namespace {

using test::dome_project;
using test::Person;

TEST(ToolSetFields, ChangeTheMachineAndGoBackToItsFile) {
    Person person({1600, 1400});
    person.press_key(render::Key::f4);
    person.wait_idle();
    const auto mean = [&] { return person.workshop().look().shown()->closest.mean; };
    const double before = mean();
    EXPECT_TRUE(person.sees("inspector/setup/tool_set/AB"));
    EXPECT_FALSE(person.sees("inspector/setup/tool_set/file"));
    person.fill_in("inspector/setup/tool_set/AB", "230");
    person.wait_idle();
    ASSERT_TRUE(person.project().machine.tool_set);
    EXPECT_EQ(*person.project().machine.tool_set,
              (project::ToolSetInput{.e = 0.08, .OF = 119.644, .AB = 230.0, .B4 = 371.943}));
    EXPECT_NE(mean(), before);
    person.keep("tool-set");
    person.click("inspector/setup/tool_set/file");
    person.wait_idle();
    EXPECT_FALSE(person.project().machine.tool_set);
    EXPECT_EQ(mean(), before);
    person.fill_in("inspector/setup/tool_set/e", "0.5");
    person.wait_idle();
    person.choose("inspector/setup/machine", "ac-table");
    person.wait_idle();
    EXPECT_FALSE(person.project().machine.tool_set) << "another machine has none";
    EXPECT_FALSE(person.sees("inspector/setup/tool_set/AB"));
}

} // namespace
} // namespace millwright::panels
