// The largest of many angles between two directions, of which only the last is worth an arc tangent.
#pragma once

#include "core/base/numbers.h"
#include "core/geometry/vectors.h"

#include <cmath>

namespace millwright::toolpath {

class LargestAngle {
public:
    /// Neither needs the length 1.
    void see(const Vec3& a, const Vec3& b) {
        const double across = a.cross(b).squaredNorm();
        const double along = a.dot(b);
        if (wider(across, along)) {
            across_ = across;
            along_ = along;
        }
    }
    [[nodiscard]] double angle() const { return std::atan2(std::sqrt(across_), along_); } ///< rad

private:
    [[nodiscard]] bool wider(double across, double along) const {
        if (along > 0.0 && along_ > 0.0) {
            return across * square(along_) > across_ * square(along);
        }
        return std::atan2(std::sqrt(across), along) > angle();
    }

    double across_ = 0.0; // |a x b|^2
    double along_ = 1.0;  // a . b
};

} // namespace millwright::toolpath
