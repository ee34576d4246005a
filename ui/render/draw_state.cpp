#include "ui/render/internal/draw_state.h"

#include "ui/render/internal/gl.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace millwright::render {

namespace {

constexpr std::array<ColorMap, 2> rows = {ColorMap::viridis, ColorMap::cividis};
constexpr int map_entries = 256;

std::byte to_byte(float channel) {
    return static_cast<std::byte>(std::lround(channel * 255.0F));
}

} // namespace

Texture color_map_texture() {
    std::vector<std::byte> rgba;
    for (const ColorMap map : rows) {
        for (int i = 0; i < map_entries; ++i) {
            const glm::vec3 color = sample(map, i / (map_entries - 1.0));
            rgba.insert(rgba.end(), {to_byte(color.r), to_byte(color.g), to_byte(color.b), std::byte{255}});
        }
    }
    return Texture({map_entries, static_cast<int>(rows.size())}, rgba, Filter::linear);
}

void set_coloring(const ShaderProgram& program, const Coloring& coloring, const Texture& maps) {
    const ColorScale& scale = coloring.scale;
    const double span = scale.high - scale.low;
    program.set("color_from", static_cast<int>(coloring.from));
    program.set("style_color", coloring.color);
    program.set("opacity", coloring.opacity);
    program.set("map_row", static_cast<int>(scale.map));
    program.set("map_count", static_cast<int>(rows.size()));
    program.set("low", static_cast<float>(scale.low));
    program.set("per_unit", span > 0.0 ? static_cast<float>(1.0 / span) : 0.0F);
    program.set("limit", scale.limit ? static_cast<float>(*scale.limit) : std::numeric_limits<float>::max());
    program.set("over_limit", scale.over_limit);
    program.set("maps", 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, maps.id());
}

void set_view(const ShaderProgram& program, const View& view, const glm::mat4& model) {
    program.set("eye_from_buffer", glm::mat4(view.view * glm::dmat4(model)));
    program.set("clip_from_eye", glm::mat4(view.projection));
    program.set("picture_px", glm::vec2(view.size.width, view.size.height));
}

void set_depth(Depth depth, bool writes) {
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    // The picture itself stays opaque, whatever is drawn into it.
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDisable(GL_CULL_FACE);
    glDepthFunc(GL_LEQUAL);
    if (depth == Depth::overlay) {
        glDisable(GL_DEPTH_TEST);
    } else {
        glEnable(GL_DEPTH_TEST);
    }
    glDepthMask(writes && depth == Depth::tested ? GL_TRUE : GL_FALSE);
}

void draw_smooth(const ShaderProgram& program, Depth depth, const std::function<void()>& draw) {
    enum Pass { everything, solid_inside, soft_edge };
    if (depth != Depth::tested) {
        set_depth(depth);
        program.set("pass", everything);
        draw();
        return;
    }
    set_depth(depth);
    program.set("pass", solid_inside);
    draw();
    set_depth(depth, false);
    program.set("pass", soft_edge);
    draw();
}

} // namespace millwright::render
