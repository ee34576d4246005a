// A ground grid below everything, fading out around it. Its lines lie at round numbers.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace millwright::viewport {

namespace {

// The grid has its own unit: the distance of its lines. Each tenth line is a major one.
constexpr int lines_per_side = 30;   // of the middle
constexpr double full_to = 0.2;      // of the reach: full strength up to here, nothing at the border
constexpr double lines_across = 6.0; // of the content's radius
constexpr double gap_share = 0.02;   // of the content's radius: how far below the content

float strength(const Vec3& at) {
    const double distance = at.norm() / lines_per_side;
    const double faded = glm::clamp((1.0 - distance) / (1.0 - full_to), 0.0, 1.0);
    return static_cast<float>(faded * faded);
}

void append_line(std::vector<render::LineVertex>& lines, int at, bool along_x) {
    constexpr int step = 3;
    for (int from = -lines_per_side; from < lines_per_side; from += step) {
        const Vec3 a = along_x ? Vec3(from, at, 0.0) : Vec3(at, from, 0.0);
        const Vec3 b = along_x ? Vec3(from + step, at, 0.0) : Vec3(at, from + step, 0.0);
        if (strength(a) > 0.0F || strength(b) > 0.0F) {
            lines.push_back({.position = render::to_float(a), .color = {1.0F, 1.0F, 1.0F, strength(a)}});
            lines.push_back({.position = render::to_float(b), .color = {1.0F, 1.0F, 1.0F, strength(b)}});
        }
    }
}

render::LineBuffer grid_lines(bool major, const glm::vec3& color) {
    std::vector<render::LineVertex> lines;
    for (int at = -lines_per_side; at <= lines_per_side; ++at) {
        if ((at % 10 == 0) == major) {
            append_line(lines, at, true);
            append_line(lines, at, false);
        }
    }
    for (render::LineVertex& vertex : lines) {
        vertex.color = {color, vertex.color.a};
    }
    return {lines, render::LineTopology::segments};
}

/// Places the grid below the content, its middle at a multiple of ten lines.
glm::mat4 floor_placement(const render::Bounds& content) {
    const double size = radius(content);
    const double step = round_length(size / lines_across);
    const glm::dvec3 middle = center(content);
    const double ten = 10.0 * step;
    const glm::dvec3 origin = {
        ten * std::round(middle.x / ten), ten * std::round(middle.y / ten), content.min.z - gap_share * size};
    return glm::scale(glm::translate(glm::mat4(1.0F), glm::vec3(origin)),
                      glm::vec3(static_cast<float>(step)));
}

struct FloorLines {
    render::LineBuffer fine;
    render::LineBuffer major;
};

FloorLines floor_lines(render::Theme theme) {
    const render::ViewColors colors = render::view_colors(theme);
    return {.fine = grid_lines(false, colors.floor_line), .major = grid_lines(true, colors.floor_line_major)};
}

class FloorLayer final : public Layer {
public:
    void update(const Scene&) override {
        if (!dark_) {
            dark_ = floor_lines(render::Theme::dark);
            light_ = floor_lines(render::Theme::light);
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.layers.floor || !dark_ || !(radius(canvas.content) > 0.0)) {
            return;
        }
        const FloorLines& lines = canvas.colors.theme == render::Theme::dark ? *dark_ : light_;
        const render::LineStyle style = {.coloring = {.from = render::ColorFrom::vertex},
                                         .model = floor_placement(canvas.content),
                                         .width_px = 1.0F,
                                         .depth = render::Depth::ghost};
        canvas.painter.lines(lines.fine, style, canvas.view);
        canvas.painter.lines(lines.major, style, canvas.view);
    }

private:
    std::optional<FloorLines> dark_; ///< made with the first scene
    FloorLines light_;
};

} // namespace

std::unique_ptr<Layer> make_floor_layer() {
    return std::make_unique<FloorLayer>();
}

} // namespace millwright::viewport
