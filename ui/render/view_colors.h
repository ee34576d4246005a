// The colours of the program, apart from any toolkit's theme: one accent, a neutral ramp, signal colours.
// sRGB, 0 to 1. Widgets and the 3D view take them from here, so that both change together.
#pragma once

#include <glm/vec3.hpp>

#include <array>

namespace millwright::render {

enum class Theme { dark, light };

struct ViewColors {
    Theme theme = Theme::dark;

    // The window.
    glm::vec3 accent{};                 ///< what is active or selected
    glm::vec3 on_accent{};              ///< text on the accent
    std::array<glm::vec3, 8> neutral{}; ///< from the window's ground (0) to the strongest text (7)
    glm::vec3 danger{};                 ///< emergency stop, faults; nothing else is red
    glm::vec3 warning{};
    glm::vec3 good{};

    // The 3D view.
    glm::vec3 background_top{};
    glm::vec3 background_bottom{};
    glm::vec3 floor_line{};       ///< fine lines of the ground grid
    glm::vec3 floor_line_major{}; ///< each tenth
    glm::vec3 surface{};          ///< the designed part
    glm::vec3 surface_back{};     ///< its other side
    glm::vec3 wire{};             ///< grid lines on a surface
    glm::vec3 net{};              ///< control net
    glm::vec3 handle{};           ///< control points
    glm::vec3 selected{};
    glm::vec3 path{};
    glm::vec3 rapid{};
    glm::vec3 machine{};        ///< frame of a machine or an arm
    glm::vec3 machine_moving{}; ///< its moving parts
    glm::vec3 tool{};
    glm::vec3 over_limit{}; ///< signal colour of color maps
    glm::vec3 axis_x{};
    glm::vec3 axis_y{};
    glm::vec3 axis_z{};
};

[[nodiscard]] ViewColors view_colors(Theme theme);

} // namespace millwright::render
