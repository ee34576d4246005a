#include "core/base/error.h"
#include "core/project/level_settings.h"
#include "core/project/plot_choices.h"
#include "core/project/plot_settings.h"
#include "core/project/tool_settings.h"

#include <gtest/gtest.h>

#include <cctype>
#include <random>
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
        EXPECT_DOUBLE_EQ(setting.value(owner), setting.max) << setting.id;
    }
}

TEST(Settings, EveryNumberHasARangeThatHoldsItsDefault) {
    expect_sound(grid_numbers());
    expect_sound(redistribution_numbers());
    expect_sound(elliptic_numbers());
    expect_sound(region_numbers());
    expect_sound(toolpath_numbers());
    expect_sound(tracks_numbers());
    expect_sound(chain_numbers());
    expect_sound(sequencing_numbers());
    expect_sound(program_numbers());
    expect_sound(tool_numbers());
    expect_sound(plot_numbers());
    expect_sound(level_numbers());
}

TEST(Settings, WhatAPersonTypedComesBackAsItWasTyped) {
    plot::Level level;
    const auto& feed = level_number("feed_mm_per_min");
    for (int tenths = 10; tenths < 100'000; tenths += 7) {
        const double typed = tenths / 10.0;
        feed.set(level, typed);
        EXPECT_EQ(feed.value(level), typed);
        EXPECT_NEAR(level.cutting, typed / 60.0, 1e-12 * typed);
    }
    PlotSettings settings;
    const auto& angle = plot_number("hatch_angle_deg");
    for (int hundredths = -18'000; hundredths <= 18'000; ++hundredths) {
        const double typed = hundredths / 100.0;
        angle.set(settings, typed);
        EXPECT_EQ(angle.value(settings), typed);
    }
}

TEST(Settings, WhateverWasToldComesBackToTheLastBit) {
    std::mt19937 random(2006);
    std::uniform_real_distribution<double> told(1.0, 1e5);
    plot::Level level;
    const auto& feed = level_number("feed_mm_per_min");
    PlotSettings settings;
    const auto& angle = plot_number("hatch_angle_deg");
    for (int n = 0; n < 10'000; ++n) {
        feed.set(level, told(random));
        const double speed = level.cutting;
        feed.set(level, feed.value(level));
        EXPECT_EQ(level.cutting, speed);
        angle.set(settings, told(random) / 1000.0);
        const double rad = settings.strokes.hatch_angle;
        angle.set(settings, angle.value(settings));
        EXPECT_EQ(settings.strokes.hatch_angle, rad);
    }
}

TEST(Settings, OfPlotsSayNoneWithAZero) {
    PlotSettings settings;
    const auto& hatch = plot_number("hatch_mm");
    hatch.set(settings, 1.5875);
    EXPECT_EQ(settings.strokes.hatch_pitch, 1.5875);
    hatch.set(settings, 0.0);
    EXPECT_FALSE(settings.strokes.hatch_pitch);
    EXPECT_THROW((void)plot_number("no such"), Defect);
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
    expect_distinct(picture_uses());
    expect_distinct(gray_rules());
    expect_distinct(tip_kinds());
    expect_distinct(cutter_sides());
    expect_distinct(corner_kinds());
    expect_distinct(fill_modes());
    expect_distinct(line_ends());
    expect_distinct(turn_policies());
}

TEST(Settings, FaultyAnglesSayThatTheyAre) {
    for (const auto& mode : angle_modes()) {
        const bool faulty = mode.value != kinematics::AngleMode::consistent;
        EXPECT_EQ(mode.tip.find("regression") != std::string_view::npos, faulty) << mode.id;
    }
}

} // namespace
} // namespace millwright::project
