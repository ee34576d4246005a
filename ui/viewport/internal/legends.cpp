#include "ui/viewport/internal/legends.h"

#include "ui/viewport/internal/overlay.h"
#include "ui/viewport/stock_sight.h"
#include "ui/widgets/legend.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

namespace millwright::viewport {

namespace {

using widgets::Rect;

// Pixels at scale 1.
constexpr float legend_width = 92.0F;
constexpr float legend_height = 250.0F;
constexpr float least_legend_height = 110.0F;
constexpr float legend_top = 16.0F; // left free above it, for a caption
constexpr float above_scale_bar = 44.0F;
constexpr float narrow_picture = 760.0F; // an upright legend would take too much of a picture below this
constexpr float lying_height = 34.0F;
constexpr float lying_width = 250.0F;
constexpr float least_lying_width = 120.0F;
constexpr float beside_scale_bar = 168.0F;

bool reaches(const plan::SetUpStudy& study) {
    return std::ranges::any_of(study.map.costs, [](double cost) { return std::isfinite(cost); });
}

struct Legend {
    std::string_view id, title, unit, tip;
    render::ColorScale scale;
    std::optional<double> largest = {};
    widgets::ColourMap colors = {}; ///< in place of those of `scale`
};

Legend stock_legend(double tolerance) {
    const double range = stock_range(tolerance);
    return {.id = "stock_legend",
            .title = "Stock",
            .unit = "mm",
            .tip = "Height of the remaining material over the part: gouges are red, heights within the "
                   "tolerance green, excess is blue. Grey is uncut stock, brown a cut beside the part.",
            .scale = {.low = -range, .high = range},
            .colors = [tolerance, range](double t) {
                return to_colour(stock_color(range * (2.0 * t - 1.0), tolerance));
            }};
}

/// What of the picture has its colours from numbers.
std::vector<Legend> legends(const Scene& scene, const render::ViewColors& colors) {
    std::vector<Legend> found;
    const SurfaceColors surface = surface_colors(scene);
    if (scene.shown && (scene.layers.path.errors || surface == SurfaceColors::error)) {
        found.push_back({"legend",
                         "Error",
                         "mm",
                         "Largest distance of the true tool path from the surface, for each move.",
                         error_colors(scene, colors.over_limit),
                         scene.shown->closest.max});
    }
    if (surface == SurfaceColors::scallop) {
        found.push_back(
            {"scallop_legend",
             "Scallop",
             "mm",
             "Scallop height. The signal colour marks larger values and areas that are not machined.",
             scallop_colors(scene, colors.over_limit)});
    }
    if (scene.layers.machine.set_up_map && scene.set_up && scene.set_up->study &&
        reaches(*scene.set_up->study)) {
        found.push_back({"set_up_legend",
                         "Set-up",
                         "mm",
                         "Value with the part at that position: mean error or machine travel.",
                         set_up_colors(scene)});
    }
    const bool has_no_part = scene.stock && scene.stock->result && scene.stock->result->job.file;
    if (shows_stock(scene) && !has_no_part) {
        found.push_back(stock_legend(scene.stock_tolerance));
    }
    if (surface == SurfaceColors::deviation) {
        found.push_back(
            {"deviation_legend",
             "Deviation",
             "mm",
             "Distance of the imported triangles from the patch; positive on the side of its normal.",
             deviation_colors(scene)});
    }
    if (scene.layers.path.intended && scene.plot && scene.plot->carved) {
        found.push_back({"depth_legend",
                         "Depth",
                         "mm",
                         "Cutting depth of the bit along the centre of the outlines.",
                         depth_colors(scene)});
    }
    if (surface == SurfaceColors::weight) {
        found.push_back(
            {"weight_legend",
             "Weight",
             "",
             "Weight of the elliptic grid: the area of a cell is proportional to 1 / sqrt(weight).",
             weight_colors(scene)});
    }
    return found;
}

int legend_count(const Scene& scene) {
    return static_cast<int>(legends(scene, render::view_colors(render::Theme::dark)).size());
}

} // namespace

LegendPlaces upright_legends(const widgets::Ui& ui, const Rect& picture, const Scene& scene) {
    LegendPlaces places{.free = picture};
    const auto count = static_cast<float>(legend_count(scene));
    const float space = ui.px(0.5F * overlay_margin);
    const float bottom = picture.bottom() - ui.px(above_scale_bar);
    const float room = bottom - picture.y - ui.px(overlay_margin + legend_top);
    const float stacked = std::min(ui.px(legend_height), (room - (count - 1.0F) * space) / count);
    const bool stands_above = stacked >= ui.px(least_legend_height);
    const float height = stands_above ? stacked : std::min(ui.px(legend_height), room);
    const float step_x = stands_above ? 0.0F : ui.px(legend_width) + space;
    const float step_y = stands_above ? height + space : 0.0F;
    Rect place{picture.x + ui.px(overlay_margin), bottom - height, ui.px(legend_width), height};
    for (int n = 0; n < legend_count(scene); ++n) {
        if (height < ui.px(least_legend_height) || place.right() > picture.right()) {
            break;
        }
        places.each.push_back(place);
        const float taken = place.right() + space - picture.x;
        places.free = {picture.x + taken, picture.y, picture.w - taken, picture.h};
        place.x += step_x;
        place.y -= step_y;
    }
    if (stands_above) {
        std::ranges::reverse(places.each); // the first one at the top
    }
    return places;
}

LegendPlaces lying_legends(const widgets::Ui& ui, const Rect& picture, float left, const Scene& scene) {
    LegendPlaces places{.lying = true, .free = picture};
    const int count = legend_count(scene);
    const float space = ui.px(0.5F * overlay_margin);
    const float room = picture.right() - space - left;
    const float each = std::min(ui.px(lying_width), room / static_cast<float>(std::max(count, 1)) - space);
    if (count == 0 || each < ui.px(least_lying_width)) {
        return places;
    }
    const float height = ui.px(lying_height);
    for (int n = 0; n < count; ++n) {
        const float x = left + static_cast<float>(n) * (each + space);
        places.each.push_back({x, picture.bottom() - height - ui.px(3.0F), each, height});
    }
    places.free.h -= legend_strip_height(ui);
    return places;
}

LegendPlaces legends_of(const widgets::Ui& ui, const Rect& picture, const Scene& scene) {
    const bool narrow = picture.w < ui.px(narrow_picture);
    const LegendPlaces lying =
        narrow ? lying_legends(ui, picture, picture.x + ui.px(beside_scale_bar), scene) : LegendPlaces{};
    return lying.each.empty() ? upright_legends(ui, picture, scene) : lying;
}

float legend_strip_height(const widgets::Ui& ui) {
    return ui.px(lying_height + 6.0F);
}

void draw_legends(widgets::Ui& ui,
                  const LegendPlaces& places,
                  const render::ViewColors& colors,
                  const Scene& scene,
                  const Scene* beside) {
    std::vector<Legend> all = legends(scene, colors);
    for (std::size_t n = 0; n < std::min(all.size(), places.each.size()); ++n) {
        Legend& legend = all[n];
        if (legend.largest && beside != nullptr && beside->shown) {
            legend.largest = std::max(*legend.largest, beside->shown->closest.max);
        }
        widgets::LegendView view = {
            .title = legend.title,
            .unit = legend.unit,
            .low = legend.scale.low,
            .high = legend.scale.high,
            .map = legend.colors
                       ? legend.colors
                       : [map = legend.scale.map](double t) { return to_colour(render::sample(map, t)); },
            .largest = legend.largest,
            .tip = legend.tip,
            .lying = places.lying};
        if (legend.scale.limit) {
            view.over = to_colour(legend.scale.over_limit);
        }
        widgets::legend(ui, legend.id, places.each[n], view);
    }
}

} // namespace millwright::viewport
