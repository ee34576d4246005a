#include "core/gcode_programs/work_origin.h"

#include <algorithm>

namespace millwright::gcode {

void put_origin(ReaderSettings& settings, const WorkOrigin& origin) {
    constexpr int first = 5221; // LinuxCNC's parameter of X of G54; those of the next system are 20 behind
    constexpr int stride = 20;
    constexpr int systems = 9;
    constexpr int rotation = 9;      // behind those of the nine axes
    constexpr int g92_active = 5210; // 1: a G92 offset is in force
    const double unit = settings.machine_unit == LengthUnit::mm ? 1.0 : mm_per_inch;
    const auto has = [&settings](int number) {
        return std::ranges::find(settings.parameters, number, [](const auto& one) { return one.first; }) !=
               settings.parameters.end();
    };
    const auto set_if_missing = [&](int number) {
        if (!has(number)) {
            settings.parameters.emplace_back(number, 0.0);
        }
    };
    set_if_missing(g92_active);
    for (int system = 0; system < systems; ++system) {
        const int number = first + stride * system;
        set_if_missing(number + rotation);
        for (int member = 3; member < rotation && origin.z; ++member) {
            set_if_missing(number + member);
        }
        settings.parameters.emplace_back(number, origin.x / unit);
        settings.parameters.emplace_back(number + 1, origin.y / unit);
        if (origin.z) {
            settings.parameters.emplace_back(number + 2, *origin.z / unit);
        }
    }
}

} // namespace millwright::gcode
