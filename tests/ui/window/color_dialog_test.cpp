// Colours of the view, chosen by a person.
#include "core/base/files.h"
#include "core/project/color_choices.h"
#include "tests/ui/person/person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::panels {
namespace {

using test::Person;

bool shows(const render::Picture& picture, const render::Pixel& wanted) {
    return std::ranges::find(picture.pixels, wanted) != picture.pixels.end();
}

TEST(ColorDialog, GivesTheViewOtherColoursAndKeepsThem) {
    Person person;
    const render::Picture before = person.picture_of("view/iso");
    person.app().run("view.colors");
    person.frames();
    EXPECT_TRUE(person.sees("dialogs/colors/background"));
    person.fill_in("dialogs/colors/background", "#20ff40");
    person.fill_in("dialogs/colors/surface_u", "#ff0000");
    person.fill_in("dialogs/colors/grid_u", "red"); // refused
    person.keep("color-dialog");
    const auto swatch = [&](const std::string& name) {
        const render::Picture picture = person.picture_of("dialogs/colors/" + name + "_swatch");
        return picture.at(picture.size.width / 2, picture.size.height / 2);
    };
    EXPECT_EQ(swatch("background"), (render::Pixel{0x20, 0xff, 0x40, 255}));
    EXPECT_EQ(swatch("surface_u"), (render::Pixel{255, 0, 0, 255}));
    const glm::vec3 plain = 255.0F * render::view_colors(render::Theme::dark).surface;
    EXPECT_NEAR(swatch("surface")[0], plain.r, 1.0F) << "the theme's, where none is chosen";
    EXPECT_NEAR(swatch("surface")[2], plain.b, 1.0F);
    person.press_key(render::Key::escape);
    person.frames(3);
    person.press_key(render::Key::escape);
    person.frames(3);
    EXPECT_FALSE(person.sees("dialogs/colors/background"));
    const render::Picture after = person.picture_of("view/iso");
    EXPECT_FALSE(shows(before, {0x20, 0xff, 0x40, 255}));
    EXPECT_TRUE(shows(after, {0x20, 0xff, 0x40, 255}));
    person.keep("colors-chosen");
    const auto kept = project::read_colors(person.folder() / "colors.json");
    EXPECT_EQ(kept, (project::ColorChoices{{"background", "#20ff40"}, {"surface_u", "#ff0000"}}));
    actions::AppController next({.assets = "assets",
                                 .log_folder = person.folder() / "jobs-2",
                                 .settings = person.folder() / "recent.json",
                                 .recovery = {},
                                 .wake = [] {}});
    EXPECT_EQ(next.view_state().colors, person.app().view_state().colors);
    person.app().run("view.colors");
    person.frames();
    person.click("dialogs/colors/theme");
    person.click("dialogs/colors/close");
    person.frames(3);
    EXPECT_FALSE(shows(person.picture_of("view/iso"), {0x20, 0xff, 0x40, 255}));
    EXPECT_EQ(project::read_colors(person.folder() / "colors.json"), project::ColorChoices{});
}

TEST(ColorDialog, AFileThatIsNoneIsNamedAndDoesNotStopTheStart) {
    Person person;
    write_file(person.folder() / "colors.json", "[{\"layer\": \"surface\"}]");
    actions::AppController next({.assets = "assets",
                                 .log_folder = person.folder() / "jobs-2",
                                 .settings = person.folder() / "recent.json",
                                 .recovery = {},
                                 .wake = [] {}});
    ASSERT_FALSE(next.view_state().notices.empty());
    EXPECT_THAT(next.view_state().notices.back().place, ::testing::HasSubstr("colors.json"));
}

TEST(ObliqueView, IsAnActionAndAKeyInTheView) {
    Person person;
    const render::Picture before = person.picture_of("view/iso");
    person.app().run("view.oblique");
    person.frames(3);
    const render::Picture oblique = person.picture_of("view/iso");
    EXPECT_NE(oblique, before);
    person.keep("view-oblique");
    person.app().run("view.into_space");
    person.frames(3);
    EXPECT_NE(person.picture_of("view/iso"), oblique);
}

TEST(ProducedSurfaceLayer, StandsBesideTheDesignedSurface) {
    Person person({1600, 1000});
    person.press_key(render::Key::f4);
    person.wait_idle();
    person.app().run("view.layer_produced");
    person.frames(3);
    const render::Picture over_the_designed = person.picture_of("view/iso");
    person.keep("produced-over-designed");
    person.app().run("view.layer_surface");
    person.frames(3);
    // The designed surface, within a hundredth of a millimetre of it, hid about half of it.
    EXPECT_LT(render::difference(over_the_designed, person.picture_of("view/iso"), 8).fraction, 0.02);
    person.keep("produced-surface");
    person.choose("inspector/error/beside", "design");
    person.frames(3);
    EXPECT_TRUE(person.sees("view/left/left"));
    EXPECT_NE(person.picture_of("view/left/left"), person.picture_of("view/right/right"));
    person.keep("produced-beside-designed");
}

} // namespace
} // namespace millwright::panels
