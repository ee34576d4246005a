#include "ui/widgets/internal/curve.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::widgets {

namespace {

/// One column of pixels of a curve: where it comes in, its extremes, where it goes out.
struct Stack {
    float x = 0.0F;
    float in = 0.0F;
    float low = 0.0F;
    float high = 0.0F;
    float out = 0.0F;

    explicit Stack(ImVec2 at) : x(at.x), in(at.y), low(at.y), high(at.y), out(at.y) {}

    void add(float y) {
        low = std::min(low, y);
        high = std::max(high, y);
        out = y;
    }
    void append_to(std::vector<ImVec2>& run) const {
        run.push_back({x, in});
        for (const float y : {low, high, out}) {
            if (std::abs(y - run.back().y) > 0.25F) {
                run.push_back({x, y});
            }
        }
    }
};

} // namespace

bool Mapping::has_place(double x, double y) const {
    return std::isfinite(x) && std::isfinite(y) && (!y_is_log || y > 0.0);
}

float Mapping::pixel_x(double x) const {
    return box.x + box.w * static_cast<float>(std::clamp((x - x_low) / (x_high - x_low), -1.0, 2.0));
}

float Mapping::pixel_y(double y) const {
    const double t =
        y_is_log ? std::log(y / y_low) / std::log(y_high / y_low) : (y - y_low) / (y_high - y_low);
    return box.bottom() - box.h * static_cast<float>(std::clamp(t, -1.0, 2.0));
}

double Mapping::value_x(float pixel) const {
    const double t = static_cast<double>((pixel - box.x) / box.w);
    return x_low + std::clamp(t, 0.0, 1.0) * (x_high - x_low);
}

std::vector<std::vector<ImVec2>>
runs(const Mapping& mapping, std::span<const double> x, std::span<const double> y) {
    std::vector<std::vector<ImVec2>> found;
    std::optional<Stack> stack;
    const auto end_run = [&] {
        if (stack) {
            stack->append_to(found.back());
            stack.reset();
        }
    };
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
        if (!mapping.has_place(x[i], y[i])) {
            end_run();
            continue;
        }
        const ImVec2 at{mapping.pixel_x(x[i]), mapping.pixel_y(y[i])};
        if (!stack) {
            found.emplace_back();
            stack.emplace(at);
        } else if (at.x - stack->x < 0.5F) {
            stack->add(at.y);
        } else {
            stack->append_to(found.back());
            stack.emplace(at);
        }
    }
    end_run();
    return found;
}

void draw_run(const std::vector<ImVec2>& run, Colour colour, float thickness) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (run.size() == 1) {
        list.AddCircleFilled(run.front(), 1.5F * thickness, colour);
        return;
    }
    list.AddPolyline(run.data(), static_cast<int>(run.size()), colour, ImDrawFlags_None, thickness);
}

void fill_below(const std::vector<ImVec2>& run, float bottom, Colour colour) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImDrawListFlags flags = list.Flags;
    list.Flags &= ~ImDrawListFlags_AntiAliasedFill; // soft edges of neighbours would show as stripes
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
        const ImVec2& a = run[i];
        const ImVec2& b = run[i + 1];
        if (b.x > a.x) {
            list.AddQuadFilled(a, b, {b.x, bottom}, {a.x, bottom}, colour);
        }
    }
    list.Flags = flags;
}

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
