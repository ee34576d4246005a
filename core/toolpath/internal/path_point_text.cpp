#include "core/toolpath/internal/path_point_text.h"

#include "core/base/error.h"

#include <fmt/format.h>

namespace millwright::toolpath {

void refuse_point(std::size_t n, const PathPoint& point, const std::string& why) {
    throw Error(fmt::format("path point {} (node {},{}, tip {:.3f} {:.3f} {:.3f}) cannot be reached: {}",
                            n,
                            point.origin.i,
                            point.origin.j,
                            point.pose.tip.x(),
                            point.pose.tip.y(),
                            point.pose.tip.z(),
                            why),
                {},
                "move the part on the table, or choose another machine");
}

} // namespace millwright::toolpath
