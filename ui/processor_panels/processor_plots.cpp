#include "ui/processor_panels/processor_plots.h"

#include "core/base/units.h"
#include "ui/processor_panels/titled_drawing.h"
#include "ui/widgets/canvas.h"
#include "ui/widgets/plot.h"
#include "ui/widgets/sketch.h"
#include "ui/workspaces/processor_workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace millwright::panels {

namespace {

using widgets::Point;
using widgets::Rect;
using widgets::Sketch;

std::string pass_title(const cordic::IterationTrace& trace) {
    if (trace.points.empty()) {
        return "CORDIC pass: none yet";
    }
    const auto steps = std::ranges::count_if(trace.points, [](const auto& p) { return !p.corrects; }) - 1;
    const auto corrections = std::ranges::count_if(trace.points, [](const auto& p) { return p.corrects; });
    return fmt::format("{}, {} {}",
                       trace.mode == cordic::Mode::rotation ? "Rotation" : "Vectoring",
                       corrections > 0 ? "correction" : "step", // which come behind all steps
                       corrections > 0 ? corrections : steps);
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

void ProcessorPlots::draw(Ui& ui, const FrameState& now, ActionQueue&) {
    const Rect all = ui.rest();
    const float gap = ui.px(8.0F);
    const float height = all.h;
    const float square = std::min(height - ui.px(titled_height), 0.26F * all.w);
    const float left = all.w - square - 3.0F * gap;
    float x = all.x;
    const auto next = [&](float width) {
        const Rect place{x, all.y, width, height};
        x += width + gap;
        return place;
    };
    draw_vector(ui, now, next(square));
    draw_errors(ui, now, next(0.36F * left));
    path_.draw(ui, now, next(0.30F * left));
    draw_difference_map(ui, now, next(0.34F * left));
}

void ProcessorPlots::draw_vector(Ui& ui, const FrameState& now, const Rect& place) const {
    const cordic::IterationTrace trace = now.processor.debugger().iterations();
    const Rect inside = below_title(ui, place, pass_title(trace));
    (void)widgets::canvas(ui, "vector", inside, 0);
    if (trace.points.empty()) {
        return say(ui, inside, "Step until a pass starts.");
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
                fmt::format("remaining {:.3g}\u00b0", to_degrees(trace.points.back().angle_error)),
                colours.text,
                widgets::TextAlign::left,
                widgets::TextFont::small);
}

void ProcessorPlots::draw_errors(Ui& ui, const FrameState& now, const Rect& place) const {
    const Rect inside = below_title(ui, place, "Remaining angle");
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
        {{"remaining", steps, errors, 0, false},
         {"step angle", angles.steps, angles.degrees, ui.colours().muted, false}}};
    view.series =
        steps.empty() ? std::span<const widgets::Series>() : std::span<const widgets::Series>(series);
    view.height = inside.h;
    view.when_empty = "No steps yet.";
    const Rect next = ui.rest();
    ui.move_by(inside.x - next.x, inside.y - next.y);
    const auto width = ui.width(inside.w);
    (void)widgets::line_plot(ui, "errors", view);
}

} // namespace millwright::panels
