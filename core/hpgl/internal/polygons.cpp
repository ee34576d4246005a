#include "core/hpgl/internal/polygons.h"

#include "core/base/units.h"
#include "core/hpgl/internal/moves.h"
#include "core/plot_strokes/region.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::hpgl::internal {
namespace {

constexpr double usual_pen_width = 14.0; // plotter units: 0.35 mm, HP-GL/2's

void draw_outline(Pen& pen, const Outline& outline) {
    const auto drawn = [](const Vertex& vertex) { return vertex.drawn; };
    if (std::ranges::none_of(outline, drawn)) {
        return;
    }
    pen.place(outline.front().at);
    for (std::size_t n = 1; n < outline.size(); ++n) {
        if (outline[n].drawn) {
            pen.draw(outline[n].at);
        } else {
            pen.place(outline[n].at);
        }
    }
    if (pen.at() != outline.front().at) {
        pen.draw(outline.front().at);
    }
}

void draw_edges(Run& run, const Polygon& polygon) {
    const Vec2 home = run.pen.at();
    for (const Outline& outline : polygon) {
        draw_outline(run.pen, outline);
    }
    run.pen.place(home);
}

double chosen_pen_width(const Run& run) {
    const auto known = run.plot.pens.find(run.pen.number().value_or(0));
    const double width = known == run.plot.pens.end() ? 0.0 : known->second.width / run.settings.unit.x;
    return width > 0.0 ? width : usual_pen_width;
}

plot::HatchSettings hatch_settings(const Run& run) {
    const Filling& filling = run.modes.filling;
    const bool solid = filling.type <= 2;
    plot::HatchSettings settings;
    settings.pitch = solid                   ? chosen_pen_width(run)
                     : filling.spacing > 0.0 ? filling.spacing
                                             : 0.01 * run.diagonal();
    settings.angle = solid ? 0.0 : from_degrees(filling.angle_deg);
    settings.cross = filling.type == 4;
    settings.origin = run.units.p1();
    return settings;
}

void hatch_polygon(Run& run, const Polygon& polygon) {
    plot::Region region;
    for (const Outline& outline : polygon) {
        plot::Ring& ring = region.emplace_back();
        for (const Vertex& vertex : outline) {
            ring.push_back(vertex.at);
        }
    }
    const plot::HatchSettings settings = hatch_settings(run);
    constexpr double least_mm = 0.01; // no tool makes finer lines
    if (!(settings.pitch * run.settings.unit.x >= least_mm)) {
        return run.refuse(fmt::format("a fill with lines {:.4g} mm apart is too fine to cut",
                                      settings.pitch * run.settings.unit.x));
    }
    constexpr double most_lines = 1e6;
    if (!(plot::line_count(region, settings) < most_lines)) {
        return run.refuse("a fill needs more than a million lines");
    }
    const Vec2 home = run.pen.at();
    for (const plot::Stroke& stroke : plot::hatch(region, settings)) {
        run.pen.place(stroke.points.front());
        run.pen.draw(stroke.points.back());
    }
    run.pen.place(home);
}

void fill(Run& run, const Polygon& polygon) {
    if (run.refuses_if_lost()) {
        return;
    }
    switch (run.settings.fill) {
    case FillMode::hatched:
        return hatch_polygon(run, polygon);
    case FillMode::outline: {
        Polygon edges = polygon;
        for (Outline& outline : edges) {
            for (Vertex& vertex : outline) {
                vertex.drawn = true;
            }
        }
        return draw_edges(run, edges);
    }
    case FillMode::none:
        return;
    }
}

void edge(Run& run, const Polygon& polygon) {
    if (run.refuses_if_lost()) {
        return;
    }
    draw_edges(run, polygon);
}

/// A closed figure of corners in user units; empty if one is too far away.
Polygon figure(Run& run, const std::vector<Vec2>& corners) {
    Outline outline;
    for (const Vec2& corner : corners) {
        const Vec2 at = run.units.plotter(corner);
        if (!run.pen.is_near(at)) { // before it is filled with a thousand times the lines
            return {};
        }
        outline.push_back({at, true});
    }
    return {outline};
}

Polygon rectangle(Run& run, const Vec2& corner) {
    const Vec2 at = run.at();
    return figure(run, {at, {corner.x(), at.y()}, corner, {at.x(), corner.y()}});
}

Polygon wedge(Run& run, const Given& given) {
    const Vec2 centre = run.at();
    const double begin = from_degrees(given[1]);
    const Vec2 start = centre + given[0] * Vec2(std::cos(begin), std::sin(begin));
    const double sweep = std::clamp(given[2], -360.0, 360.0);
    const std::vector<Vec2> arc = arc_points(run, centre, start, sweep, given.value(3, usual_chord(run)));
    std::vector<Vec2> corners = {centre, start};
    corners.insert(corners.end(), arc.begin(), arc.end());
    return figure(run, corners);
}

bool refuses_without_polygon(Run& run) {
    if (run.pen.in_polygon()) {
        run.refuse("a polygon is drawn before PM2 closes it");
    } else if (run.polygon_damaged) {
        run.refuse("the polygon is skipped because it contains an error");
    } else if (run.pen.polygon().empty()) {
        run.refuse("there is no polygon to draw");
    }
    return run.pen.refused();
}

} // namespace

void polygon_mode(Run& run, const Given& given) {
    const double mode = given.value(0, 0.0);
    const bool open = run.pen.in_polygon();
    if (mode > 0.0 && !open) {
        return run.refuse(fmt::format("PM{} needs a PM0 before it", mode));
    }
    if (mode > 1.0) {
        run.pen.close_polygon();
    } else if (mode > 0.0) {
        run.pen.next_outline();
    } else {
        run.pen.open_polygon();
        run.polygon_damaged = run.pen.lost();
    }
}

void edge_polygon(Run& run, const Given&) {
    if (!refuses_without_polygon(run)) {
        edge(run, run.pen.polygon());
    }
}

void fill_polygon(Run& run, const Given&) {
    if (!refuses_without_polygon(run)) {
        fill(run, run.pen.polygon());
    }
}

void edge_rectangle_absolute(Run& run, const Given& given) {
    edge(run, rectangle(run, given.point(0)));
}

void edge_rectangle_relative(Run& run, const Given& given) {
    edge(run, rectangle(run, run.at() + given.point(0)));
}

void fill_rectangle_absolute(Run& run, const Given& given) {
    fill(run, rectangle(run, given.point(0)));
}

void fill_rectangle_relative(Run& run, const Given& given) {
    fill(run, rectangle(run, run.at() + given.point(0)));
}

void edge_wedge(Run& run, const Given& given) {
    edge(run, wedge(run, given));
}

void fill_wedge(Run& run, const Given& given) {
    fill(run, wedge(run, given));
}

void fill_type(Run& run, const Given& given) {
    const double spacing = given.value(1, 0.0);
    if (spacing < 0.0) {
        return run.refuse(fmt::format("FT: {} is not a valid spacing", spacing));
    }
    Filling filling;
    filling.type = static_cast<int>(given.value(0, 1.0));
    filling.spacing = run.units.plotter_step({spacing, 0.0}).norm();
    filling.angle_deg = given.value(2, 0.0);
    run.modes.filling = filling;
}

} // namespace millwright::hpgl::internal
