// How closely a motion keeps to the programmed path in its corners: G61, G61.1, G64.
#pragma once

#include <cstdint>

namespace millwright::program {

enum class PathMode : std::uint8_t {
    exact_path, ///< G61: through the programmed points
    exact_stop, ///< G61.1: to rest in each
    continuous  ///< G64: corners may be rounded
};

struct PathControl {
    PathMode mode = PathMode::exact_path;
    double tolerance = 0.0; ///< continuous: of the tool tip's path, mm; 0: the program does not say
    bool of_cycle = false;  ///< a canned cycle asks for it, the program does not

    friend bool operator==(const PathControl&, const PathControl&) = default;
};

} // namespace millwright::program
