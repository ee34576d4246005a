// The layout of a picture for files: a line of words, 3D pictures side by side, the table of figures below.
#pragma once

#include "ui/render/camera.h"
#include "ui/viewport/picture_facts.h"
#include "ui/widgets/ui.h"

#include <string_view>
#include <vector>

namespace millwright::viewport {

struct Sheet {
    /// One 3D picture: where it is, and the part of it that nothing is written over.
    struct Part {
        widgets::Rect place;
        widgets::Rect free;
    };
    double scale = 1.0;      ///< of words and lines, for large pictures
    double line_scale = 1.0; ///< of lines and points in the 3D pictures
    bool details = true;     ///< false: too small for words
    std::vector<Part> parts;
    widgets::Rect signs; ///< scale bar, legend and axes lie along its border
    widgets::Rect title;
    widgets::Rect table;
};

[[nodiscard]] Sheet
sheet_for(const render::PixelSize& size, int parts, const PictureFacts& facts, bool has_legend);

[[nodiscard]] render::PixelSize pixel_size(const widgets::Rect& rect);

/// A camera's picture of `free` carried on to all of `place`.
[[nodiscard]] render::View framed(const render::Camera& camera,
                                  const widgets::Rect& place,
                                  const widgets::Rect& free,
                                  const render::Bounds& scene,
                                  double scale);

/// Title and table.
void draw_sheet(widgets::Ui& ui, const Sheet& sheet, const PictureFacts& facts);

/// The name of the k-th 3D picture; an empty one is none.
void draw_part_caption(widgets::Ui& ui, const Sheet& sheet, std::size_t k, std::string_view caption);

} // namespace millwright::viewport
