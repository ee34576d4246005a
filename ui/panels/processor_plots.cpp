#include "ui/panels/processor_plots.h"

#include "core/base/units.h"
#include "ui/actions/processor_bench.h"
#include "ui/render/color_map.h"
#include "ui/widgets/canvas.h"
#include "ui/widgets/legend.h"
#include "ui/widgets/plot.h"
#include "ui/widgets/sketch.h"

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

constexpr float title_height = 22.0F;
constexpr std::size_t most_pieces = 4000; // of a path that is drawn

Colour colour_of(const glm::vec3& c) {
    const auto byte = [](float v) { return static_cast<std::uint32_t>(std::lround(255.0F * v)); };
    return widgets::rgb(byte(c.r) << 16U | byte(c.g) << 8U | byte(c.b));
}

/// Title and canvas of one drawing; what is left of `place` below the title.
Rect below_title(Ui& ui, const Rect& place, std::string_view title) {
    Sketch sketch(ui, place);
    sketch.text({place.x + ui.px(8.0F), place.y, place.w - ui.px(16.0F), ui.px(title_height)},
                title,
                ui.colours().text,
                widgets::TextAlign::left,
                widgets::TextFont::small);
    return {place.x, place.y + ui.px(title_height), place.w, place.h - ui.px(title_height)};
}

