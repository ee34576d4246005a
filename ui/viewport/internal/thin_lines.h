// Lines of one pixel in place of smooth ones, for a picture that moves: without a graphics card a smooth
// piece costs more than ten times as much.
#pragma once

#include "ui/render/path_drawer.h"
#include "ui/viewport/internal/layer.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace millwright::viewport {

class ThinLines {
public:
    /// Draws nothing.
    ThinLines() = default;
    /// Through `points`. The piece that ends at the n-th of them has the colour kind(n), below path_kinds.
    ThinLines(std::span<const Vec3> points, const std::function<int(std::size_t)>& kind);

    /// Colours by kind; those of opacity 0 are left out.
    void draw(const Canvas& canvas, const std::array<glm::vec4, render::path_kinds>& colors) const;

private:
    struct Part {
        render::PathBuffer buffer;
        std::vector<std::uint16_t> indices;
    };
    std::vector<Part> parts_; ///< as many points as a buffer takes
};

} // namespace millwright::viewport
