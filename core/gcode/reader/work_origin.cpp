#include "core/gcode/reader/work_origin.h"

#include <algorithm>

namespace millwright::gcode {

void put_origin(ReaderSettings& settings, const WorkOrigin& origin) {
    constexpr int first = 5221; // LinuxCNC's parameter of X of G54; those of the next system are 20 behind
    constexpr int stride = 20;
    constexpr int systems = 9;
    constexpr int members = 10; // nine axes and the rotation
    const double unit = settings.machine_unit == LengthUnit::mm ? 1.0 : mm_per_inch;
    const auto has = [&settings](int number) {
        return std::ranges::find(settings.parameters, number, [](const auto& one) { return one.first; }) !=
               settings.parameters.end();
    };
    for (int system = 0; system < systems; ++system) {
        const int number = first + stride * system;
        for (int member = 3; member < members && origin.z; ++member) {
            if (!has(number + member)) {
                settings.parameters.emplace_back(number + member, 0.0);
            }
        }
        settings.parameters.emplace_back(number, origin.x / unit);
        settings.parameters.emplace_back(number + 1, origin.y / unit);
        if (origin.z) {
            settings.parameters.emplace_back(number + 2, *origin.z / unit);
        }
    }
}

} // namespace millwright::gcode
