#include "core/plot/unprocessed_strokes.h"

#include "core/plot/linking.h"
#include "core/plot/unreachable_regions.h"

#include <fmt/format.h>

#include <cstddef>
#include <map>

namespace millwright::plot {
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
