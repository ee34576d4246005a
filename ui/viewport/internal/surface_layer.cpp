// The designed surface, smooth and shaded, with its border and lines of constant u and v.

#include "core/geometry/mesh.h"
#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"

#include <algorithm>

namespace millwright::viewport {

namespace {

constexpr std::size_t outline_stride = 7; // of the mesh's points: the view need not be fitted to all of them
constexpr int iso_lines = 10;             // intervals between lines of constant u and v

/// Cells of the mesh along a direction of that degree: a multiple of the intervals between lines, so that the
/// lines lie on edges of the mesh.
int cells(int degree) {
    return std::clamp(2 * iso_lines * degree, 4 * iso_lines, 12 * iso_lines);
}

render::MeshVertex vertex(const geometry::Mesh& mesh, std::size_t k, bool flipped) {
    return {.position = render::to_float(mesh.positions[k]),
            .normal = (flipped ? -1.0F : 1.0F) * render::to_float(mesh.normals[k])};
}

class SurfaceLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        const bool flipped = scene.workpiece && scene.workpiece->flipped;
        if (scene.surface == surface_ && flipped == flipped_) {
            return;
        }
        surface_ = scene.surface;
        flipped_ = flipped;
        rebuild();
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.layers.surface) {
            return;
        }
        const render::ViewColors& colors = canvas.colors;
        const render::MeshStyle style = {.coloring = {.color = with_opacity(colors.surface, 1.0F)},
                                         .model = canvas.s_T_w,
                                         .back_color = colors.surface_back};
        if (surface_colors(scene) == SurfaceColors::plain) {
            canvas.painter.mesh(mesh_, style, canvas.view);
        }
        render::LineStyle line = {
            .coloring = {.color = with_opacity(colors.wire, 0.8F)}, .model = canvas.s_T_w, .width_px = 1.6F};
        canvas.painter.lines(border_, line, canvas.view);
        if (scene.layers.surface_lines) {
            line.coloring.color = with_opacity(colors.wire, 0.35F);
            line.width_px = 1.0F;
            canvas.painter.lines(iso_, line, canvas.view);
        }
    }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        return scene.layers.surface ? moved(outline_, scene_from_workpiece(scene))
                                    : std::vector<glm::dvec3>{};
    }

private:
    void rebuild() {
        std::vector<render::MeshVertex> vertices;
        std::vector<std::uint32_t> triangles;
        std::vector<render::LineVertex> border;
        std::vector<render::LineVertex> iso;
        outline_.clear();
        if (surface_) {
            for (const geometry::BezierPatch& patch : surface_->patches()) {
                append_mesh(patch, vertices, triangles);
                append_lines(patch, border, iso);
            }
        }
        mesh_ = render::MeshBuffer(vertices, triangles);
        border_ = render::LineBuffer(border, render::LineTopology::segments);
        iso_ = render::LineBuffer(iso, render::LineTopology::segments);
    }

    void append_mesh(const geometry::BezierPatch& patch,
                     std::vector<render::MeshVertex>& vertices,
                     std::vector<std::uint32_t>& triangles) {
        const geometry::Mesh mesh =
            geometry::tessellate(patch, cells(patch.degree_u()), cells(patch.degree_v()));
        const auto base = static_cast<std::uint32_t>(vertices.size());
        for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
            vertices.push_back(vertex(mesh, k, flipped_));
            if (k % outline_stride == 0) {
                outline_.push_back(mesh.positions[k]);
            }
        }
        for (const auto& [a, b, c] : mesh.triangles) {
            triangles.push_back(base + static_cast<std::uint32_t>(a));
            triangles.push_back(base + static_cast<std::uint32_t>(flipped_ ? c : b));
            triangles.push_back(base + static_cast<std::uint32_t>(flipped_ ? b : c));
        }
    }

    static void append_lines(const geometry::BezierPatch& patch,
                             std::vector<render::LineVertex>& border,
                             std::vector<render::LineVertex>& iso) {
        for (int k = 0; k <= iso_lines; ++k) {
            const double at = static_cast<double>(k) / iso_lines;
            auto& target = k == 0 || k == iso_lines ? border : iso;
            append(target, on_surface(patch, {at, 0.0}, {at, 1.0}, cells(patch.degree_v())));
            append(target, on_surface(patch, {0.0, at}, {1.0, at}, cells(patch.degree_u())));
        }
    }

    std::shared_ptr<const geometry::Surface> surface_;
    bool flipped_ = false;
    render::MeshBuffer mesh_;
    render::LineBuffer border_;
    render::LineBuffer iso_;
    std::vector<Vec3> outline_;
};

} // namespace

std::unique_ptr<Layer> make_surface_layer() {
    return std::make_unique<SurfaceLayer>();
}

} // namespace millwright::viewport
