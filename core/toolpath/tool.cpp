#include "core/toolpath/tool.h"

#include <cmath>

namespace millwright::toolpath {

bool Lean::upright() const {
    return *this == Lean{};
}

Vec3 leaning_axis(const Lean& lean, const Vec3& normal, const Vec3& feed, double along) {
    const double lead = lean.lead + along * lean.lead_change;
    const double tilt = lean.tilt + along * lean.tilt_change;
    const Vec3 right = feed.cross(normal);
    return (std::cos(lead) * (std::cos(tilt) * normal + std::sin(tilt) * right) + std::sin(lead) * feed)
        .normalized();
}

} // namespace millwright::toolpath
