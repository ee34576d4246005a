// What a person taught an arm and wrote for it. People's units: mm, deg.
#pragma once

#include "core/geometry/vectors.h"

#include <string>
#include <vector>

namespace millwright::project {

struct TaughtPoint {
    std::string name;               ///< of its own among the points
    std::vector<double> joints_deg; ///< of each joint; mm of sliding ones
    bool straight = false;          ///< the tip comes there along a line, else joint by joint
    double speed_percent = 100.0;   ///< of the way to it

    friend bool operator==(const TaughtPoint&, const TaughtPoint&) = default;
};

/// Where the zero of a path stands in the arm's base: turned about fixed X, then Y, then Z, then moved.
struct PathPlace {
    Vec3 at_mm = Vec3(800.0, 0.0, 0.0);
    Vec3 turned_deg = Vec3::Zero();
    double most_lean_deg = 90.0; ///< of the tool from what is programmed, where too few joints hold it

    friend bool operator==(const PathPlace&, const PathPlace&) = default;
};

struct ArmInput {
    std::vector<TaughtPoint> points; ///< in the order in which they are played
    std::string program;             ///< of the card, in its own language, without OPEN and CLOSE
    std::string motion_file;         ///< lines and arcs of the tool, as the thesis wrote them
    PathPlace path;

    friend bool operator==(const ArmInput&, const ArmInput&) = default;
};

/// Turns and moves what is given in a path's coordinates into the arm's base; mm.
[[nodiscard]] Frame base_T_path(const PathPlace& place);

} // namespace millwright::project
