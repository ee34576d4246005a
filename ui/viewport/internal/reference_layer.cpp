// Triangles or measured points of a file beside the design, and how far those that were fitted are from it.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"

namespace millwright::viewport {

namespace {

using exchange::TriangleMesh;

constexpr double above_surface = 0.004;     // of the radius of what is shown: points lie on the surface
constexpr std::size_t most_outline = 2'000; // points that the view is fitted to

/// Normals are the mean of those of the triangles around, by area. `values` may be empty.
render::MeshBuffer reference_buffer(const TriangleMesh& mesh, const std::vector<double>& values) {
    std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
    std::vector<std::uint32_t> corners;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const Vec3 normal = mesh.doubled_area(n);
        for (const int corner : mesh.triangles[n]) {
            normals[static_cast<std::size_t>(corner)] += normal;
            corners.push_back(static_cast<std::uint32_t>(corner));
        }
    }
    std::vector<render::MeshVertex> vertices;
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
        const double length = normals[n].norm();
        const Vec3 normal = length > 0.0 ? Vec3(normals[n] / length) : Vec3(Vec3::UnitZ());
        vertices.push_back({.position = render::to_float(mesh.points[n]),
                            .normal = render::to_float(normal),
                            .value = values.empty() ? 0.0F : static_cast<float>(values[n])});
    }
    return {vertices, corners};
}

/// Of what has no triangles.
render::PointBuffer measured_points(const TriangleMesh& mesh, const std::vector<double>& values) {
    std::vector<render::PointVertex> points;
    if (mesh.triangles.empty()) {
        for (std::size_t n = 0; n < mesh.points.size(); ++n) {
            points.push_back({.position = render::to_float(mesh.points[n]),
                              .value = values.empty() ? 0.0F : static_cast<float>(values[n])});
        }
    }
    return render::PointBuffer(points);
}

void add_outline(std::vector<Vec3>& outline, const TriangleMesh& mesh) {
    const std::size_t stride = mesh.points.size() / most_outline + 1;
    for (std::size_t n = 0; n < mesh.points.size(); n += stride) {
        outline.push_back(mesh.points[n]);
    }
}

class ReferenceLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (scene.reference == reference_) {
            return;
        }
        reference_ = scene.reference;
        outline_.clear();
        fitted_ = {};
        rest_ = {};
        fitted_points_ = {};
        rest_points_ = {};
        if (reference_) {
            fitted_ = reference_buffer(reference_->fitted, reference_->deviation);
            rest_ = reference_buffer(reference_->rest, {});
            fitted_points_ = measured_points(reference_->fitted, reference_->deviation);
            rest_points_ = measured_points(reference_->rest, {});
            add_outline(outline_, reference_->fitted);
            add_outline(outline_, reference_->rest);
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!reference_) {
            return;
        }
        const render::MeshStyle plain = {.coloring = {.color = with_opacity(canvas.colors.neutral[5], 1.0F)},
                                         .model = canvas.s_T_w,
                                         .back_color = canvas.colors.neutral[3]};
        if (scene.layers.design.reference) {
            canvas.painter.mesh(rest_, plain, canvas.view);
            draw_points(rest_points_, plain.coloring, canvas);
        }
        if (surface_colors(scene) == SurfaceColors::deviation) {
            const render::Coloring by_deviation{.from = render::ColorFrom::value,
                                                .scale = deviation_colors(scene)};
            canvas.painter.mesh(
                fitted_,
                {.coloring = by_deviation, .model = canvas.s_T_w, .back_color = {}, .highlight = 0.05F},
                canvas.view);
            draw_points(fitted_points_, by_deviation, canvas);
        } else if (scene.layers.design.reference) {
            canvas.painter.mesh(fitted_, plain, canvas.view);
            draw_points(fitted_points_, plain.coloring, canvas);
        }
    }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        return scene.layers.design.reference || scene.layers.colored.deviation
                   ? moved(outline_, scene_from_workpiece(scene))
                   : std::vector<glm::dvec3>{};
    }

private:
    static void
    draw_points(const render::PointBuffer& points, const render::Coloring& coloring, const Canvas& canvas) {
        if (points.count() > 0) {
            canvas.painter.points(points,
                                  {.coloring = coloring,
                                   .model = canvas.s_T_w,
                                   .size_px = 6.0F,
                                   .ring_px = 1.0F,
                                   .ring_color = with_opacity(canvas.colors.neutral[1], 1.0F)},
                                  nearer(canvas, above_surface * radius(canvas.content)));
        }
    }

    std::shared_ptr<const plan::ReferenceMesh> reference_;
    render::MeshBuffer fitted_, rest_;
    render::PointBuffer fitted_points_, rest_points_; ///< measured points
    std::vector<Vec3> outline_;
};

} // namespace

std::unique_ptr<Layer> make_reference_layer() {
    return std::make_unique<ReferenceLayer>();
}

} // namespace millwright::viewport
