#include "core/gcode/reader/work_origin.h"

namespace millwright::gcode {

void put_origin(ReaderSettings& settings, const Vec3& origin) {
    constexpr int first = 5221; // LinuxCNC's parameter of X of G54; those of the next system are 20 behind
    constexpr int stride = 20;
    constexpr int systems = 9;
    const double unit = settings.machine_unit == LengthUnit::mm ? 1.0 : mm_per_inch;
    for (int system = 0; system < systems; ++system) {
        for (int axis = 0; axis < 3; ++axis) {
            settings.parameters.emplace_back(first + stride * system + axis, origin[axis] / unit);
        }
    }
}

} // namespace millwright::gcode
