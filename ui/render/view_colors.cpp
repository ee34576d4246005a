#include "ui/render/view_colors.h"

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

} // namespace

ViewColors view_colors(Theme theme) {
    return theme == Theme::dark ? dark() : light();
}

} // namespace millwright::render
