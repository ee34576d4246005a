#include "core/plan/internal/plot_view.h"

#include <algorithm>
#include <cmath>

namespace millwright::plan {

namespace {

using plot::CutMove;
using plot::CutPoint;

bool is_cut(const CutPoint& to) {
    return to.move == CutMove::plunge || to.move == CutMove::cut;
}

/// The moves that are wanted, as pieces that are drawn, and nothing between them.
template <class Wanted>
gcode::PreviewPath pieces(const plot::CutPath& path, const Vec2& shift, const Wanted& wanted) {
    gcode::PreviewPath made;
    gcode::PathChunker chunker;
    const auto add = [&](const plot::CutPoint& point, gcode::PathKind kind) {
        chunker.add({point.at + Vec3(shift.x(), shift.y(), 0.0), 0, kind}, 0.0);
        if (auto chunk = chunker.take_full()) {
            made.chunks.push_back(std::move(chunk));
        }
    };
    bool down = false;
    for (std::size_t n = 1; n < path.size(); ++n) {
        const bool drawn = wanted(path[n - 1], path[n]);
        if (drawn && !down) {
            add(path[n - 1], gcode::PathKind::start);
        }
        if (drawn) {
            add(path[n], gcode::PathKind::feed);
        }
        down = drawn;
    }
    if (auto rest = chunker.take_rest()) {
        made.chunks.push_back(std::move(rest));
    }
    return made;
}

/// With a point wherever a cut passes a multiple of `height`.
plot::CutPath divided(const plot::CutPath& path, double height) {
    plot::CutPath parts;
    for (const CutPoint& point : path) {
        if (point.move == CutMove::cut && !parts.empty() && height > 0.0) {
            const Vec3 from = parts.back().at;
            const double first = from.z() / height;
            const double last = point.at.z() / height;
            const double step = last > first ? 1.0 : -1.0;
            double level = step > 0.0 ? std::floor(first) + 1.0 : std::ceil(first) - 1.0;
            for (; step * level < step * last; level += step) {
                CutPoint between = point;
                between.at = from + (level - first) / (last - first) * (point.at - from);
                parts.push_back(between);
            }
        }
        parts.push_back(point);
    }
    return parts;
}

} // namespace

gcode::PreviewPath cuts_of(const plot::CutPath& path, const Vec2& shift) {
    return pieces(path, shift, [](const CutPoint&, const CutPoint& to) { return is_cut(to); });
}

gcode::PreviewPath cuts_with(const plot::CutPath& path, int tool) {
    return pieces(path, Vec2::Zero(), [tool](const CutPoint&, const CutPoint& to) {
        return is_cut(to) && to.tool == tool;
    });
}

std::vector<PlotResult::LevelPath> cuts_by_depth(const plot::CutPath& whole, const Vec2& shift) {
    constexpr int bands = 16; // more cannot be distinguished
    const double height = plot::deepest(whole) / bands;
    const plot::CutPath path = divided(whole, height);
    std::vector<PlotResult::LevelPath> cuts;
    for (int band = 0; band < bands && height > 0.0; ++band) {
        cuts.push_back({.depth = (band + 0.5) * height,
                        .path = pieces(path, shift, [&](const CutPoint& from, const CutPoint& to) {
                            const double depth =
                                to.move == CutMove::plunge ? -to.at.z() : -0.5 * (from.at.z() + to.at.z());
                            const int of = std::clamp(static_cast<int>(depth / height), 0, bands - 1);
                            return is_cut(to) && of == band;
                        })});
    }
    return cuts;
}

gcode::PreviewPath travel_of(const plot::CutPath& path) {
    return pieces(path, Vec2::Zero(), [](const CutPoint&, const CutPoint& to) {
        return to.move == CutMove::rapid || to.move == CutMove::retract;
    });
}

} // namespace millwright::plan
