#include "core/project/internal/plot_view.h"

namespace millwright::project {

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
        const bool drawn = wanted(path[n]);
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

} // namespace

gcode::PreviewPath cuts_of(const plot::CutPath& path, const Vec2& shift) {
    return pieces(path, shift, is_cut);
}

gcode::PreviewPath cuts_with(const plot::CutPath& path, int tool) {
    return pieces(path, Vec2::Zero(), [tool](const CutPoint& to) { return is_cut(to) && to.tool == tool; });
}

gcode::PreviewPath travel_of(const plot::CutPath& path) {
    return pieces(path, Vec2::Zero(), [](const CutPoint& to) {
        return to.move == CutMove::rapid || to.move == CutMove::retract;
    });
}

} // namespace millwright::project
