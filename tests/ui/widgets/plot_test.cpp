// Curves over an axis, and their legend.
#include "core/base/error.h"
#include "tests/ui/stage/stage.h"
#include "tests/ui/widgets/whole_screen.h"
#include "ui/widgets/internal/curve.h"
#include "ui/widgets/widgets.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace millwright::widgets {
namespace {

using test::Stage;
using test::whole_screen;

class Plot : public testing::Test {
protected:
    std::vector<double> x{0.0, 1.0, 2.0, 3.0, 4.0};
    std::vector<double> y{1.0, 3.0, 2.0, 5.0, 4.0};
    bool is_log = false;
    std::optional<double> clicked;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("plots", whole_screen);
        const Series series{"Error", x, y, 0, true};
        if (const auto at = line_plot(ui,
                                      "error",
                                      {.x_label = "Path",
                                       .y_label = "Error",
                                       .series = std::span(&series, 1),
                                       .cursor_x = 1e300,
                                       .limit_y = -1.0,
                                       .y_is_log = is_log,
                                       .height = 200.0F})) {
            clicked = at;
        }
    }};
};

TEST(PlotLooks, OfSeveralDozenCurvesNoTwoAreDrawnAlike) {
    const std::vector<Series> many(36);
    for (const Theme theme : {Theme::dark, Theme::light}) {
        std::set<std::pair<Colour, Stroke>> looks;
        for (const Series& series : with_looks(palette(theme), many)) {
            EXPECT_NE(series.colour, 0U);
            looks.emplace(series.colour, series.stroke);
        }
        EXPECT_EQ(looks.size(), many.size());
    }
}

TEST(PlotLooks, WhatACurveHasOfItsOwnItKeeps) {
    std::vector<Series> series(14);
    series[13].stroke = Stroke::dotted;
    series[0].colour = rgb(0x102030);
    const std::vector<Series> looks = with_looks(palette(Theme::dark), series);
    EXPECT_EQ(looks[13].stroke, Stroke::dotted);
    EXPECT_EQ(looks[12].stroke, Stroke::dashed);
    EXPECT_EQ(looks[0].colour, rgb(0x102030));
}

TEST_F(Plot, AClickGivesTheXThere) {
    stage.frames(2);
    const Rect box = stage.place("plots/error");
    stage.click_at({box.x + 0.75F * box.w, box.centre().y});
    ASSERT_TRUE(clicked.has_value());
    EXPECT_NEAR(*clicked, 3.0, 0.02);
}

TEST_F(Plot, ValuesThatAreNotNumbersLeaveGaps) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& values : {std::vector{nan, 1.0, inf, 2.0, -inf},
                                              std::vector{nan, nan, nan, nan, nan},
                                              std::vector{0.0, 0.0, 0.0, 0.0, 0.0},
                                              std::vector{-1e308, 1e308, 0.0, 1e-300, 1.0}}) {
        y = values;
        for (const bool log : {false, true}) {
            is_log = log;
            stage.frames(2);
            stage.move(stage.place("plots/error").centre());
            EXPECT_NO_THROW(stage.frames(2));
        }
    }
    x.clear();
    y.clear();
    EXPECT_NO_THROW(stage.frames(2));
}

TEST_F(Plot, ZerosOfALogarithmicPlotAreMarkedBelowItsCurves) {
    y = {1.0, 0.0, 1e-3, 0.0, 1e-6};
    stage.frames(2);
    EXPECT_EQ(stage.ui().places().find("plots/error/zeros"), nullptr); // a linear axis has a place for them
    is_log = true;
    stage.frames(2);
    const Rect box = stage.place("plots/error");
    const Rect zeros = stage.place("plots/error/zeros");
    EXPECT_FLOAT_EQ(zeros.bottom(), box.bottom());
    EXPECT_LT(zeros.h, 0.2F * box.h);
    const test::Picture picture = stage.picture();
    const auto pixel = [&](double share) {
        const auto row = static_cast<std::size_t>(zeros.centre().y);
        const auto column = static_cast<std::size_t>(zeros.x + static_cast<float>(share) * zeros.w);
        return picture.pixels[row * static_cast<std::size_t>(picture.width) + column];
    };
    EXPECT_NE(pixel(0.25), pixel(0.4)); // at x = 1
    EXPECT_NE(pixel(0.75), pixel(0.4)); // at x = 3
    EXPECT_EQ(pixel(0.5), pixel(0.4));  // at x = 2
    y = {0.0, 0.0, 0.0, 0.0, 0.0};
    stage.frames(2);
    EXPECT_NO_THROW((void)stage.place("plots/error/zeros"));
}

