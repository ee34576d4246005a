#include "core/plot/stroke_plan.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/plot/compensation.h"
#include "core/plot/linking.h"
#include "core/plot/ordering.h"
#include "core/plot_strokes/region.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
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
            throw Error(fmt::format("a hatch of {} mm needs more than a million lines", settings.pitch));
        }
        append(strokes, hatch(region, settings, pen));
    }
    if (plan.contour_pitch) {
        append(strokes, contour_hatch(region, *plan.contour_pitch, *plan.contour_pitch, pen));
    }
    return strokes;
}

} // namespace

StrokePlan StrokePlan::of_pen(int pen) const {
    StrokePlan result = *this;
    result.cutters.clear();
    const auto own = std::ranges::find(cutters, pen, &PenCutter::pen);
    if (own != cutters.end()) {
        result.side = own->side;
        result.tool_diameter = own->tool_diameter;
    }
    return result;
}

bool StrokePlan::compensates() const {
    return side != CutterSide::on_line || std::ranges::any_of(cutters, [](const PenCutter& cutter) {
               return cutter.side != CutterSide::on_line;
           });
}

std::map<int, double> tool_diameters(const std::vector<Level>& levels) {
    std::map<int, double> diameters;
    for (const Level& level : levels) {
        if (level.tool_diameter) {
            diameters.emplace(level.tool, *level.tool_diameter);
        }
    }
    return diameters;
}

namespace {

/// A tool has one diameter, whatever pen it cuts.
void expect_one_diameter(const std::vector<Level>& levels, double usual) {
    std::map<int, double> diameters;
    for (const Level& level : levels) {
        const double diameter = level.tool_diameter.value_or(usual);
        const double known = diameters.emplace(level.tool, diameter).first->second;
        if (level.enabled && !exactly_equal(known, diameter)) {
            throw Error(fmt::format("tool {} is {} mm wide in one level, but {} mm in another",
                                    level.tool,
                                    shortest(known),
                                    shortest(diameter)),
                        {},
                        "use another tool in one of the levels");
        }
    }
}

} // namespace

StrokePlan with_cutters(StrokePlan plan, const std::vector<Level>& levels) {
    expect_one_diameter(levels, plan.tool_diameter);
    plan.cutters.clear();
    for (const Level& level : levels) {
        const PenCutter cutter{.pen = level.pen,
                               .side = level.side.value_or(plan.side),
                               .tool_diameter = level.tool_diameter.value_or(plan.tool_diameter)};
        const auto known = std::ranges::find(plan.cutters, level.pen, &PenCutter::pen);
        if (known == plan.cutters.end()) {
            plan.cutters.push_back(cutter);
        } else if (!(*known == cutter)) {
            throw Error(fmt::format("two levels of pen {} differ in side or cutter", level.pen),
                        {},
                        "use another pen for strokes with a different side or cutter: all strokes of one pen "
                        "are cut along the same path");
        }
    }
    std::erase_if(plan.cutters, [&](const PenCutter& cutter) {
        return cutter.side == plan.side && exactly_equal(cutter.tool_diameter, plan.tool_diameter);
    });
    return plan;
}

ShapedStrokes shaped(const Strokes& drawn, const StrokePlan& plan) {
    const bool hatches = plan.hatch_pitch || plan.contour_pitch;
    if (!hatches && !plan.compensates()) {
        return {drawn, 0};
    }
    ShapedStrokes result;
    for (auto& [pen, found] : pen_strokes(drawn)) {
        const StrokePlan own = plan.of_pen(pen);
        const CompensationSettings settings{
            .tool_diameter = own.tool_diameter, .side = own.side, .corners = own.corners};
        result.open += own.side != CutterSide::on_line || hatches ? found.open.size() : 0;
        append(result.strokes, found.open);
        append(result.strokes, compensated(found.closed, settings, pen));
        // Inside, the hatch keeps off the outline as the tool's middle does.
        const bool shrinks = own.side == CutterSide::inside;
        append(result.strokes,
               hatched(shrinks ? offset(found.closed, -own.tool_diameter / 2.0, own.corners) : found.closed,
                       pen,
                       own));
    }
    if (result.strokes.empty()) {
        throw Error("nothing is left to cut",
                    {},
                    "check the tool diameter: closed strokes may be too small for the tool");
    }
    return result;
}

namespace {

/// What links must not cross: the outlines, and where the middle of the tool has to keep off them.
std::vector<Ring> link_bounds(const Strokes& drawn, const StrokePlan& plan) {
    std::vector<Ring> rings = closed_outlines(drawn);
    for (const auto& [pen, found] : pen_strokes(drawn)) {
        const StrokePlan own = plan.of_pen(pen);
        if (own.side != CutterSide::on_line) {
            const double radius = own.tool_diameter / 2.0;
            const Region kept =
                offset(found.closed, own.side == CutterSide::inside ? -radius : radius, own.corners);
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

namespace {

std::string on_open(const Strokes& drawn, std::size_t open) {
    if (open == 0) {
        return {};
    }
    if (closed_outlines(drawn).empty()) {
        return "no stroke is closed, so nothing is filled or compensated";
    }
    return open == 1
               ? "1 open stroke stays unchanged: it is neither filled nor compensated"
               : fmt::format("{} open strokes stay unchanged: they are neither filled nor compensated", open);
}

std::size_t unreachable_regions(const Strokes& drawn, const StrokePlan& plan) {
    std::map<int, Strokes> pens;
    for (const Stroke& stroke : drawn) {
        pens[stroke.pen].push_back(stroke);
    }
    std::size_t count = 0;
    for (const auto& [pen, strokes] : pens) {
        const StrokePlan own = plan.of_pen(pen);
        if (own.side != CutterSide::on_line) {
            count += count_unreachable_regions(closed_outlines(strokes),
                                               {.tool_diameter = own.tool_diameter, .side = own.side});
        }
    }
    return count;
}

std::string on_narrow(std::size_t parts) {
    if (parts == 0) {
        return {};
    }
    return parts == 1 ? "1 closed area is too narrow for the tool and is not cut"
                      : fmt::format("{} closed areas are too narrow for the tool and are not cut", parts);
}

std::string on_links(const Strokes& drawn, const StrokePlan& plan) {
    return plan.link > 0.0 && plan.link_inside && closed_outlines(drawn).empty()
               ? "no stroke is closed, so links are not kept inside"
               : "";
}

} // namespace

std::string unprocessed_strokes(const Strokes& drawn, const ShapedStrokes& shaped, const StrokePlan& plan) {
    const std::string open = on_open(drawn, shaped.open);
    const std::string narrow = on_narrow(unreachable_regions(drawn, plan));
    std::string all;
    for (const std::string& remark : {open, narrow, on_links(drawn, plan)}) {
        all += (all.empty() || remark.empty() ? "" : "; ") + remark;
    }
    return all;
}

} // namespace millwright::plot
