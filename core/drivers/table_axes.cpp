#include "core/drivers/table_axes.h"

#include "core/base/error.h"

#include <fmt/format.h>

namespace millwright::drivers {

std::array<std::size_t, 3> table_axes(const kinematics::MachineModel& model) {
    std::array<std::size_t, 3> found{};
    for (std::size_t n = 0; n < found.size(); ++n) {
        const int axis = model.axis_index("XYZ"[n]);
        if (axis < 0) {
            throw Error(fmt::format("machine '{}' has no axis {}", model.name(), "XYZ"[n]));
        }
        found[n] = static_cast<std::size_t>(axis);
    }
    return found;
}

} // namespace millwright::drivers
