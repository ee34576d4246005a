// The designed surface, smooth and shaded, with its border and lines of constant u and v.

#include "core/geometry/mesh.h"
#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace millwright::viewport {

namespace {

constexpr std::size_t outline_stride =
    7;                             // of the mesh's inner points: the view need not be fitted to all of them
constexpr int outline_steps = 200; // of an outline along a whole side of the patch
constexpr double lift = 0.004;     // of the content's radius: outlines over the surface that they lie on
constexpr int iso_lines = 10;      // intervals between lines of constant u and v

/// Cells of the mesh along a direction of that degree: a multiple of the intervals between lines, so that the
/// lines lie on edges of the mesh.
int cells(int degree) {
    return std::clamp(2 * iso_lines * degree, 4 * iso_lines, 12 * iso_lines);
}

/// A part of the surface with its cells along u and v.
struct DrawnPart {
    const geometry::ParametricSurface& surface;
    int cells_u, cells_v;
};

std::vector<DrawnPart> parts_of(const geometry::Surface& surface) {
    std::vector<DrawnPart> parts;
    for (const geometry::BezierPatch& patch : surface.patches()) {
        parts.push_back({patch, cells(patch.degree_u()), cells(patch.degree_v())});
    }
    for (const geometry::BsplineSurface& face : surface.faces()) {
        const auto [u, v] = face.spans();
        parts.push_back({face, cells(u * face.net().degree_u), cells(v * face.net().degree_v)});
    }
    return parts;
}

render::MeshVertex vertex(const geometry::Mesh& mesh, std::size_t k, bool flipped) {
    return {.position = render::to_float(mesh.positions[k]),
            .normal = (flipped ? -1.0F : 1.0F) * render::to_float(mesh.normals[k])};
}

bool on_border(const Vec2& uv) {
    return (uv.array() <= 0.0 || uv.array() >= 1.0).any();
}

/// What belongs to the design, and what its trimmed patches have besides.
struct Triangles {
    std::vector<std::uint32_t> inside, outside;
};

class SurfaceLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        const bool flipped = scene.cutting_setup && scene.cutting_setup->flipped;
        if (scene.surface == surface_ && scene.trims == trims_ && flipped == flipped_) {
            return;
        }
        surface_ = scene.surface;
        trims_ = scene.trims;
        flipped_ = flipped;
        rebuild();
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.layers.design.surface || shows_stock(scene)) {
            return;
        }
        const render::ViewColors& colors = canvas.colors;
        render::MeshStyle style = {.coloring = {.color = with_opacity(colors.surface, 1.0F)},
                                   .model = canvas.s_T_w,
                                   .back_color = colors.surface_back};
        if (scene.layers.design
                .produced) { // which lies now before it, now behind it, by little: it is drawn whole
            style.coloring.opacity = 0.3F;
            style.depth = render::Depth::ghost;
        }
        const SurfaceColors shown = surface_colors(scene);
        const bool measured_points =
            shown == SurfaceColors::deviation && scene.reference->fitted.triangles.empty();
        if (shown == SurfaceColors::plain || measured_points) {
            canvas.painter.mesh(mesh_, style, canvas.view);
        }
        if (outside_.index_count() > 0) {
            render::MeshStyle faint = style;
            faint.coloring.opacity = 0.12F;
            faint.depth = render::Depth::ghost;
            canvas.painter.mesh(outside_, faint, canvas.view);
        }
        render::LineStyle line = {
            .coloring = {.color = with_opacity(colors.wire, 0.8F)}, .model = canvas.s_T_w, .width_px = 1.6F};
        canvas.painter.lines(border_, line, canvas.view);
        if (loops_.segment_count() > 0) {
            line.coloring.color = with_opacity(colors.accent, 1.0F);
            line.width_px = 2.2F;
            draw_seamed(canvas, loops_, line, nearer(canvas, lift * radius(canvas.content)));
            line.coloring.color = with_opacity(colors.wire, 0.8F);
        }
        if (scene.layers.design.lines) {
            line.width_px = 1.0F;
            const bool under_mesh = surface_colors(scene) == SurfaceColors::deviation;
            const render::View view =
                under_mesh ? nearer(canvas, lift * radius(canvas.content)) : canvas.view;
            line.coloring.color = line_color(colors, render::LayerColor::surface_u);
            canvas.painter.lines(along_u_, line, view);
            line.coloring.color = line_color(colors, render::LayerColor::surface_v);
            canvas.painter.lines(along_v_, line, view);
        }
    }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        return scene.layers.design.surface ? moved(outline_, scene_from_workpiece(scene))
                                           : std::vector<glm::dvec3>{};
    }

