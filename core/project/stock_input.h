// What a project's part is cut from in a simulation. Lengths mm.
#pragma once

#include "core/geometry/vectors.h"

#include <filesystem>
#include <string>

namespace millwright::project {

struct StockInput {
    bool around_part = true;   ///< the bounding box of the surface, larger by the allowance
    double allowance_mm = 2.0; ///< on every side of that box
    /// Else a box, cylinder or tube as the command line names it (core/simulation/spec_text.h); what is wrong
    /// in it is found when it is used.
    std::string shape = "box:100,100,20@-50,-50,-20";
    std::filesystem::path file;   ///< of a mesh in mm, in place of `shape`; empty: none
    Vec3 position = Vec3::Zero(); ///< of that mesh: added to its points

    friend bool operator==(const StockInput&, const StockInput&) = default;
};

inline constexpr double largest_allowance_mm = 1000.0;

} // namespace millwright::project
