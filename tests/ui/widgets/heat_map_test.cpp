#include "ui/widgets/heat_map.h"

#include "core/base/error.h"
#include "tests/ui/stage/stage.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <set>
#include <vector>

namespace millwright::widgets {
namespace {

using test::Stage;

class HeatMap : public testing::Test {
protected:
    std::vector<double> x{0.0, 1.0, 2.0};
    std::vector<double> y{10.0, 20.0};
    std::vector<double> values{1.0, 2.0, 3.0, 4.0, 5.0, std::numeric_limits<double>::infinity()};
    std::vector<double> asked;
    MapPlace chosen{-100.0, 10.0};
    Rect whole{0.0F, 0.0F, 800.0F, 600.0F};
    std::optional<MapPlace> clicked;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("maps", whole);
        HeatMapView view;
        view.x = x;
        view.y = y;
        view.values = values;
        view.height = 300.0F;
        view.title = "mean to the curve";
        view.unit = "mm";
        view.x_label = view.y_label = "b";
        view.x_unit = view.y_unit = "mm";
        view.best = MapPlace{1.0, 20.0};
        view.chosen = chosen;
        view.colours = [this](double t) {
            asked.push_back(t);
            return rgb(0x808080);
        };
        if (const auto at = heat_map(ui, "cost", view)) {
            clicked = at;
        }
    }};
};

TEST_F(HeatMap, AClickGivesThePlaceThere) {
    stage.frames(2);
    const Rect box = stage.place("maps/cost");
    stage.click_at({box.x + 0.5F * box.w, box.y + 0.25F * box.h});
    ASSERT_TRUE(clicked.has_value());
    EXPECT_NEAR(clicked->x, 1.0, 0.02) << "three cells from -0.5 to 2.5";
    EXPECT_NEAR(clicked->y, 20.0, 0.2) << "two cells from 5 to 25, upwards";
}

TEST_F(HeatMap, HasTheWholeRangeOfColoursAndAHoleWhereThereIsNoNumber) {
    values = {7.0, 9.0, 7.0, 9.0, 7.0, std::numeric_limits<double>::quiet_NaN()};
    stage.frames(1);
    asked.clear();
    stage.frames(1);
    std::vector<double> ends;
    for (const double t : asked) {
        if (t <= 0.0 || t >= 1.0) {
            ends.push_back(t);
        }
    }
    EXPECT_EQ(ends, (std::vector{0.0, 1.0, 0.0, 1.0, 0.0})) << "five cells; the key asks in between";
}

TEST_F(HeatMap, SaysInANarrowPaneWhatItIsOfAndWhatGoesUp) {
    whole.w = 330.0F;
    values = {0.43671, 2.0, 3.0, 4.0, 5.0, 16.25};
    stage.frames(2);
    EXPECT_TRUE(stage.ui().cut_texts().empty());
}

// Where the part stood outside of the map there was no mark and no word.
TEST_F(HeatMap, APlaceOutsideHasAnArrowAtTheEdge) {
    const auto white = [this] {
        const Rect box = stage.place("maps/cost");
        const auto picture = stage.picture();
        int count = 0;
        for (int row = static_cast<int>(box.y); row < static_cast<int>(box.bottom()); ++row) {
            for (int column = static_cast<int>(box.x); column < static_cast<int>(box.x + 20.0F); ++column) {
                count += picture.pixels[static_cast<std::size_t>(row * picture.width + column)] == 0xFFFFFFFF
                             ? 1
                             : 0;
            }
        }
        return count;
    };
    stage.frames(2);
    EXPECT_GT(white(), 40) << "at a = -100, left of all columns";
    chosen = MapPlace{1.0, 10.0};
    stage.frames(1);
    EXPECT_EQ(white(), 0);
}

// A place out of reach was as blank as the ground of the map.
TEST_F(HeatMap, AHoleIsHatched) {
    const auto colours_of_the_last_cell = [this] {
        const Rect box = stage.place("maps/cost");
        const auto picture = stage.picture();
        std::set<std::uint32_t> found;
        for (int row = static_cast<int>(box.y + 0.1F * box.h); row < static_cast<int>(box.y + 0.4F * box.h);
             ++row) {
            for (int column = static_cast<int>(box.x + 0.8F * box.w);
                 column < static_cast<int>(box.x + 0.95F * box.w);
                 ++column) {
                found.insert(picture.pixels[static_cast<std::size_t>(row * picture.width + column)]);
            }
        }
        return found.size();
    };
    stage.frames(2);
    EXPECT_GT(colours_of_the_last_cell(), 1U);
    EXPECT_TRUE(stage.ui().cut_texts().empty());
    values.back() = 6.0;
    stage.frames(1);
    EXPECT_EQ(colours_of_the_last_cell(), 1U);
}

TEST_F(HeatMap, WithoutANumberSaysSo) {
    values.assign(6, std::numeric_limits<double>::infinity());
    stage.frames(2);
    stage.click_at(stage.place("maps/cost").centre());
    EXPECT_FALSE(clicked.has_value());
}

} // namespace
} // namespace millwright::widgets
