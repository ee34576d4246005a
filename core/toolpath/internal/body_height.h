// How high over a point of the surface a body of revolution begins, where only what is lower than something
// counts.
#pragma once

#include "core/toolpath/profile.h"

namespace millwright::toolpath {

/// As height_over(); what is not below `enough` may be given as any other height that is not.
[[nodiscard]] double height_below(const Profile& body,
                                  const geometry::ToolPose& pose,
                                  const Vec3& point,
                                  const Vec3& direction,
                                  double enough);

} // namespace millwright::toolpath
