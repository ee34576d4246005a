#include "ui/render/view_colors.h"

#include "ui/render/color_map.h"

#include <glm/common.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace millwright::render {

namespace {

glm::vec3 rgb(int red, int green, int blue) {
    return glm::vec3(red, green, blue) / 255.0F;
}

ViewColors dark() {
    return {.theme = Theme::dark,
            .accent = rgb(61, 155, 233),
            .on_accent = rgb(8, 16, 24),
            .neutral = {rgb(22, 25, 29),
                        rgb(29, 33, 38),
                        rgb(38, 43, 49),
                        rgb(51, 57, 65),
                        rgb(76, 84, 94),
                        rgb(134, 143, 154),
                        rgb(190, 197, 206),
                        rgb(232, 236, 241)},
            .danger = rgb(229, 72, 77),
            .warning = rgb(240, 178, 50),
            .good = rgb(70, 180, 120),
            .background_top = rgb(49, 57, 68),
            .background_bottom = rgb(24, 27, 32),
            .floor_line = rgb(58, 65, 75),
            .floor_line_major = rgb(76, 85, 97),
            .surface = rgb(166, 180, 196),
            .surface_back = rgb(150, 136, 150),
            .wire = rgb(30, 36, 44),
            .net = rgb(205, 214, 224),
            .handle = rgb(240, 244, 248),
            .selected = rgb(255, 176, 46),
            .path = rgb(120, 200, 255),
            .rapid = rgb(150, 158, 168),
            .machine = rgb(104, 116, 130),
            .machine_moving = rgb(150, 162, 176),
            .tool = rgb(214, 190, 130),
            .over_limit = rgb(255, 92, 77),
            .axis_x = rgb(236, 98, 95),
            .axis_y = rgb(120, 196, 92),
            .axis_z = rgb(88, 148, 240)};
}

ViewColors light() {
    return {.theme = Theme::light,
            .accent = rgb(20, 104, 184),
            .on_accent = rgb(255, 255, 255),
            .neutral = {rgb(244, 246, 248),
                        rgb(235, 238, 241),
                        rgb(224, 228, 232),
                        rgb(204, 210, 216),
                        rgb(164, 172, 181),
                        rgb(104, 113, 123),
                        rgb(60, 68, 77),
                        rgb(24, 29, 35)},
            .danger = rgb(196, 43, 48),
            .warning = rgb(163, 104, 0),
            .good = rgb(24, 121, 70),
            .background_top = rgb(206, 216, 227),
            .background_bottom = rgb(246, 248, 250),
            .floor_line = rgb(206, 213, 221),
            .floor_line_major = rgb(178, 188, 199),
            .surface = rgb(158, 176, 198),
            .surface_back = rgb(186, 170, 180),
            .wire = rgb(44, 54, 66),
            .net = rgb(70, 82, 96),
            .handle = rgb(28, 36, 46),
            .selected = rgb(214, 116, 0),
            .path = rgb(14, 98, 176),
            .rapid = rgb(120, 128, 138),
            .machine = rgb(140, 150, 161),
            .machine_moving = rgb(176, 185, 195),
            .tool = rgb(170, 138, 62),
            .over_limit = rgb(214, 40, 40),
            .axis_x = rgb(204, 52, 50),
            .axis_y = rgb(62, 142, 40),
            .axis_z = rgb(36, 96, 200)};
}

/// Takes from `other` what is seen better there on `background`, of what is not seen well.
void keep_off(ViewColors& colors,
              const glm::vec3& background,
              const ViewColors& other,
              const LayerColors& chosen) {
    constexpr double visible = 2.4;
    const auto choose = [&](glm::vec3 ViewColors::*mark) {
        const double now = contrast(colors.*mark, background);
        if (now < visible && contrast(other.*mark, background) > now) {
            colors.*mark = other.*mark;
        }
    };
    for (glm::vec3 ViewColors::*const mark :
         {&ViewColors::net, &ViewColors::handle, &ViewColors::selected, &ViewColors::rapid}) {
        choose(mark);
    }
    for (const auto& [which, mark] : {std::pair(LayerColor::toolpath, &ViewColors::path),
                                      {LayerColor::axis_x, &ViewColors::axis_x},
                                      {LayerColor::axis_y, &ViewColors::axis_y},
                                      {LayerColor::axis_z, &ViewColors::axis_z}}) {
        if (!chosen.of(which)) {
            choose(mark);
        }
    }
}

} // namespace

