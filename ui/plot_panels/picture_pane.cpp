#include "ui/plot_panels/picture_pane.h"

#include "ui/panels/fields.h"
#include "ui/widgets/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace millwright::panels {

namespace {

// Of the map, px at scale 1: a lower pane scrolls.
constexpr float least_height = 90.0F;
constexpr float readable_height = 170.0F;
constexpr float most_height = 2000.0F;
constexpr float around_map = 70.0F; // title, axis and their numbers, across and down

widgets::Colour gray_colour(double share) {
    const auto level = static_cast<widgets::Colour>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
    return 0xFF000000U | level << 16U | level << 8U | level;
}

/// In pixels of the file; at its right and lower edge, where cells may have fewer, up to the edge.
plot::PixelRegion
region_between(int row, int column, int other_row, int other_column, const plot::Picture& shown) {
    const int side = shown.file_pixels;
    const auto [top, bottom] = std::minmax(row, other_row);
    const auto [left, right] = std::minmax(column, other_column);
    return {.left = left * side,
            .top = top * side,
            .width = right + 1 == shown.width ? 0 : (right - left + 1) * side,
            .height = bottom + 1 == shown.height ? 0 : (bottom - top + 1) * side};
}

/// Around the cells of a region, on the map.
widgets::MapFrame frame_of(const plot::PixelRegion& region, const plan::ShownPicture& shown) {
    const plot::Picture& picture = shown.picture;
    const auto cells = [&](int pixels, int most) {
        return std::clamp(static_cast<double>(pixels) / picture.file_pixels, 0.0, static_cast<double>(most));
    };
    const double left = cells(region.left, picture.width), top = cells(region.top, picture.height);
    const double right = region.width > 0 ? cells(region.left + region.width, picture.width) : picture.width;
    const double bottom =
        region.height > 0 ? cells(region.top + region.height, picture.height) : picture.height;
    const auto x = [&](double column) { return shown.corner.x() + (column - 0.5) * shown.cell.x(); };
    const auto y = [&](double row) {
        return shown.corner.y() + (picture.height - row - 0.5) * shown.cell.y();
    };
    return {{x(left), y(top)}, {x(right), y(bottom)}};
}

void change_region(ActionQueue& ask,
                   const std::string& title,
                   const std::optional<plot::PixelRegion>& region) {
    ask.edit(title, [region](project::Project& draft) { draft.plot.settings.picture.region = region; });
}

} // namespace

void PicturePane::follow(const std::shared_ptr<const plan::ShownPicture>& shown) {
    if (shown == shown_) {
        return;
    }
    shown_ = shown;
    const plot::Picture& picture = shown->picture;
    x_.clear();
    y_.clear();
    gray_.clear();
    for (int column = 0; column < picture.width; ++column) {
        x_.push_back(shown->corner.x() + column * shown->cell.x());
    }
    for (int row = picture.height - 1; row >= 0; --row) { // a map begins below
        y_.push_back(shown->corner.y() + (picture.height - 1 - row) * shown->cell.y());
        for (int column = 0; column < picture.width; ++column) {
            gray_.push_back(shown->gray(row, column));
        }
    }
}

PicturePane::Cell PicturePane::cell_at(double x, double y) const {
    const auto steps = [](double distance, double step, int count) {
        return std::clamp(static_cast<int>(std::lround(distance / step)), 0, count - 1);
    };
    const plot::Picture& picture = shown_->picture;
    const int up = steps(y - shown_->corner.y(), shown_->cell.y(), picture.height);
    return {.row = picture.height - 1 - up,
            .column = steps(x - shown_->corner.x(), shown_->cell.x(), picture.width)};
}

void PicturePane::mark(const Cell& corner, ActionQueue& ask) {
    if (!first_) {
        first_ = corner;
        return;
    }
    const Cell other = *std::exchange(first_, std::nullopt);
    change_region(ask,
                  "Select a region",
                  region_between(other.row, other.column, corner.row, corner.column, shown_->picture));
}

float PicturePane::map_height(const Ui& ui) const {
    const float fitting =
        std::max(ui.rest().h, ui.px(size_ == MapSize::pane ? least_height : readable_height));
    if (size_ != MapSize::width) {
        return fitting;
    }
    const double ratio =
        shown_->cell.y() * shown_->picture.height / (shown_->cell.x() * shown_->picture.width);
    const float around = ui.px(around_map);
    const float filling = static_cast<float>(ratio) * std::max(ui.rest().w - around, 1.0F) + around;
    return std::clamp(filling, fitting, std::max(fitting, ui.px(most_height)));
}

void PicturePane::draw_buttons(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const int side = shown_->picture.file_pixels;
    const auto line = ui.row(3);
    const auto& region = now.plot.settings().picture.region;
    if (ui.button("whole",
                  "Whole picture",
                  region ? widgets::Permission{}
                         : widgets::Permission::refused("The whole picture is already selected."),
                  {{}, widgets::Rank::normal, -1.0F, "Clear the region and cut the whole picture"})) {
        first_.reset();
        change_region(ask, "Cut the whole picture", std::nullopt);
    }
    const auto size_button =
        [&](std::string_view id, std::string_view label, MapSize size, std::string_view tip) {
            const auto rank = size_ == size ? widgets::Rank::primary : widgets::Rank::normal;
            if (ui.button(id, label, {}, {{}, rank, -1.0F, tip})) {
                size_ = size_ == size ? MapSize::readable : size;
            }
        };
    size_button("fit", "Fit to pane", MapSize::pane, "Show the whole map");
    size_button("fill", "Fit to width", MapSize::width, "Larger map with scrolling");
    ui.note(first_     ? "Click the opposite corner of the region."
            : side > 1 ? fmt::format("Each cell is the mean of {0} x {0} pixels. Click two opposite "
                                     "corners to select a region.",
                                     side)
                       : "Click two opposite corners to select the region to cut.");
}

void PicturePane::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto made = now.plot.latest();
    if (!made || !made->shown_picture) {
        return;
    }
    follow(made->shown_picture);
    draw_buttons(ui, now, ask);
    widgets::HeatMapView view;
    view.title = "G(i,j)";
    view.x_label = "x";
    view.x_unit = "mm";
    view.y_label = "y";
    view.y_unit = "mm";
    view.x = x_;
    view.y = y_;
    view.values = gray_;
    view.same_scale = true;
    view.height = map_height(ui);
    view.colours = gray_colour;
    view.when_empty = "The picture has only one row or column.";
    view.readout = [this](std::size_t column, std::size_t row) {
        const int i = shown_->picture.height - 1 - static_cast<int>(row);
        const int j = static_cast<int>(column);
        return fmt::format(
            "G({}, {}) = {}\nx {:.2f} mm, y {:.2f} mm", i, j, shown_->gray(i, j), x_[column], y_[row]);
    };
    if (const auto& region = now.plot.settings().picture.region) {
        view.frame = frame_of(*region, *shown_);
    }
    if (first_) {
        const auto up = static_cast<std::size_t>(shown_->picture.height - 1 - first_->row);
        view.chosen = widgets::MapPlace{x_[static_cast<std::size_t>(first_->column)], y_[up]};
    }
    if (const auto clicked = widgets::heat_map(ui, "gray_map", view)) {
        mark(cell_at(clicked->x, clicked->y), ask);
    }
}

} // namespace millwright::panels
