// A plot or picture that is to be cut: what each pen cuts in its colour, travel in the air thinly, and the
// plate as it will look, lit or against the light; and the tool of a table that its points are played to.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/internal/path_buffers.h"
#include "ui/viewport/internal/tool_mark.h"
#include "ui/viewport/pen_colors.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace millwright::viewport {

namespace {

using plot::HeightField;

constexpr float air_opacity = 0.8F;
constexpr float rows_opacity = 0.25F; ///< of a relief's path over its picture, which it covers everywhere
constexpr float air_shade = 0.3F;     ///< of the plate below it: neither a pen nor the plate is so dark

std::array<glm::vec4, render::path_kinds> only_feeds(const glm::vec3& color, float opacity) {
    std::array<glm::vec4, render::path_kinds> colors{};
    colors[static_cast<std::size_t>(gcode::PathKind::feed)] = with_opacity(color, opacity);
    return colors;
}

glm::vec3 place(const HeightField& field, int row, int column) {
    return {static_cast<float>(column * field.pitch + field.corner.x()),
            static_cast<float>(field.y_of_row(row) + field.corner.y()),
            field.row(row)[static_cast<std::size_t>(column)]};
}

/// A vertex a square; coloured by the light that comes through.
render::MeshBuffer mesh_of(const HeightField& field, const plot::GrayImage& light) {
    std::vector<render::MeshVertex> vertices;
    for (int row = 0; row < field.rows; ++row) {
        for (int column = 0; column < field.columns; ++column) {
            const int left = std::max(column - 1, 0);
            const int right = std::min(column + 1, field.columns - 1);
            const int above = std::max(row - 1, 0);
            const int below = std::min(row + 1, field.rows - 1);
            const glm::vec3 along = place(field, row, right) - place(field, row, left);
            const glm::vec3 up = place(field, above, column) - place(field, below, column);
            const auto n = static_cast<std::size_t>(row) * static_cast<std::size_t>(field.columns) +
                           static_cast<std::size_t>(column);
            const float gray = n < light.pixels.size() ? static_cast<float>(light.pixels[n]) / 255.0F : 0.0F;
            vertices.push_back({.position = place(field, row, column),
                                .normal = glm::cross(along, up),
                                .color = glm::vec4(glm::vec3(gray), 1.0F)});
        }
    }
    std::vector<std::uint32_t> triangles;
    const auto at = [&](int row, int column) {
        return static_cast<std::uint32_t>(row * field.columns + column);
    };
    for (int row = 0; row + 1 < field.rows; ++row) {
        for (int column = 0; column + 1 < field.columns; ++column) {
            triangles.insert(triangles.end(),
                             {at(row, column), at(row + 1, column), at(row + 1, column + 1)});
            triangles.insert(triangles.end(),
                             {at(row, column), at(row + 1, column + 1), at(row, column + 1)});
        }
    }
    return {vertices, triangles};
}

/// Below the deepest cut, so that the path lies over it.
render::MeshBuffer mesh_of(const plan::ShownPicture& shown, double z) {
    const plot::Picture& picture = shown.picture;
    std::vector<render::MeshVertex> vertices;
    for (int row = 0; row < picture.height; ++row) {
        for (int column = 0; column < picture.width; ++column) {
            const Vec2 at = shown.corner + Vec2(column, picture.height - 1 - row).cwiseProduct(shown.cell);
            const auto gray = static_cast<float>(picture.at(row, column)) / static_cast<float>(plot::white);
            vertices.push_back(
                {.position = {static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<float>(z)},
                 .normal = {0.0F, 0.0F, 1.0F},
                 .color = glm::vec4(glm::vec3(gray), 1.0F)});
        }
    }
    std::vector<std::uint32_t> triangles;
    const auto at = [&](int row, int column) {
        return static_cast<std::uint32_t>(row * picture.width + column);
    };
    for (int row = 0; row + 1 < picture.height; ++row) {
        for (int column = 0; column + 1 < picture.width; ++column) {
            triangles.insert(triangles.end(),
                             {at(row, column), at(row + 1, column), at(row + 1, column + 1)});
            triangles.insert(triangles.end(),
                             {at(row, column), at(row + 1, column + 1), at(row, column + 1)});
        }
    }
    return {vertices, triangles};
}

class PlotLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        unfinished_ = false;
        if (!scene.plot) {
            cuts_.clear();
            air_.clear();
            look_.reset();
            shown_.reset();
            return;
        }
        tool_.prepare();
        cuts_.resize(scene.plot->cuts.size());
        for (std::size_t n = 0; n < cuts_.size(); ++n) {
            unfinished_ = !cuts_[n].follow(scene.plot->cuts[n].path.chunks) || unfinished_;
        }
        unfinished_ = !air_.follow(scene.plot->air.chunks) || unfinished_;
        if (scene.plot->look != look_) {
            look_ = scene.plot->look;
            mesh_ = look_ ? mesh_of(*look_, scene.plot->light) : render::MeshBuffer();
        }
        follow_picture(scene);
    }

    /// The picture is made a mesh when somebody wants to see it.
    void follow_picture(const Scene& scene) {
        const auto wanted = scene.picture_shown ? scene.plot->shown_picture : nullptr;
        const double z = wanted && scene.plot->path ? -plot::deepest(*scene.plot->path) - 0.1 : 0.0;
        if (wanted != shown_ || std::abs(z - picture_z_) > 0.0) {
            shown_ = wanted;
            picture_z_ = z;
            picture_ = shown_ ? mesh_of(*shown_, z) : render::MeshBuffer();
        }
    }

    [[nodiscard]] bool unfinished() const override { return unfinished_; }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        std::vector<glm::dvec3> corners;
        if (scene.plot) {
            for (const auto& cut : scene.plot->cuts) {
                if (!cut.path.empty()) {
                    const auto box = moved_corners(cut.path.bounds(), scene_from_workpiece(scene));
                    corners.insert(corners.end(), box.begin(), box.end());
                }
            }
        }
        return corners;
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.plot) {
            return;
        }
        const bool looks = scene.layers.design.surface && look_ && !shown_;
        if (shown_) {
            draw_picture(canvas);
        } else if (looks) {
            draw_look(scene, canvas);
        }
        const bool rows = covers_picture(scene); // would hide what they leave
        if (scene.layers.path.intended && !(rows && looks)) {
            draw_paths(scene, canvas);
        }
        if (scene.layers.machine.tool && scene.table_tip) {
            tool_.draw(canvas, *scene.table_tip, Vec3::UnitZ());
        }
    }

