#include "ui/render/view_colors.h"

#include "ui/render/color_map.h"

#include <gtest/gtest.h>

namespace millwright::render {
namespace {

// WCAG 2.1: text 4.5, large text and marks 3.
constexpr double text_contrast = 4.5;
constexpr double mark_contrast = 3.0;

class EachTheme : public ::testing::TestWithParam<Theme> {};

TEST_P(EachTheme, HasReadableText) {
    const ViewColors colors = view_colors(GetParam());
    for (const std::size_t ground : {0U, 1U, 2U}) {
        EXPECT_GT(contrast(colors.neutral[7], colors.neutral[ground]), 7.0);
        EXPECT_GT(contrast(colors.neutral[6], colors.neutral[ground]), text_contrast);
        EXPECT_GT(contrast(colors.danger, colors.neutral[ground]), mark_contrast);
        EXPECT_GT(contrast(colors.warning, colors.neutral[ground]), mark_contrast);
        EXPECT_GT(contrast(colors.good, colors.neutral[ground]), mark_contrast);
        EXPECT_GT(contrast(colors.accent, colors.neutral[ground]), mark_contrast);
    }
    EXPECT_GT(contrast(colors.on_accent, colors.accent), text_contrast);
}

TEST_P(EachTheme, HasANeutralRampThatNeverTurns) {
    const ViewColors colors = view_colors(GetParam());
    for (std::size_t i = 1; i < colors.neutral.size(); ++i) {
        EXPECT_GT(contrast(colors.neutral[i], colors.neutral[0]),
                  contrast(colors.neutral[i - 1], colors.neutral[0]));
    }
}

TEST_P(EachTheme, KeepsTheMarksOfTheViewOffItsBackground) {
    const ViewColors colors = view_colors(GetParam());
    for (const glm::vec3& background : {colors.background_top, colors.background_bottom}) {
        for (const glm::vec3& mark : {colors.net, colors.handle, colors.path, colors.axis_x, colors.axis_y}) {
            EXPECT_GT(contrast(mark, background), 2.4);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(ViewColors, EachTheme, ::testing::Values(Theme::dark, Theme::light));

TEST(ViewColors, TakesChosenColoursInPlaceOfTheThemes) {
    LayerColors chosen;
    EXPECT_EQ(view_colors(Theme::dark, chosen).surface, view_colors(Theme::dark).surface);
    chosen.set(LayerColor::background, color_from("#FF8000"));
    chosen.set(LayerColor::grid_u, color_from("#010203"));
    const ViewColors colors = view_colors(Theme::light, chosen);
    EXPECT_EQ(color_text(colors.background_top), "#ff8000");
    EXPECT_EQ(colors.background_bottom, colors.background_top);
    EXPECT_EQ(color_text(*colors.chosen.of(LayerColor::grid_u)), "#010203");
    EXPECT_EQ(colors.path, view_colors(Theme::light).path);
    for (const char* wrong : {"", "#fff", "ff8000", "#ff80001", "#gg8000", "#ff80 0", "#-12345"}) {
        EXPECT_FALSE(color_from(wrong)) << wrong;
    }
    for (std::size_t n = 0; n < layer_color_infos().size(); ++n) {
        EXPECT_EQ(static_cast<std::size_t>(layer_color_infos()[n].which), n);
    }
}

// What is written and marked on a background of one's own is seen, whatever the theme is.
TEST(ViewColors, AreSeenOnAnyChosenBackground) {
    for (const Theme theme : {Theme::dark, Theme::light}) {
        for (const char* background : {"#ffffff", "#000000", "#f0f0e8", "#202830"}) {
            LayerColors chosen;
            chosen.set(LayerColor::background, color_from(background));
            const ViewColors colors = view_colors(theme, chosen);
            EXPECT_GT(contrast(ink(colors), colors.background_top), 7.0) << background;
            EXPECT_GT(contrast(faint_ink(colors), colors.background_top), text_contrast) << background;
            for (const glm::vec3& mark :
                 {colors.net, colors.handle, colors.path, colors.axis_x, colors.axis_y, colors.axis_z}) {
                EXPECT_GT(contrast(mark, colors.background_top), 2.4)
                    << background << " " << color_text(mark);
            }
        }
    }
    for (const Theme theme : {Theme::dark, Theme::light}) {
        EXPECT_EQ(ink(view_colors(theme)), view_colors(theme).neutral.back());
    }
    LayerColors chosen;
    chosen.set(LayerColor::background, color_from("#ffffff"));
    chosen.set(LayerColor::toolpath, color_from("#fefefe"));
    EXPECT_EQ(color_text(view_colors(Theme::dark, chosen).path), "#fefefe") << "a person may want that";
}

} // namespace
} // namespace millwright::render
