#include "core/plot/stroke_plan.h"

#include "core/base/error.h"
#include "core/plot/closing.h"
#include "core/plot/cut_path.h"
#include "core/plot/hatching.h"
#include "core/plot/linking.h"
#include "core/plot/ordering.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>
#include <vector>

namespace millwright::plot {

namespace {

/// What one pen draws, its closed strokes apart.
struct PenStrokes {
    Region closed;
    Strokes open;
};

/// By pen, in the order in which they first draw.
std::vector<std::pair<int, PenStrokes>> pen_strokes(const Strokes& strokes) {
    std::vector<std::pair<int, PenStrokes>> pens;
    for (const Level& level : levels_for(strokes)) {
        PenStrokes& found = pens.emplace_back(level.pen, PenStrokes()).second;
        for (const Stroke& stroke : strokes) {
            if (stroke.pen != level.pen) {
                continue;
            }
            const Region ring = closed_outlines({stroke});
            if (ring.empty()) {
                found.open.push_back(stroke);
            } else {
                found.closed.push_back(ring.front());
            }
        }
    }
    return pens;
}

void append(Strokes& to, Strokes from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

Strokes hatched(const Region& region, int pen, const StrokePlan& plan) {
    Strokes strokes;
    if (plan.hatch_pitch) {
        HatchSettings settings;
        settings.pitch = *plan.hatch_pitch;
        settings.angle = plan.hatch_angle;
        settings.cross = plan.hatch_cross;
        constexpr double most_lines = 1e6;
        if (line_count(region, settings) > most_lines) {
            throw Error(fmt::format("a hatch of {} mm has more than a million lines", settings.pitch));
        }
        append(strokes, hatch(region, settings, pen));
    }
    if (plan.contour_pitch) {
        append(strokes, contour_hatch(region, *plan.contour_pitch, *plan.contour_pitch, pen));
    }
    return strokes;
}

} // namespace

ShapedStrokes shaped(const Strokes& drawn, const StrokePlan& plan) {
    const bool hatches = plan.hatch_pitch || plan.contour_pitch;
    const bool compensates = plan.side != CutterSide::on_line;
    if (!hatches && !compensates) {
        return {drawn, 0};
    }
    CompensationSettings settings;
    settings.tool_diameter = plan.tool_diameter;
    settings.side = plan.side;
    settings.corners = plan.corners;
    ShapedStrokes result;
    for (auto& [pen, found] : pen_strokes(drawn)) {
        result.open += found.open.size();
        append(result.strokes, found.open);
        append(result.strokes, compensated(found.closed, settings, pen));
        // Inside, the hatch keeps off the outline as the tool's middle does.
        const bool shrinks = plan.side == CutterSide::inside;
        append(result.strokes,
               hatched(shrinks ? offset(found.closed, -plan.tool_diameter / 2.0, plan.corners) : found.closed,
                       pen,
                       plan));
    }
    if (result.strokes.empty()) {
        throw Error("nothing is left to cut", {}, "closed strokes may be too small for the tool");
    }
    return result;
}

namespace {

/// What links must not cross: the outlines, and where the middle of the tool has to keep off them.
std::vector<Ring> link_bounds(const Strokes& drawn, const StrokePlan& plan) {
    std::vector<Ring> rings = closed_outlines(drawn);
    if (plan.side != CutterSide::on_line) {
        const double radius = plan.tool_diameter / 2.0;
        for (const auto& [pen, found] : pen_strokes(drawn)) {
            const Region kept =
                offset(found.closed, plan.side == CutterSide::inside ? -radius : radius, plan.corners);
            rings.insert(rings.end(), kept.begin(), kept.end());
        }
    }
    return rings;
}

} // namespace

Strokes linked(const Strokes& shaped, const Strokes& drawn, const StrokePlan& plan) {
    if (!(plan.link > 0.0)) {
        return shaped;
    }
    LinkSettings settings;
    settings.distance = plan.link;
    if (plan.link_inside) {
        settings.outlines = link_bounds(drawn, plan);
    }
    return link(shaped, settings).strokes;
}

ShapedStrokes planned(const Strokes& drawn, const StrokePlan& plan, const Progress& progress) {
    const Strokes outlines = outlines_for(drawn, plan);
    ShapedStrokes result = shaped(outlines, plan);
    progress.check();
    if (plan.order) {
        result.strokes = ordered(result.strokes, Vec2::Zero(), Vec2::Zero(), progress);
    }
    result.strokes = linked(result.strokes, outlines, plan);
    return result;
}

} // namespace millwright::plot
