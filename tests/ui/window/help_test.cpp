// The window of help, by real keys and mouse; U1 of the list of what replaces the program of Saengsasri,
// Nittayachin 1996: its menus named a help that was not there.
#include "tests/ui/person/person.h"
#include "ui/window/manual.h"
#include "ui/workspaces/arm_workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

namespace millwright::panels {
namespace {

using actions::HelpPage;
using actions::Workspace;
using test::Person;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using widgets::ReadingBlock;
using widgets::ReadingKind;

TEST(Manual, ReadsHeadingsParagraphsListsTablesAndLinesToBeTyped) {
    const auto blocks =
        reading_of("# Arms\n\nA *held* jog, see\n[there](arm.md#jog) and `I130=*`.\n\n"
                   "![A picture](images/arm.png)\n\n- one\n  goes on\n- **two**\n\n"
                   "    millwright emulate pmac\n\n| Key | |\n|---|---|\n| `a|b` | does * it |\n");
    EXPECT_THAT(blocks,
                ElementsAre(ReadingBlock{ReadingKind::heading, {"Arms"}},
                            ReadingBlock{ReadingKind::paragraph, {"A held jog, see there and I130=*."}},
                            ReadingBlock{ReadingKind::item, {"one goes on"}},
                            ReadingBlock{ReadingKind::item, {"two"}},
                            ReadingBlock{ReadingKind::code, {"millwright emulate pmac"}},
                            ReadingBlock{ReadingKind::head_row, {"Key", ""}},
                            ReadingBlock{ReadingKind::row, {"a|b", "does  it"}}));
}

TEST(Manual, TellsWhereTheLinksOfAPageLead) {
    const auto blocks = reading_of("See [the card](../reference/pmac.md#as-a-machine), [here](#keys), "
                                   "[grid.md](grid.md) or [theirs](https://x.org/a).\n\n| [a](b.md) |\n",
                                   "docs/user");
    EXPECT_THAT(blocks,
                ElementsAre(ReadingBlock{ReadingKind::paragraph,
                                         {"See the card (docs/reference/pmac.md), here, docs/user/grid.md or "
                                          "theirs (https://x.org/a)."}},
                            ReadingBlock{ReadingKind::row, {"a (docs/user/b.md)"}}));
    bool told = false;
    for (const ReadingBlock& block : manual_of(Workspace::arm)) {
        told = told || block.cells.front().find("(docs/reference/pmac.md)") != std::string::npos;
    }
    EXPECT_TRUE(told);
}

TEST(Manual, ShowsFencedLinesAsTheyAre) {
    EXPECT_THAT(reading_of("Type\n\n```sh\nmillwright plan a.json   # *why*\n```\n\nand wait.\n"),
                ElementsAre(ReadingBlock{ReadingKind::paragraph, {"Type"}},
                            ReadingBlock{ReadingKind::code, {"millwright plan a.json   # *why*"}},
                            ReadingBlock{ReadingKind::paragraph, {"and wait."}}));
}

TEST(Manual, CutsASectionOut) {
    constexpr std::string_view page = "# All\n\n## One\na\n### In one\nb\n## Two\nc\n";
    EXPECT_EQ(section_of(page, "## One"), "a\n### In one\nb\n");
    EXPECT_EQ(section_of(page, "## Two"), "c\n");
    EXPECT_EQ(section_of(page, "## Three"), "");
}

TEST(Manual, HasWordsWithoutMarksOfEveryWorkspace) {
    for (int n = 0; n < actions::workspace_count; ++n) {
        const auto blocks = manual_of(static_cast<Workspace>(n));
        EXPECT_GT(blocks.size(), 4U) << n;
        for (const ReadingBlock& block : blocks) {
            for (const std::string& cell : block.cells) {
                EXPECT_THAT(cell, Not(HasSubstr("]("))) << n;
                EXPECT_THAT(cell, Not(HasSubstr("`"))) << n;
            }
        }
    }
    EXPECT_GT(manual_of_commands().size(), 35U);
}

TEST(HelpU1, F1OpensItInEveryWorkspaceAndEscClosesIt) {
    for (const render::PixelSize screen : {render::PixelSize{1600, 1000}, render::PixelSize{1100, 700}}) {
        Person person(screen);
        for (const char* workspace :
             {"view.design", "view.machine", "view.arm", "view.plot", "view.processor"}) {
            person.app().run(workspace);
            person.frames(4);
            const auto cut_before = person.desktop().ui().cut_texts().size();
            person.press_key(render::Key::f1);
            EXPECT_TRUE(person.sees("dialogs/help/text")) << workspace;
            person.keep("help-" + std::string(workspace + 5) + "-" + std::to_string(screen.width));
            EXPECT_EQ(person.desktop().ui().cut_texts().size(), cut_before) << workspace;
            person.press_key(render::Key::f1);
            EXPECT_FALSE(person.sees("dialogs/help/text")) << "the same key closes it";
            person.press_key(render::Key::f1);
            person.press_key(render::Key::escape);
            EXPECT_FALSE(person.sees("dialogs/help/text")) << workspace;
        }
    }
}

TEST(HelpU1, TheMenuLeadsToKeysCommandsAndWhichProgramThisIs) {
    Person person;
    person.app().run("view.arm");
    person.frames(4);
    const std::array<std::pair<const char*, HelpPage>, 4> entries{{{"help_workspace", HelpPage::workspace},
                                                                   {"help_keys", HelpPage::keys},
                                                                   {"help_commands", HelpPage::commands},
                                                                   {"help_about", HelpPage::about}}};
    for (const auto& [entry, page] : entries) {
        person.click("menu/help");
        person.click(std::string("menu/help/") + entry);
        person.frames(3);
        EXPECT_EQ(person.app().view_state().help, page) << entry;
        EXPECT_TRUE(person.sees("dialogs/help/text")) << entry;
        person.keep("help-" + std::string(entry));
        person.click("dialogs/help/close");
        EXPECT_EQ(person.app().view_state().help, HelpPage::none);
    }
    person.press_key(render::Key::f1);
    person.click("dialogs/help/pages/commands");
    EXPECT_EQ(person.app().view_state().help, HelpPage::commands);
}

TEST(HelpU1, NothingMovesBehindIt) {
    Person person;
    person.app().run("view.arm");
    person.frames(4);
    const widgets::Rect button = person.place("hand/jog/plus_1");
    person.hover({button.x + 0.5F * button.w, button.y + 0.5F * button.h});
    person.hold_button(true);
    person.frames(10);
    EXPECT_TRUE(person.app().arm().moving());
    person.press_key(render::Key::f1);
    person.frames(3);
    EXPECT_FALSE(person.app().arm().moving());
    const double there = person.app().arm().joints()[0];
    person.frames(20);
    EXPECT_DOUBLE_EQ(person.app().arm().joints()[0], there);
    person.hold_button(false);
}

/// What its menus named, and did not do: reset, home, position, angle, simulation in one view, start, stop,
/// jogs by position and by angle.
TEST(ArmWorkspaceU1, EveryItemOfTheMenusOfTheThesisIsThere) {
    Person person({1600, 1000});
    person.app().run("view.arm");
    person.frames(4);
    const auto joint = [&](int n) { return person.app().arm().joints()[n]; };
    const auto tip = [&] { return Vec3(person.app().arm().tool().translation()); };

    person.fill_in("inspector/goal/tip/z", "500"); // Setup > Position
    person.click("timeline/arm_go_joints");
    for (int n = 0; n < 60 * 30 && person.app().arm().moving(); ++n) {
        person.frames(1);
    }
    EXPECT_NEAR(tip().z(), 500.0, 1e-6);
    const widgets::Rect slider = person.place("inspector/joints/joint_1"); // Setup > Angle
    person.click_at({slider.x + 0.6F * slider.w, slider.y + 0.5F * slider.h});
    EXPECT_GT(std::abs(joint(0)), 0.05);
    person.click("inspector/joints/arm_home"); // Setup > Home
    EXPECT_LT((tip() - Vec3(800.0, 0.0, 650.0)).norm(), 1e-9);

    for (const char* side :
         {"view_from_above", "view_from_front", "view_from_right"}) { // Simulate > Xy, Xz, Yz
        const widgets::Rect before = person.place("view/tip");
        person.click("menu/view");
        person.hover(person.place("menu/view/look_from").centre());
        person.click(std::string("menu/view/look_from/") + side);
        person.frames(4);
        const widgets::Rect after = person.place("view/tip");
        EXPECT_GT(std::hypot(after.x - before.x, after.y - before.y), 5.0F) << side;
        person.keep("arm-" + std::string(side));
    }

    person.click("lower/tabs/program"); // Run > Start, Stop
    person.frames(2);
    person.click("lower/text");
    person.type("LINEAR ABS FRAX(X) F5\nX40");
    person.frames(3);
    person.click("lower/arm_simulate");
    ASSERT_TRUE(person.live_until([&] { return person.app().arm().moving(); }));
    person.click("timeline/arm_stop");
    EXPECT_FALSE(person.app().arm().moving());

    for (const char* frame : {"hand/jog/frame/joints", "hand/jog/frame/base"}) { // Jog > Angle, Position
        person.click(frame);
        const Vec3 before = tip();
        const bool joints = std::string_view(frame).ends_with("joints");
        const widgets::Rect button = person.place(joints ? "hand/jog/plus_2" : "hand/jog/minus_Z");
        person.hover({button.x + 0.5F * button.w, button.y + 0.5F * button.h});
        person.hold_button(true);
        person.frames(20);
        person.hold_button(false);
        person.frames(3);
        EXPECT_GT((tip() - before).norm(), 1.0) << frame;
    }
    // Reset is for a connected card; without one it says so.
    EXPECT_FALSE(person.app().catalogue().find("machine.reset").permission(person.app().look()).allowed);
}

} // namespace
} // namespace millwright::panels
