// Machines and poses for tests.
#pragma once

#include "core/geometry/tool_pose.h"
#include "core/kinematics/machine_file.h"

#include <random>
#include <string>

namespace millwright::test {

inline kinematics::MachineModel machine(const std::string& name) {
    return kinematics::read_machine("assets/machines/" + name + ".json");
}

inline Vec3 random_point(std::mt19937& random, double within) {
    std::uniform_real_distribution<double> coordinate(-within, within);
    return {coordinate(random), coordinate(random), coordinate(random)};
}

/// A direction in the upper half space, at least 0.6 deg from the vertical.
inline Vec3 random_upward(std::mt19937& random) {
    while (true) {
        Vec3 n = random_point(random, 1.0);
        n.z() = std::abs(n.z());
        if (n.norm() > 0.1 && n.head<2>().norm() > 0.01 * n.norm()) {
            return n.normalized();
        }
    }
}

} // namespace millwright::test