TEST_F(Plot, WithoutPointsItHasNoAxes) {
    stage.frames(2);
    const Rect with_axes = stage.place("plots/error");
    x.clear();
    y.clear();
    stage.frames(2);
    const Rect sentence = stage.place("plots/error");
    EXPECT_FLOAT_EQ(sentence.h, 200.0F);
    EXPECT_LT(with_axes.h, sentence.h);
    EXPECT_LT(sentence.x, with_axes.x);
}

TEST_F(Plot, ManyPointsStayDrawable) {
    x.clear();
    y.clear();
    for (int i = 0; i < 200'000; ++i) {
        x.push_back(i);
        y.push_back(i % 7);
    }
    EXPECT_NO_THROW(stage.frames(2));
}

TEST_F(Plot, ASeriesWithMoreXThanYIsADefect) {
    y.pop_back();
    EXPECT_THROW(stage.frames(), Defect);
}

TEST(Legend, IsClickedForItsSettings) {
    int clicks = 0;
    Stage stage([&](Ui& ui) {
        const auto pane = ui.bare_pane("view", whole_screen);
        LegendView view{.title = "Error", .unit = "mm", .high = 0.25, .map = [](double t) {
                            return rgb(t > 0.5 ? 0 : 255);
                        }};
        clicks += legend(ui, "legend", {600.0F, 10.0F, 90.0F, 250.0F}, view) ? 1 : 0;
        view.lying = true;
        view.over = rgb(0xFF0000);
        clicks += legend(ui, "lying", {10.0F, 10.0F, 200.0F, 34.0F}, view) ? 10 : 0;
    });
    stage.frames(2);
    EXPECT_TRUE(stage.ui().cut_texts().empty());
    stage.click("view/legend");
    stage.click("view/lying");
    EXPECT_EQ(clicks, 11);
}

TEST(Legend, OfAScaleThatEndsBelowTheLargestSaysSo) {
    LegendView view{.title = "Error", .unit = "mm", .high = 0.5, .map = [](double) { return rgb(0x20A040); }};
    Stage stage([&](Ui& ui) {
        const auto pane = ui.bare_pane("view", whole_screen);
        view.lying = false;
        (void)legend(ui, "legend", {600.0F, 10.0F, 92.0F, 250.0F}, view);
        view.lying = true;
        (void)legend(ui, "lying", {10.0F, 10.0F, 250.0F, 34.0F}, view);
        (void)legend(ui, "narrow", {10.0F, 60.0F, 120.0F, 34.0F}, view);
    });
    view.largest = 0.5;
    stage.frames(2);
    const auto ends = stage.picture();
    view.largest = 1.514;
    stage.frames(2);
    const auto goes_on = stage.picture();
    EXPECT_TRUE(stage.ui().cut_texts().empty());
    for (const char* path : {"view/legend", "view/lying", "view/narrow"}) {
        const Rect at = stage.place(path);
        int different = 0;
        for (int y = static_cast<int>(at.y); y < static_cast<int>(at.bottom()); ++y) {
            for (int x = static_cast<int>(at.x); x < static_cast<int>(at.right()); ++x) {
                const auto pixel = static_cast<std::size_t>(y * ends.width + x);
                different += ends.pixels[pixel] == goes_on.pixels[pixel] ? 0 : 1;
            }
        }
        EXPECT_GT(different, 10) << path;
    }
}

} // namespace
} // namespace millwright::widgets