std::span<const LayerColorInfo> layer_color_infos() {
    static constexpr std::array<LayerColorInfo, layer_color_count> infos{
        {{LayerColor::background, "background", "Background"},
         {LayerColor::surface, "surface", "Surface"},
         {LayerColor::surface_u, "surface_u", "Surface lines along u"},
         {LayerColor::surface_v, "surface_v", "Surface lines along v"},
         {LayerColor::produced, "produced", "Produced surface"},
         {LayerColor::produced_u, "produced_u", "Produced lines along u"},
         {LayerColor::produced_v, "produced_v", "Produced lines along v"},
         {LayerColor::grid_u, "grid_u", "Grid lines along u"},
         {LayerColor::grid_v, "grid_v", "Grid lines along v"},
         {LayerColor::toolpath, "toolpath", "Toolpath"},
         {LayerColor::axis_names, "axis_names", "Axis names"},
         {LayerColor::axis_x, "axis_x", "X axis"},
         {LayerColor::axis_y, "axis_y", "Y axis"},
         {LayerColor::axis_z, "axis_z", "Z axis"}}};
    return infos;
}

std::optional<glm::vec3> color_from(std::string_view text) {
    constexpr std::size_t digits = 6;
    unsigned value = 0;
    if (text.size() != digits + 1 || text.front() != '#') {
        return std::nullopt;
    }
    const auto [end, fault] = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
    if (fault != std::errc{} || end != text.data() + text.size()) {
        return std::nullopt;
    }
    return rgb(static_cast<int>(value >> 16U),
               static_cast<int>((value >> 8U) & 0xFFU),
               static_cast<int>(value & 0xFFU));
}

std::string color_text(const glm::vec3& color) {
    constexpr std::string_view hex = "0123456789abcdef";
    std::string text = "#";
    for (const float channel : {color.r, color.g, color.b}) {
        const auto byte = static_cast<unsigned>(std::lround(std::clamp(channel, 0.0F, 1.0F) * 255.0F));
        text += hex[byte >> 4U];
        text += hex[byte & 0xFU];
    }
    return text;
}

std::optional<glm::vec3> color_of(const ViewColors& colors, LayerColor which) {
    if (const auto& chosen = colors.chosen.of(which)) {
        return chosen;
    }
    switch (which) {
    case LayerColor::background:
        return colors.background_top;
    case LayerColor::surface:
        return colors.surface;
    case LayerColor::produced:
        return glm::mix(colors.surface, colors.warning, 0.55F);
    case LayerColor::toolpath:
        return colors.path;
    case LayerColor::axis_x:
        return colors.axis_x;
    case LayerColor::axis_y:
        return colors.axis_y;
    case LayerColor::axis_z:
        return colors.axis_z;
    case LayerColor::axis_names:
        return std::nullopt;
    case LayerColor::surface_u:
    case LayerColor::surface_v:
    case LayerColor::produced_u:
    case LayerColor::produced_v:
    case LayerColor::grid_u:
    case LayerColor::grid_v:
        break;
    }
    return colors.wire;
}

ViewColors view_colors(Theme theme) {
    return theme == Theme::dark ? dark() : light();
}

ViewColors view_colors(Theme theme, const LayerColors& chosen) {
    ViewColors colors = view_colors(theme);
    const auto take = [&](LayerColor which, glm::vec3& to) { to = chosen.of(which).value_or(to); };
    take(LayerColor::background, colors.background_top);
    take(LayerColor::background, colors.background_bottom);
    take(LayerColor::surface, colors.surface);
    take(LayerColor::toolpath, colors.path);
    take(LayerColor::axis_x, colors.axis_x);
    take(LayerColor::axis_y, colors.axis_y);
    take(LayerColor::axis_z, colors.axis_z);
    if (const auto& background = chosen.of(LayerColor::background)) {
        keep_off(colors, *background, view_colors(theme == Theme::dark ? Theme::light : Theme::dark), chosen);
    }
    colors.chosen = chosen;
    return colors;
}

namespace {

/// On the part of the background where it is seen worst.
double least_contrast(const ViewColors& colors, const glm::vec3& ink) {
    return std::min(contrast(ink, colors.background_top), contrast(ink, colors.background_bottom));
}

bool takes_strong_end(const ViewColors& colors) {
    return least_contrast(colors, colors.neutral.back()) >= least_contrast(colors, colors.neutral.front());
}

} // namespace

glm::vec3 ink(const ViewColors& colors) {
    return takes_strong_end(colors) ? colors.neutral.back() : colors.neutral.front();
}

glm::vec3 faint_ink(const ViewColors& colors) {
    return takes_strong_end(colors) ? colors.neutral[6] : colors.neutral[1];
}

} // namespace millwright::render
