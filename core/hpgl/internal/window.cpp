#include "core/hpgl/internal/window.h"

#include <algorithm>

namespace millwright::hpgl::internal {

bool clip(const Window& window, Vec2& from, Vec2& to) {
    const Vec2 along = to - from;
    double enter = 0.0;
    double leave = 1.0;
    for (const int axis : {0, 1}) {
        const double below = window.lower[axis] - from[axis];
        const double above = window.upper[axis] - from[axis];
        const double d = along[axis];
        if (d > 0.0 || d < 0.0) {
            enter = std::max(enter, (d > 0.0 ? below : above) / d);
            leave = std::min(leave, (d > 0.0 ? above : below) / d);
        } else if (below > 0.0 || above < 0.0) {
            return false;
        }
    }
    if (!(enter <= leave)) {
        return false;
    }
    const Vec2 start = from;
    if (enter > 0.0) {
        from = start + enter * along;
    }
    if (leave < 1.0) {
        to = start + leave * along;
    }
    return true;
}

} // namespace millwright::hpgl::internal
