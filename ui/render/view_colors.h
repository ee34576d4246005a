// The colours of the program, apart from any toolkit's theme: one accent, a neutral ramp, signal colours.
// sRGB, 0 to 1. Widgets and the 3D view take them from here, so that both change together.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace millwright::render {

enum class Theme { dark, light };

/// What a person can give a colour of their own, in place of the theme's.
enum class LayerColor {
    background,
    surface,
    surface_u, ///< lines of the designed surface along u
    surface_v,
    produced, ///< the produced surface
    produced_u,
    produced_v,
    grid_u,
    grid_v,
    toolpath,
    axis_names,
    axis_x,
    axis_y,
    axis_z
};
inline constexpr std::size_t layer_color_count = 14;

/// sRGB, 0 to 1; nothing: the theme's.
class LayerColors {
public:
    [[nodiscard]] const std::optional<glm::vec3>& of(LayerColor which) const {
        return chosen_[static_cast<std::size_t>(which)];
    }
    void set(LayerColor which, const std::optional<glm::vec3>& color) {
        chosen_[static_cast<std::size_t>(which)] = color;
    }
    friend bool operator==(const LayerColors&, const LayerColors&) = default;

private:
    std::array<std::optional<glm::vec3>, layer_color_count> chosen_{};
};

struct LayerColorInfo {
    LayerColor which;
    std::string_view id;
    std::string_view label;
};
/// In the order of LayerColor.
[[nodiscard]] std::span<const LayerColorInfo> layer_color_infos();

/// Of "#rrggbb", in either case; nothing if `text` is not such.
[[nodiscard]] std::optional<glm::vec3> color_from(std::string_view text);
[[nodiscard]] std::string color_text(const glm::vec3& color);

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
    LayerColors chosen{}; ///< by a person; of what has no colour above
};

[[nodiscard]] ViewColors view_colors(Theme theme);
/// With the chosen ones. What is not seen on a chosen background is of the other theme.
[[nodiscard]] ViewColors view_colors(Theme theme, const LayerColors& chosen);

/// The one that a layer is drawn in, lines without their transparency: chosen or the theme's; nothing where
/// the theme has several, as for the names of the axes.
[[nodiscard]] std::optional<glm::vec3> color_of(const ViewColors& colors, LayerColor which);

// The colours of what is written straight on the background of a view, which a person can choose.

/// Of text and scales: the end of the neutral ramp that is read better on the background.
[[nodiscard]] glm::vec3 ink(const ViewColors& colors);
/// Of captions, next to that end.
[[nodiscard]] glm::vec3 faint_ink(const ViewColors& colors);

} // namespace millwright::render
