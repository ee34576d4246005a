// What the window keeps from one run to the next.
#include "core/base/files.h"
#include "core/project/window_settings.h"
#include "tests/support/scratch_folder.h"
#include "tests/ui/person/person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::panels {
namespace {

using render::Key;
using test::Person;

/// Quits as a person does, and says yes to nothing.
void quit(Person& person) {
    person.press_key(Key::q, true);
    ASSERT_TRUE(person.app().view_state().quit);
    person.app().close();
}

// After a clean quit everything was as at the first start.
TEST(WindowMemory, TheNextStartBeginsAsTheLastOneEnded) {
    const test::ScratchFolder scratch;
    float inspector = 0.0F;
    {
        Person person({1280, 800}, {}, {}, scratch.path());
        person.press_key(Key::k, true);
        person.frames(3);
        person.type("light theme");
        person.press_key(Key::enter);
        person.app().run("view.outline");
        person.frames(2);
        const widgets::Rect bar = person.place("splitters/inspector");
        person.drag(bar.centre(), {bar.centre().x - 60.0F, bar.centre().y});
        inspector = person.app().view_state().panes.inspector;
        EXPECT_GT(inspector, actions::PaneSizes().inspector + 30.0F);
        person.app().run("view.machine");
        person.frames(3);
        person.choose("inspector/connection/driver", "grbl");
        person.fill_in("inspector/connection/address", "/dev/ttyUSB7");
        person.app().view_state().window = {{1500, 900}, false}; // as the app looks at it
        quit(person);
    }
    Person person({1280, 800}, {}, {}, scratch.path());
    const actions::ViewState& view_state = person.app().view_state();
    EXPECT_EQ(view_state.theme, widgets::Theme::light);
    EXPECT_FALSE(view_state.panes.outline_shown);
    EXPECT_FLOAT_EQ(view_state.panes.inspector, inspector);
    EXPECT_EQ(view_state.manual.choice.driver, "grbl");
    EXPECT_EQ(view_state.manual.choice.address, "/dev/ttyUSB7");
    EXPECT_EQ(view_state.window.size, (render::PixelSize{1500, 900}));
    EXPECT_FALSE(person.app().look().connection.connected()); // nothing is connected unasked
    EXPECT_FLOAT_EQ(person.place("inspector").w, inspector);
}

TEST(WindowMemory, ABrokenFileIsSaidAndReplaced) {
    const test::ScratchFolder scratch;
    const auto file = project::window_settings_place(scratch / "recent.json");
    write_file(file, "[{\"name\": ");
    {
        Person person({1280, 800}, {}, {}, scratch.path());
        EXPECT_THAT(person.app().view_state().log, testing::Contains(testing::HasSubstr("window.json")));
        person.app().run("view.theme");
        quit(person);
    }
    EXPECT_EQ(project::read_window_settings(file).at("theme"), "light");
}

TEST(WindowMemory, TwoWindowsKeepWhatEachHasChanged) {
    const test::ScratchFolder scratch;
    Person first({1280, 800}, {}, {}, scratch.path());
    {
        actions::AppController second({.assets = "assets",
                                       .log_folder = scratch / "jobs",
                                       .settings = scratch / "recent.json",
                                       .recovery = {},
                                       .wake = [] {}});
        second.run("view.theme");
        second.close();
    }
    first.app().run("view.lower");
    quit(first);
    const auto kept = project::read_window_settings(project::window_settings_place(scratch / "recent.json"));
    EXPECT_EQ(kept.at("theme"), "light");
    EXPECT_EQ(kept.at("panes.lower_shown"), "off");
}

} // namespace
} // namespace millwright::panels
