#include "ui/viewport/layer_switches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace millwright::viewport {
namespace {

TEST(LayerSwitches, SwitchOneLayerEachAndTheirIdsAreUnique) {
    std::set<std::string_view> ids;
    for (const LayerSwitch& which : layer_switches) {
        EXPECT_TRUE(ids.insert(which.id).second);
        Layers layers;
        layers = switched(switched(layers, which), which);
        EXPECT_EQ(layers, Layers{}) << which.id;
    }
}

TEST(LayerSwitches, OfWhatColoursTheSurfaceOnlyOneIsOn) {
    const auto find = [](std::string_view id) {
        return *std::ranges::find(layer_switches, id, &LayerSwitch::id);
    };
    Layers layers = switched(Layers{}, find("error_surface"));
    layers = switched(layers, find("weight"));
    EXPECT_TRUE(layers.colored.weight);
    EXPECT_FALSE(layers.colored.errors);
    layers = switched(layers, find("error_surface"));
    EXPECT_FALSE(layers.colored.weight);
    EXPECT_TRUE(layers.colored.errors);
    layers = switched(layers, find("produced")); // which lies in nearly the same place
    EXPECT_TRUE(layers.design.produced);
    EXPECT_FALSE(layers.colored.errors);
}

} // namespace
} // namespace millwright::viewport
