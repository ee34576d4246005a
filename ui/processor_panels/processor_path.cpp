#include "ui/processor_panels/processor_path.h"

#include "core/base/counted.h"
#include "ui/processor_panels/titled_drawing.h"
#include "ui/render/color_map.h"
#include "ui/widgets/canvas.h"
#include "ui/widgets/legend.h"
#include "ui/widgets/sketch.h"
#include "ui/workspaces/processor_workspace.h"

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace millwright::panels {

namespace {

using widgets::Colour;
using widgets::Point;
using widgets::Rect;
using widgets::Sketch;

constexpr std::size_t most_pieces = 4000; // of a path that is drawn

Colour to_widget_colour(const glm::vec3& c) {
    const auto byte = [](float v) { return static_cast<std::uint32_t>(std::lround(255.0F * v)); };
    return widgets::rgb(byte(c.r) << 16U | byte(c.g) << 8U | byte(c.b));
}

/// Every n-th of `count`, and the last.
std::vector<std::size_t> thinned(std::size_t count) {
    std::vector<std::size_t> chosen;
    const std::size_t by = count / most_pieces + 1;
    for (std::size_t n = 0; n < count; n += by) {
        chosen.push_back(n);
    }
    if (count > 0 && chosen.back() != count - 1) {
        chosen.push_back(count - 1);
    }
    return chosen;
}

/// Of a path in the plane: its middle, and what a pixel is.
struct Fit {
    double x = 0.0, y = 0.0, scale = 1.0;
    Point middle;

    [[nodiscard]] Point at(double px, double py) const {
        return {middle.x + static_cast<float>(scale * (px - x)),
                middle.y - static_cast<float>(scale * (py - y))};
    }
};

Fit fit_of(std::span<const cordic::PathDifference> path, const Rect& place) {
    double min_x = 0.0;
    double max_x = 0.0;
    double min_y = 0.0;
    double max_y = 0.0;
    for (const cordic::PathDifference& point : path) {
        min_x = std::min(min_x, point.x);
        max_x = std::max(max_x, point.x);
        min_y = std::min(min_y, point.y);
        max_y = std::max(max_y, point.y);
    }
    const double room_x = static_cast<double>(place.w) * 0.86;
    const double room_y = static_cast<double>(place.h) * 0.86;
    const double scale =
        std::min(room_x / std::max(max_x - min_x, 1e-9), room_y / std::max(max_y - min_y, 1e-9));
    return {0.5 * (min_x + max_x), 0.5 * (min_y + max_y), scale, place.centre()};
}

/// Of axes at the origin that suit a path of that size.
std::array<glm::dvec3, 3> axis_ends(const render::Bounds& bounds) {
    const glm::dvec3 size = bounds.max - bounds.min;
    const double length = 0.28 * std::max({size.x, size.y, size.z, 1e-6});
    return {glm::dvec3{length, 0.0, 0.0}, glm::dvec3{0.0, length, 0.0}, glm::dvec3{0.0, 0.0, length}};
}

/// X, Y and Z from the origin.
void draw_axes(Sketch& sketch,
               const Ui& ui,
               const std::function<std::optional<Point>(const glm::dvec3&)>& at,
               const render::Bounds& bounds) {
    constexpr std::array<std::string_view, 3> names{"X", "Y", "Z"};
    const auto origin = at({0.0, 0.0, 0.0});
    const std::array<glm::dvec3, 3> ends = axis_ends(bounds);
    for (std::size_t n = 0; n < ends.size() && origin; ++n) {
        if (const auto tip = at(ends[n])) {
            const Colour colour = ui.colours().axis[n];
            sketch.arrow(*origin, *tip, colour, 1.5F);
            const float half = ui.px(8.0F);
            const Point beyond{tip->x + 0.12F * (tip->x - origin->x), tip->y + 0.12F * (tip->y - origin->y)};
            sketch.text({beyond.x - half, beyond.y - half, 2.0F * half, 2.0F * half},
                        names[n],
                        colour,
                        widgets::TextAlign::centre,
                        widgets::TextFont::small);
        }
    }
}

/// The path as the processor computes it, from where it starts, in scene coordinates.
std::vector<glm::dvec3> places_of(std::span<const cordic::PathDifference> path) {
    std::vector<glm::dvec3> places{{0.0, 0.0, 0.0}};
    for (const std::size_t n : thinned(path.size())) {
        places.emplace_back(path[n].x, path[n].y, path[n].z);
    }
    return places;
}

/// Where the last set-point leads, in scene coordinates.
glm::dvec3 tool_place(const cordic::Processor& processor) {
    if (processor.published().empty()) {
        return {0.0, 0.0, 0.0};
    }
    const cordic::Published& last = processor.published().back();
    const auto set = processor.set_point(last);
    return {set.x, set.y, processor.height_point(last).z};
}

} // namespace

void ProcessorPath::draw(Ui& ui, const FrameState& now, const Rect& place) {
    const auto& processor = now.processor.debugger().processor();
    const std::size_t done = processor.published().size();
    const std::span<const cordic::PathDifference> path = now.processor.differences();
    const Rect inside = below_title(
        ui, place, fmt::format("Path: {} of {}", done, counted(now.processor.set_points(), "point")));
    const widgets::Canvas canvas = widgets::canvas(ui, "path", inside, 0);
    if (path.empty()) {
        return say(ui, inside, "No set-points.");
    }
    const render::PixelSize size{std::max(1, static_cast<int>(inside.w)),
                                 std::max(1, static_cast<int>(inside.h))};
    if (canvas.pointer.held == widgets::MouseButton::left) {
        camera_ = camera_.orbited(
            {static_cast<double>(canvas.pointer.moved.x), static_cast<double>(canvas.pointer.moved.y)}, size);
    }
    zoom_ = std::clamp(zoom_ * std::pow(0.85, static_cast<double>(canvas.pointer.wheel)), 0.05, 4.0);
    const std::vector<glm::dvec3> places = places_of(path);
    render::Bounds bounds;
    for (const glm::dvec3& p : places) {
        bounds = render::united(bounds, p);
    }
    const double aspect = static_cast<double>(size.width) / size.height;
    std::vector<glm::dvec3> seen = places;
    for (const glm::dvec3& end : axis_ends(bounds)) {
        seen.push_back(1.2 * end); // and its letter
    }
    const render::Camera fitted =
        camera_.fitted(seen, aspect).zoomed(zoom_, {0.5 * size.width, 0.5 * size.height}, size);
    const render::View view = fitted.view(size, bounds);
    Sketch sketch(ui, inside);
    const auto at = [&](const glm::dvec3& p) -> std::optional<Point> {
        const auto projected = render::project(view, p);
        return projected ? std::optional(Point{inside.x + static_cast<float>(projected->pixel.x),
                                               inside.y + static_cast<float>(projected->pixel.y)})
                         : std::nullopt;
    };
    const widgets::Palette& colours = ui.colours();
    const std::vector<std::size_t> chosen = thinned(path.size());
    draw_axes(sketch, ui, at, bounds);
    std::optional<Point> before = at(places.front());
    for (std::size_t n = 1; n < places.size(); ++n) {
        const auto here = at(places[n]);
        const bool passed = chosen[n - 1] < done;
        if (before && here) {
            sketch.line(*before, *here, passed ? colours.accent : colours.line, passed ? 2.0F : 1.2F);
        }
        before = here;
    }
    const std::optional<Point> tool = at(tool_place(processor));
    if (tool) {
        sketch.dot(*tool, ui.px(4.0F), colours.warning);
    }
    ui.record("tool", tool ? Rect{tool->x - 4.0F, tool->y - 4.0F, 8.0F, 8.0F} : Rect{});
}

void draw_difference_map(Ui& ui, const FrameState& now, const Rect& place) {
    const std::span<const cordic::PathDifference> path = now.processor.differences();
    const double worst = now.processor.report().position_error;
    const std::span<const std::size_t> late = now.processor.report().late;
    const Rect inside =
        below_title(ui,
                    place,
                    late.empty() ? std::string("Path deviation")
                                 : fmt::format("Path deviation; {} late", counted(late.size(), "set-point")));
    (void)widgets::canvas(ui, "map", inside, 0);
    if (path.empty()) {
        return say(ui, inside, "No set-points.");
    }
    constexpr float legend_width = 92.0F;
    const Rect drawing{inside.x, inside.y, inside.w - ui.px(legend_width), inside.h};
    const Fit fit = fit_of(path, drawing);
    const double unit = 1e-3; // mm: shown in um
    const double high = worst > 0.0 ? worst : unit * 1e-6;
    const render::ColorScale scale{render::ColorMap::viridis, 0.0, high};
    {
        Sketch sketch(ui, inside);
        Point before = fit.at(0.0, 0.0);
        for (const std::size_t n : thinned(path.size())) {
            const Point here = fit.at(path[n].x, path[n].y);
            sketch.line(before, here, to_widget_colour(render::color_of(scale, path[n].distance)), 3.0F);
            before = here;
        }
        for (const std::size_t n : thinned(late.size())) {
            if (late[n] < path.size()) {
                const cordic::PathDifference& point = path[late[n]];
                sketch.dot(fit.at(point.x, point.y), ui.px(2.5F), ui.colours().warning);
            }
        }
    }
    widgets::LegendView legend;
    legend.title = "Deviation";
    legend.unit = "\u00b5m";
    legend.high = high / unit;
    legend.map = [](double t) { return to_widget_colour(render::sample(render::ColorMap::viridis, t)); };
    legend.tip = "Distance of each set-point from its position in exact arithmetic";
    (void)widgets::legend(ui,
                          "legend",
                          {inside.right() - ui.px(legend_width),
                           inside.y + ui.px(6.0F),
                           ui.px(legend_width - 4.0F),
                           inside.h - ui.px(12.0F)},
                          legend);
}

} // namespace millwright::panels
