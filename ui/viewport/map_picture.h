// A quantity over two others as a picture for a file.
#pragma once

#include "ui/render/picture.h"
#include "ui/render/pixel_size.h"
#include "ui/render/view_colors.h"
#include "ui/widgets/heat_map.h"

namespace millwright::viewport {

/// viridis, as the error maps; the least value is dark.
[[nodiscard]] widgets::ColourMap map_colours();

/// `view` without its height and colours, which are those of the picture. Throws Error where nothing can be
/// drawn.
[[nodiscard]] render::Picture
map_picture(widgets::HeatMapView view, const render::PixelSize& size, render::Theme theme);

} // namespace millwright::viewport
