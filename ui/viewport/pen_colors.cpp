#include "ui/viewport/pen_colors.h"

#include "core/plot/stroke_svg.h"

#include <array>

namespace millwright::viewport {

namespace {

struct Pen {
    std::string_view name;
    glm::vec3 on_dark;
    glm::vec3 on_light;
};

constexpr std::array<Pen, plot::pen_groups> pens{{{"red", {1.0F, 0.45F, 0.40F}, {0.78F, 0.12F, 0.12F}},
                                                  {"yellow", {0.96F, 0.85F, 0.35F}, {0.62F, 0.48F, 0.0F}},
                                                  {"green", {0.45F, 0.85F, 0.45F}, {0.08F, 0.52F, 0.18F}},
                                                  {"cyan", {0.40F, 0.85F, 0.92F}, {0.0F, 0.50F, 0.58F}},
                                                  {"blue", {0.50F, 0.62F, 1.0F}, {0.15F, 0.28F, 0.82F}},
                                                  {"magenta", {0.92F, 0.52F, 0.92F}, {0.62F, 0.12F, 0.62F}}}};

const Pen& pen_of(int pen) {
    return pens[static_cast<std::size_t>(plot::pen_group(pen))];
}

} // namespace

glm::vec3 pen_color(int pen, render::Theme theme) {
    const Pen& found = pen_of(pen);
    return theme == render::Theme::dark ? found.on_dark : found.on_light;
}

std::string_view pen_name(int pen) {
    return pen_of(pen).name;
}

} // namespace millwright::viewport
