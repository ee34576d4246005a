// Triangles of another program's file beside the design, and how far those that were fitted are from it.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"

namespace millwright::viewport {

namespace {

using exchange::TriangleMesh;

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
        if (reference_) {
            fitted_ = reference_buffer(reference_->fitted, reference_->deviation);
            rest_ = reference_buffer(reference_->rest, {});
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
        if (scene.layers.reference) {
            canvas.painter.mesh(rest_, plain, canvas.view);
        }
        if (surface_colors(scene) == SurfaceColors::deviation) {
            canvas.painter.mesh(
                fitted_,
                {.coloring = {.from = render::ColorFrom::value, .scale = deviation_colors(scene)},
                 .model = canvas.s_T_w,
                 .back_color = {},
                 .highlight = 0.05F},
                canvas.view);
        } else if (scene.layers.reference) {
            canvas.painter.mesh(fitted_, plain, canvas.view);
        }
    }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        return scene.layers.reference || scene.layers.deviation ? moved(outline_, scene_from_workpiece(scene))
                                                                : std::vector<glm::dvec3>{};
    }

private:
    std::shared_ptr<const project::ReferenceMesh> reference_;
    render::MeshBuffer fitted_, rest_;
    std::vector<Vec3> outline_;
};

} // namespace

std::unique_ptr<Layer> make_reference_layer() {
    return std::make_unique<ReferenceLayer>();
}

} // namespace millwright::viewport