private:
    /// Rows of a relief, and dots.
    static bool covers_picture(const Scene& scene) {
        return scene.plot->picture && scene.plot->levels.empty() && !scene.plot->carved;
    }

    void draw_look(const Scene& scene, const Canvas& canvas) const {
        render::MeshStyle style;
        style.model = canvas.s_T_w;
        if (scene.against_light) {
            style.coloring.from = render::ColorFrom::vertex;
            style.lit = false;
        } else {
            style.coloring.color = with_opacity(canvas.colors.surface, 1.0F);
        }
        canvas.painter.mesh(mesh_, style, canvas.view);
    }

    void draw_picture(const Canvas& canvas) const {
        render::MeshStyle style;
        style.model = canvas.s_T_w;
        style.coloring.from = render::ColorFrom::vertex;
        style.lit = false;
        canvas.painter.mesh(picture_, style, canvas.view);
    }

    void draw_paths(const Scene& scene, const Canvas& canvas) const {
        const bool rough = canvas.edges == render::Edges::rough;
        const double share = 1.0 / static_cast<double>(cuts_.size() + 1);
        render::PathStyle style;
        style.model = canvas.s_T_w;
        const bool on_plate = scene.layers.design.surface && look_ && !shown_ && !scene.against_light;
        style.color =
            only_feeds(on_plate ? air_shade * canvas.colors.surface : canvas.colors.rapid, air_opacity);
        air_.draw(scene, canvas, style, rough, -1, share);
        for (std::size_t n = 0; n < cuts_.size() && n < scene.plot->cuts.size(); ++n) {
            const float opacity = shown_ && covers_picture(scene) ? rows_opacity : 1.0F;
            const plan::PlotResult::LevelPath& cut = scene.plot->cuts[n];
            const glm::vec3 color = cut.depth ? render::color_of(depth_colors(scene), *cut.depth)
                                              : pen_color(cut.pen, canvas.colors.theme);
            style.color = only_feeds(color, opacity);
            cuts_[n].draw(scene, canvas, style, rough, -1, share);
        }
    }

    std::vector<PathBuffers> cuts_;
    PathBuffers air_;
    std::shared_ptr<const HeightField> look_;
    render::MeshBuffer mesh_;
    std::shared_ptr<const plan::ShownPicture> shown_;
    double picture_z_ = 0.0;
    render::MeshBuffer picture_;
    ToolMark tool_;
    bool unfinished_ = false;
};

} // namespace

std::unique_ptr<Layer> make_plot_layer() {
    return std::make_unique<PlotLayer>();
}

} // namespace millwright::viewport