void say(Ui& ui, const Rect& place, std::string_view text) {
    Sketch sketch(ui, place);
    sketch.text(place, text, ui.colours().muted, widgets::TextAlign::centre, widgets::TextFont::small);
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

std::string pass_title(const cordic::IterationTrace& trace) {
    if (trace.points.empty()) {
        return "CORDIC pass: none yet";
    }
    const auto steps = std::ranges::count_if(trace.points, [](const auto& p) { return !p.corrects; }) - 1;
    const auto corrections = std::ranges::count_if(trace.points, [](const auto& p) { return p.corrects; });
    return fmt::format("{}, step {}{}",
                       trace.mode == cordic::Mode::rotation ? "Rotation: z to 0" : "Vectoring: y to 0",
                       steps,
                       corrections > 0 ? fmt::format(", correction {}", corrections) : "");
}

/// The vectors of a pass about the middle of a square, the longest reaching its edge.
class Clock {
public:
    Clock(const Rect& place, std::span<const cordic::IterationPoint> points)
        : middle_(place.centre()), radius_(0.44F * std::min(place.w, place.h)) {
        for (const cordic::IterationPoint& point : points) {
            longest_ = std::max(longest_, std::hypot(point.x, point.y));
        }
    }
    [[nodiscard]] Point at(double x, double y) const {
        const double scale = longest_ > 0.0 ? static_cast<double>(radius_) / longest_ : 0.0;
        return {middle_.x + static_cast<float>(scale * x), middle_.y - static_cast<float>(scale * y)};
    }
    [[nodiscard]] Point middle() const { return middle_; }
    [[nodiscard]] float radius() const { return radius_; }
    [[nodiscard]] double longest() const { return longest_; }

private:
    Point middle_;
    float radius_;
    double longest_ = 0.0;
};

/// Where the vector is going: along x when vectoring, by the angle that is left when rotating.
double aim(const cordic::IterationTrace& trace) {
    const cordic::IterationPoint& now = trace.points.back();
    return trace.mode == cordic::Mode::vectoring ? 0.0 : std::atan2(now.y, now.x) + now.z;
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

/// What each step turns by, behind which that much may be left.
struct Angles {
    std::vector<double> steps, degrees;
};

Angles angles_of(const cordic::Sequence& sequence) {
    Angles angles;
    for (int i = 0; i < sequence.step_count; ++i) {
        angles.steps.push_back(i + 1.0);
        angles.degrees.push_back(
            to_degrees(std::atan(std::ldexp(1.0, -sequence.shifts[static_cast<std::size_t>(i)]))));
    }
    return angles;
}

} // namespace

void ProcessorPlots::draw(Ui& ui, const Workbench& now, ActionQueue&) {
    const Rect all = ui.rest();
    const float gap = ui.px(8.0F);
    const float height = all.h;
    const float square = std::min(height - ui.px(title_height), 0.26F * all.w);
    const float left = all.w - square - 3.0F * gap;
    float x = all.x;
    const auto next = [&](float width) {
        const Rect place{x, all.y, width, height};
        x += width + gap;
        return place;
    };
    draw_vector(ui, now, next(square));
    draw_errors(ui, now, next(0.36F * left));
    draw_path(ui, now, next(0.30F * left));
    draw_map(ui, now, next(0.34F * left));
}

void ProcessorPlots::draw_vector(Ui& ui, const Workbench& now, const Rect& place) const {
    const cordic::IterationTrace trace = now.processor.debugger().iterations();
    const Rect inside = below_title(ui, place, pass_title(trace));
    (void)widgets::canvas(ui, "vector", inside, 0);
    if (trace.points.empty()) {
        return say(ui, inside, "Step until a pass begins.");
    }
    const widgets::Palette& colours = ui.colours();
    Sketch sketch(ui, inside);
    const Clock clock(inside, trace.points);
    const float r = clock.radius();
    const Point middle = clock.middle();
    sketch.circle(middle, r, colours.line);
    sketch.line({middle.x - r, middle.y}, {middle.x + r, middle.y}, colours.line);
    sketch.line({middle.x, middle.y - r}, {middle.x, middle.y + r}, colours.line);
    const double to = aim(trace);
    sketch.line(middle,
                clock.at(clock.longest() * std::cos(to), clock.longest() * std::sin(to)),
                colours.warning,
                1.5F);
    std::vector<Point> ends;
    for (std::size_t n = 0; n < trace.points.size(); ++n) {
        const cordic::IterationPoint& point = trace.points[n];
        ends.push_back(clock.at(point.x, point.y));
        if (n + 1 < trace.points.size()) {
            const double share =
                0.12 + 0.4 * static_cast<double>(n) / static_cast<double>(trace.points.size());
            sketch.line(middle, ends.back(), widgets::faded(colours.accent, share));
        }
    }
    sketch.path(ends, widgets::faded(colours.series[1], 0.8), 1.0F);
    sketch.arrow(middle, ends.back(), colours.accent, 2.5F);
    sketch.text({inside.x + ui.px(6.0F), inside.bottom() - ui.px(20.0F), inside.w, ui.px(18.0F)},
                fmt::format("left {:.2e}\u00b0", to_degrees(trace.points.back().angle_error)),
                colours.text,
                widgets::TextAlign::left,
                widgets::TextFont::small);
}

void ProcessorPlots::draw_errors(Ui& ui, const Workbench& now, const Rect& place) const {
    const Rect inside = below_title(ui, place, "What is left to turn");
    const cordic::IterationTrace trace = now.processor.debugger().iterations();
    std::vector<double> steps;
    std::vector<double> errors;
    for (const cordic::IterationPoint& point : trace.points) {
        if (!point.corrects) {
            steps.push_back(static_cast<double>(steps.size()));
            errors.push_back(to_degrees(point.angle_error));
        }
    }
    const Angles angles = angles_of(now.processor.debugger().processor().settings().sequence);
    widgets::PlotView view;
    view.x_label = "step";
    view.y_label = "angle";
    view.y_unit = "\u00b0";
    view.y_is_log = true;
    const std::array<widgets::Series, 2> series{
        {{"left", steps, errors, 0, false},
         {"angle of the step", angles.steps, angles.degrees, ui.colours().muted, false}}};
    view.series =
        steps.empty() ? std::span<const widgets::Series>() : std::span<const widgets::Series>(series);
    view.height = inside.h;
    view.when_empty = "No step yet.";
    const Rect next = ui.rest();
    ui.move_by(inside.x - next.x, inside.y - next.y);
    const auto width = ui.width(inside.w);
    (void)widgets::line_plot(ui, "errors", view);
}

void ProcessorPlots::draw_path(Ui& ui, const Workbench& now, const Rect& place) {
    const auto& processor = now.processor.debugger().processor();
    const std::size_t done = processor.published().size();
    const std::span<const cordic::PathDifference> path = now.processor.differences();
    const Rect inside =
        below_title(ui, place, fmt::format("Tool path, {} of {} set-points", done, path.size()));
    const widgets::Canvas canvas = widgets::canvas(ui, "path", inside, 0);
    if (path.empty()) {
        return say(ui, inside, "No set-point.");
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
    std::optional<Point> tool = before;
    for (std::size_t n = 1; n < places.size(); ++n) {
        const auto here = at(places[n]);
        const bool passed = chosen[n - 1] < done;
        if (before && here) {
            sketch.line(*before, *here, passed ? colours.accent : colours.line, passed ? 2.0F : 1.2F);
        }
        tool = passed && here ? here : tool;
        before = here;
    }
    if (tool) {
        sketch.dot(*tool, ui.px(4.0F), colours.warning);
    }
    ui.record("tool", tool ? Rect{tool->x - 4.0F, tool->y - 4.0F, 8.0F, 8.0F} : Rect{});
}

void ProcessorPlots::draw_map(Ui& ui, const Workbench& now, const Rect& place) const {
    const std::span<const cordic::PathDifference> path = now.processor.differences();
    const double worst = now.processor.report().position_error;
    const std::span<const std::size_t> late = now.processor.report().late;
    const Rect inside =
        below_title(ui,
                    place,
                    late.empty() ? std::string("CORDIC path against the exact one")
                                 : fmt::format("CORDIC path, exact path; {} set-points late", late.size()));
    (void)widgets::canvas(ui, "map", inside, 0);
    if (path.empty()) {
        return say(ui, inside, "No set-point.");
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
            sketch.line(before, here, colour_of(render::color_of(scale, path[n].distance)), 3.0F);
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
    legend.title = "Apart";
    legend.unit = "\u00b5m";
    legend.high = high / unit;
    legend.map = [](double t) { return colour_of(render::sample(render::ColorMap::viridis, t)); };
    legend.tip = "Distance of each set-point from where exact arithmetic has it";
    (void)widgets::legend(ui,
                          "legend",
                          {inside.right() - ui.px(legend_width),
                           inside.y + ui.px(6.0F),
                           ui.px(legend_width - 4.0F),
                           inside.h - ui.px(12.0F)},
                          legend);
}

} // namespace millwright::panels
