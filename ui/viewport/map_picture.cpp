#include "ui/viewport/map_picture.h"

#include "ui/render/color_map.h"
#include "ui/viewport/internal/desk.h"

namespace millwright::viewport {

widgets::ColourMap map_colours() {
    return [](double t) {
        const glm::vec3 c = render::sample(render::ColorMap::viridis, t);
        return ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, 1.0F});
    };
}

render::Picture map_picture(widgets::HeatMapView view, const render::PixelSize& size, render::Theme theme) {
    constexpr float margin = 20.0F; // px
    view.height = 0.0F;
    view.colours = map_colours();
    Desk desk(size, 1.0, theme);
    return desk.picture([&](widgets::Ui& ui) { (void)widgets::heat_map(ui, "map", view); }, margin);
}

} // namespace millwright::viewport
