// How the workbench looks: one neutral ramp, one accent, equal gaps, corners of 4 px, dark or light.
// Lengths here are pixels at scale 1; the Look carries the scale of the monitor.
#pragma once

#include <cstdint>

struct ImGuiStyle;

namespace millwright::widgets {

/// Packed as ImGui packs it: alpha, blue, green, red from the highest byte down.
using Colour = std::uint32_t;

/// From 0xRRGGBB and an opacity of 0 to 1.
[[nodiscard]] constexpr Colour rgb(std::uint32_t hex, double opacity = 1.0) {
    const auto alpha = static_cast<std::uint32_t>(opacity * 255.0 + 0.5);
    return alpha << 24U | (hex & 0xFFU) << 16U | (hex & 0xFF00U) | (hex >> 16U & 0xFFU);
}

/// The same colour with its opacity multiplied by `share`.
[[nodiscard]] constexpr Colour faded(Colour colour, double share) {
    const auto alpha = static_cast<std::uint32_t>(static_cast<double>(colour >> 24U) * share + 0.5);
    return (colour & 0xFFFFFFU) | alpha << 24U;
}

/// `a` towards `b` by `t` from 0 to 1, each channel alone.
[[nodiscard]] Colour mixed(Colour a, Colour b, double t);

enum class Theme { dark, light };

/// What colours mean. Red (`danger`) is for danger and refused input only.
struct Palette {
    Colour window;    ///< behind everything, between the panes
    Colour pane;      ///< the ground of a pane
    Colour raised;    ///< headers, buttons, popups
    Colour field;     ///< where one types
    Colour hover;     ///< under the mouse
    Colour line;      ///< separators, outlines
    Colour text;      ///< contrast of at least 7 : 1 on pane
    Colour muted;     ///< units, labels of lesser rank; at least 4.5 : 1 on pane
    Colour accent;    ///< what is chosen, active, primary
    Colour on_accent; ///< text on accent
    Colour selection; ///< ground of a chosen row
    Colour good;
    Colour warning;
    Colour danger;
    Colour on_danger;
    Colour series[12]; ///< lines of a plot; colour-blind people can distinguish the first six, too
    Colour axis[3];    ///< x, y, z
};

[[nodiscard]] const Palette& palette(Theme theme);

/// The gaps that everything keeps.
namespace gaps {
inline constexpr float tiny = 4.0F;
inline constexpr float small = 6.0F;
inline constexpr float pad = 12.0F; ///< pane border to content
inline constexpr float row = 26.0F; ///< height of a control
inline constexpr float rounding = 4.0F;
} // namespace gaps

/// Gives ImGui's own parts (popups, scroll bars, text cursor, keyboard focus) the same look.
void apply(Theme theme, float scale, ImGuiStyle& style);

} // namespace millwright::widgets
