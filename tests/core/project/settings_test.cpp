#include "core/project/settings.h"

#include <gtest/gtest.h>

#include <cctype>
#include <set>

namespace millwright::project {
namespace {

template <class Owner> void expect_sound(std::span<const NumberSetting<Owner>> settings) {
    std::set<std::string_view> ids;
    for (const auto& setting : settings) {
        EXPECT_TRUE(ids.insert(setting.id).second) << setting.id;
        EXPECT_LT(setting.min, setting.max) << setting.id;
        EXPECT_GE(setting.default_value(), setting.min) << setting.id;
        EXPECT_LE(setting.default_value(), setting.max) << setting.id;
        EXPECT_TRUE(std::isupper(setting.label.front())) << setting.id;
        EXPECT_FALSE(setting.tip.empty()) << setting.id;
        EXPECT_EQ(setting.whole(), setting.decimals == 0 && setting.id != "spindle_rpm") << setting.id;
        Owner owner;
        setting.set(owner, setting.max);
        EXPECT_EQ(setting.value(owner), setting.max) << setting.id;
    }
}

TEST(Settings, EveryNumberHasARangeThatHoldsItsDefault) {
    expect_sound(grid_numbers());
    expect_sound(elliptic_numbers());
    expect_sound(tracks_numbers());
    expect_sound(chain_numbers());
    expect_sound(program_numbers());
}

TEST(Settings, WholeNumbersTakeTheNearest) {
    GridInput grid;
    grid_numbers().front().set(grid, 7.9999);
    EXPECT_EQ(grid.nu, 8);
}

template <class Value> void expect_distinct(std::span<const Choice<Value>> choices) {
    std::set<std::string_view> ids;
    for (const auto& choice : choices) {
        EXPECT_TRUE(ids.insert(choice.id).second) << choice.id;
        EXPECT_EQ(&row_of(choices, choice.value), &choice) << choice.id;
    }
}

TEST(Settings, EveryChoiceHasItsOwnRow) {
    expect_distinct(track_directions());
    expect_distinct(grid_methods());
    expect_distinct(weight_sources());
    expect_distinct(links());
    expect_distinct(angle_modes());
}

TEST(Settings, FaultyAnglesSayThatTheyAre) {
    for (const auto& mode : angle_modes()) {
        const bool faulty = mode.value != kinematics::AngleMode::consistent;
        EXPECT_EQ(mode.tip.find("regression") != std::string_view::npos, faulty) << mode.id;
    }
}

} // namespace
} // namespace millwright::project
