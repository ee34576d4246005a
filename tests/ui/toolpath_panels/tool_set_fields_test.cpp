// The constants of the thesis's machine in the Toolpath workspace.
#include "tests/ui/person/person.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::panels {
namespace {

using test::dome_project;
using test::Person;

TEST(ToolSetFields, ChangeTheMachineAndGoBackToItsFile) {
    Person person({1600, 1400});
    person.press_key(render::Key::f4);
    person.wait_idle();
    const auto mean = [&] { return person.app().look().shown()->closest.mean; };
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

// Each field is typed into and changes its own constant; the path follows.
TEST(ToolSetFields, EachOneIsItsOwnConstantOfTheThesis) {
    Person person({1600, 1400});
    person.press_key(render::Key::f4);
    person.wait_idle();
    const auto mean = [&] { return person.app().look().shown()->closest.mean; };
    project::ToolSetInput expected{.e = 0.08, .OF = 119.644, .AB = 251.286, .B4 = 371.943};
    double before = mean();
    const auto fill = [&](const char* id, const char* text) {
        person.fill_in(std::string("inspector/setup/tool_set/") + id, text);
        person.wait_idle();
    };
    fill("OF", "125.5");
    ASSERT_TRUE(person.project().machine.tool_set);
    expected.OF = 125.5;
    EXPECT_EQ(*person.project().machine.tool_set, expected);
    EXPECT_NE(mean(), before);
    before = mean();
    fill("B4", "360");
    expected.B4 = 360.0;
    EXPECT_EQ(*person.project().machine.tool_set, expected);
    EXPECT_NE(mean(), before);
    fill("e", "0.5");
    expected.e = 0.5;
    EXPECT_EQ(*person.project().machine.tool_set, expected);
    fill("AB", "240");
    expected.AB = 240.0;
    EXPECT_EQ(*person.project().machine.tool_set, expected);
    fill("AB", "none");
    EXPECT_EQ(*person.project().machine.tool_set, expected) << "what is no number changes nothing";
    person.press_key(render::Key::escape);
    for (int n = 0; n < 4; ++n) {
        person.app().run("edit.undo");
    }
    EXPECT_FALSE(person.project().machine.tool_set);
}

// a, b and c of the thesis: where the part is on the table.
TEST(ToolSetFields, ThePlaceOfThePartIsTypedInThreeFields) {
    Person person({1600, 1400});
    person.press_key(render::Key::f4);
    person.wait_idle();
    Vec3 expected(-15.0, 0.0, 175.0); // of the machine's file
    int axis = 0;
    for (const char* const id : {"x", "y", "z"}) {
        expected[axis] += 3.5;
        person.fill_in(std::string("inspector/setup/offset/") + id, fmt::format("{}", expected[axis]));
        person.wait_idle();
        ASSERT_TRUE(person.project().machine.workpiece_offset) << id;
        EXPECT_LT((*person.project().machine.workpiece_offset - expected).norm(), 1e-9) << id;
        ++axis;
    }
    const auto planned = person.app().look().plan;
    ASSERT_TRUE(planned && planned->plan.cutting_setup);
    EXPECT_LT((planned->plan.cutting_setup->machine.description().workpiece_offset - expected).norm(), 1e-9)
        << "and it is planned there";
}

} // namespace
} // namespace millwright::panels
