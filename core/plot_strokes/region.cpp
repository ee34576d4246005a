#include "core/plot_strokes/region.h"

#include <cstddef>

namespace millwright::plot {

bool contains(const Region& region, const Vec2& point) {
    bool inside = false;
    for (const Ring& ring : region) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const Vec2& a = ring[n];
            const Vec2& b = ring[(n + 1) % ring.size()];
            if ((a.y() <= point.y()) != (b.y() <= point.y())) {
                const double t = (point.y() - a.y()) / (b.y() - a.y());
                inside ^= point.x() < a.x() + t * (b.x() - a.x());
            }
        }
    }
    return inside;
}

} // namespace millwright::plot