private:
    static glm::vec4 line_color(const render::ViewColors& colors, render::LayerColor which) {
        const auto& chosen = colors.chosen.of(which);
        return chosen ? with_opacity(*chosen, 1.0F) : with_opacity(colors.wire, 0.35F);
    }

    void rebuild() {
        std::vector<render::MeshVertex> vertices;
        Triangles triangles;
        std::vector<render::LineVertex> border;
        std::vector<render::LineVertex> along_u, along_v;
        std::vector<render::LineVertex> loops;
        outline_.clear();
        const std::vector<DrawnPart> parts = surface_ ? parts_of(*surface_) : std::vector<DrawnPart>{};
        for (std::size_t n = 0; n < parts.size(); ++n) {
            const geometry::Trim trim = trims_ && n < trims_->size() ? (*trims_)[n] : geometry::Trim{};
            append_mesh(parts[n], trim, vertices, triangles);
            append_lines(parts[n], border, along_u, along_v);
            append_loops(parts[n].surface, trim, loops);
        }
        mesh_ = render::MeshBuffer(vertices, triangles.inside);
        outside_ = triangles.outside.empty() ? render::MeshBuffer()
                                             : render::MeshBuffer(vertices, triangles.outside);
        loops_ = render::LineBuffer(loops, render::LineTopology::segments);
        border_ = render::LineBuffer(border, render::LineTopology::segments);
        along_u_ = render::LineBuffer(along_u, render::LineTopology::segments);
        along_v_ = render::LineBuffer(along_v, render::LineTopology::segments);
    }

    void append_mesh(const DrawnPart& part,
                     const geometry::Trim& trim,
                     std::vector<render::MeshVertex>& vertices,
                     Triangles& triangles) {
        const auto [mesh, outside] = geometry::tessellate(part.surface, trim, part.cells_u, part.cells_v);
        const auto base = static_cast<std::uint32_t>(vertices.size());
        for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
            vertices.push_back(vertex(mesh, k, flipped_));
            if (k % outline_stride == 0 || on_border(mesh.parameters[k])) {
                outline_.push_back(mesh.positions[k]);
            }
        }
        append_triangles(mesh.triangles, base, triangles.inside);
        append_triangles(outside, base, triangles.outside);
    }

    void append_triangles(const std::vector<std::array<int, 3>>& triangles,
                          std::uint32_t base,
                          std::vector<std::uint32_t>& corners) const {
        for (const auto& [a, b, c] : triangles) {
            corners.push_back(base + static_cast<std::uint32_t>(a));
            corners.push_back(base + static_cast<std::uint32_t>(flipped_ ? c : b));
            corners.push_back(base + static_cast<std::uint32_t>(flipped_ ? b : c));
        }
    }

    static void append_loops(const geometry::ParametricSurface& patch,
                             const geometry::Trim& trim,
                             std::vector<render::LineVertex>& lines) {
        for (const geometry::Trim::Loop& loop : trim.loops) {
            for (std::size_t n = 0; n < loop.size(); ++n) {
                const Vec2& a = loop[n];
                const Vec2& b = loop[n + 1 == loop.size() ? 0 : n + 1];
                const int steps = 1 + static_cast<int>(outline_steps * (b - a).norm());
                append(lines, on_surface(patch, a, b, steps));
            }
        }
    }

    static void append_lines(const DrawnPart& part,
                             std::vector<render::LineVertex>& border,
                             std::vector<render::LineVertex>& along_u,
                             std::vector<render::LineVertex>& along_v) {
        for (int k = 0; k <= iso_lines; ++k) {
            const double at = static_cast<double>(k) / iso_lines;
            const bool on_edge = k == 0 || k == iso_lines;
            append(on_edge ? border : along_v, on_surface(part.surface, {at, 0.0}, {at, 1.0}, part.cells_v));
            append(on_edge ? border : along_u, on_surface(part.surface, {0.0, at}, {1.0, at}, part.cells_u));
        }
    }

    std::shared_ptr<const geometry::Surface> surface_;
    std::shared_ptr<const std::vector<geometry::Trim>> trims_;
    bool flipped_ = false;
    render::MeshBuffer mesh_, outside_;
    render::LineBuffer loops_;
    render::LineBuffer border_;
    render::LineBuffer along_u_, along_v_;
    std::vector<Vec3> outline_;
};

} // namespace

std::unique_ptr<Layer> make_surface_layer() {
    return std::make_unique<SurfaceLayer>();
}

} // namespace millwright::viewport
