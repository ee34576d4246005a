#include "ui/widgets/internal/line_style.h"

#include "ui/widgets/internal/curve.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::widgets {

namespace {

ImVec2 between(ImVec2 a, ImVec2 b, float share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

void draw_dashes(const std::vector<ImVec2>& run, float on, float off, Colour colour, float thickness) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    float walked = 0.0F; // since the dash began
    for (std::size_t n = 0; n + 1 < run.size(); ++n) {
        const float length = std::hypot(run[n + 1].x - run[n].x, run[n + 1].y - run[n].y);
        for (float at = 0.0F; at < length;) {
            const bool inked = walked < on;
            const float step = std::min(length - at, std::max(0.01F, (inked ? on : on + off) - walked));
            if (inked) {
                list.AddLine(between(run[n], run[n + 1], at / length),
                             between(run[n], run[n + 1], (at + step) / length),
                             colour,
                             thickness);
            }
            at += step;
            walked += step;
            if (walked >= on + off - 0.005F) {
                walked = 0.0F;
            }
        }
    }
}

} // namespace

std::vector<Series> with_looks(const Palette& colours, std::span<const Series> series) {
    constexpr std::array strokes{Stroke::solid, Stroke::dashed, Stroke::dotted};
    std::vector<Series> all(series.begin(), series.end());
    for (std::size_t n = 0; n < all.size(); ++n) {
        if (all[n].colour != 0) {
            continue;
        }
        all[n].colour = colours.series[n % std::size(colours.series)];
        if (all[n].stroke == Stroke::solid) {
            all[n].stroke = strokes[n / std::size(colours.series) % strokes.size()];
        }
    }
    return all;
}

void draw_stroke(const std::vector<ImVec2>& run, Stroke stroke, Colour colour, float thickness, float dash) {
    if (stroke == Stroke::solid || run.size() < 2) {
        draw_run(run, colour, thickness);
    } else {
        draw_dashes(run, stroke == Stroke::dashed ? dash : 0.3F * dash, 0.6F * dash, colour, thickness);
    }
}

void draw_marker(Marker marker, ImVec2 at, Colour colour, float size) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float thickness = 0.4F * size;
    const auto [x, y] = at;
    switch (marker) {
    case Marker::none:
        return;
    case Marker::disc:
        list.AddCircleFilled(at, size, colour);
        return;
    case Marker::ring:
        list.AddCircle(at, size, colour, 0, thickness);
        return;
    case Marker::square:
        list.AddRectFilled({x - size, y - size}, {x + size, y + size}, colour);
        return;
    case Marker::triangle:
        list.AddTriangleFilled({x, y - size}, {x + size, y + size}, {x - size, y + size}, colour);
        return;
    case Marker::cross:
        list.AddLine({x - size, y - size}, {x + size, y + size}, colour, thickness);
        list.AddLine({x - size, y + size}, {x + size, y - size}, colour, thickness);
        return;
    }
}

} // namespace millwright::widgets
