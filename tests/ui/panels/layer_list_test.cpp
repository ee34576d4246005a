#include "ui/panels/layer_list.h"

#include "tests/ui/person/person.h"
#include "ui/actions/layer_actions.h"

#include <gtest/gtest.h>

#include <string>

namespace millwright::panels {
namespace {

using actions::Workspace;
using test::dome_project;
using test::Person;
using viewport::layer_switches;
using viewport::Layers;
using viewport::LayerSwitch;

const Layers& shown_layers(Person& person) {
    return person.app().view_state().layers_now();
}

TEST(LayerList, HasARowForEveryLayerThatSwitchesItInThisWorkspaceOnly) {
    Person person;
    person.open(dome_project);
    const Layers of_grid = person.app().view_state().layers[1];
    person.click("view/layers");
    for (const LayerSwitch& which : layer_switches) {
        if (which.of == LayerSwitch::Of::arm) {
            continue;
        }
        const Layers before = shown_layers(person);
        person.click("view/layers/" + std::string(which.id));
        EXPECT_EQ(shown_layers(person), switched(before, which)) << which.id;
        EXPECT_NE(shown_layers(person), before) << which.id;
    }
    EXPECT_EQ(person.app().view_state().layers[1], of_grid);
}

TEST(LayerList, StaysOpenForTheNextLayerAndClosesByAClickElsewhere) {
    Person person;
    person.click("view/layers");
    person.click("view/layers/control_net");
    person.keep("layers-open");
    EXPECT_TRUE(person.sees("view/layers/surface"));
    person.click("outline");
    EXPECT_FALSE(person.sees("view/layers/surface"));
}

TEST(LayerList, AHiddenLayerIsGoneFromThePictureAndComesBack) {
    Person person;
    person.open(dome_project);
    const render::Picture with = person.picture_of("view/iso");
    EXPECT_TRUE(person.sees("view/control_point(1,1)"));
    person.app().run("view.layer_control_net");
    person.frames();
    EXPECT_NE(person.picture_of("view/iso"), with);
    EXPECT_FALSE(person.sees("view/control_point(1,1)"));
    person.app().run("view.layer_control_net");
    person.frames();
    EXPECT_EQ(person.picture_of("view/iso"), with);
}

TEST(LayerList, GoesBackToTheUsualLayers) {
    Person person;
    const Layers usual = shown_layers(person);
    person.click("view/layers");
    person.click("view/layers/surface");
    person.click("view/layers/tool_axes");
    ASSERT_NE(shown_layers(person), usual);
    person.click("view/layers/usual");
    EXPECT_EQ(shown_layers(person), usual);
    EXPECT_FALSE(person.sees("view/layers/surface"));
}

TEST(LayerList, TheWeightIsShownFromTheGridPanelAndFollowsTheFormula) {
    Person person;
    person.open(dome_project);
    person.press_key(render::Key::f3);
    person.frames(2);
    EXPECT_FALSE(person.sees("view/weight_legend"));
    person.click("inspector/tracks"); // folded away, so that all of the next section is in sight
    person.click("inspector/elliptic/show_weight");
    EXPECT_TRUE(shown_layers(person).colored.weight);
    EXPECT_TRUE(person.sees("view/weight_legend"));
    const render::Picture of_error = person.picture_of("view/iso");
    person.keep("weight-of-the-error");
    person.app().edit("Choose the weight",
                      [](project::Project& p) { p.grid.elliptic.weight = project::WeightSource::expression; },
                      {});
    person.wait_idle();
    EXPECT_NE(person.picture_of("view/iso"), of_error);
    person.keep("weight-of-a-formula");
    EXPECT_TRUE(person.desktop().ui().cut_texts().empty());
}

TEST(LayerList, IsInTheViewMenuToo) {
    Person person;
    person.click("menu/view");
    person.hover(person.place("menu/view/layers").centre());
    ASSERT_TRUE(person.sees("menu/view/layers/floor"));
    person.keep("layers-menu");
    EXPECT_LE(person.place("menu/view/layers/colors").bottom(), 800.0F);
    const bool before = shown_layers(person).floor;
    person.click("menu/view/layers/floor");
    EXPECT_NE(shown_layers(person).floor, before);
    person.hover(person.place("menu/view/view_fit").centre());
    EXPECT_FALSE(person.sees("menu/view/layers/floor"));
    EXPECT_TRUE(person.sees("menu/view/view_fit"));
}

TEST(LayerList, IsFoundInThePaletteByTheNameOfALayer) {
    Person person;
    const bool before = shown_layers(person).machine.singular_points;
    person.press_key(render::Key::k, true);
    person.type("singular");
    person.press_key(render::Key::enter);
    EXPECT_NE(shown_layers(person).machine.singular_points, before);
}

TEST(LayerList, CutsNoTextAndFitsTheSmallWindow) {
    Person person;
    person.click("view/layers");
    for (const LayerSwitch& which : layer_switches) {
        if (which.of == LayerSwitch::Of::arm) {
            EXPECT_FALSE(person.sees("view/layers/" + std::string(which.id)));
            continue;
        }
        const widgets::Rect row = person.place("view/layers/" + std::string(which.id));
        EXPECT_GE(row.y, 0.0F);
        EXPECT_LE(row.bottom(), 800.0F) << which.id;
    }
    EXPECT_LE(person.place("view/layers/usual").bottom(), 800.0F);
    EXPECT_TRUE(person.desktop().ui().cut_texts().empty());
}

} // namespace
} // namespace millwright::panels
