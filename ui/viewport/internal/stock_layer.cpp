// What a simulation has left of the stock, coloured by comparison with the part.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/stock_sight.h"

#include <cstdint>

namespace millwright::viewport {

namespace {

constexpr std::size_t most_stock_outline = 2'000; // points that the view is fitted to

/// Normals are the mean of those of the triangles around, by area.
std::vector<Vec3> normals_of(const simulation::CutMesh& mesh) {
    std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
    const auto point = [&](int k) { return mesh.points[static_cast<std::size_t>(k)]; };
    for (const auto& triangle : mesh.triangles) {
        const Vec3 a = point(triangle[0]);
        const Vec3 doubled = (point(triangle[1]) - a).cross(point(triangle[2]) - a);
        for (const int corner : triangle) {
            normals[static_cast<std::size_t>(corner)] += doubled;
        }
    }
    for (Vec3& normal : normals) {
        const double length = normal.norm();
        normal = length > 0.0 ? Vec3(normal / length) : Vec3(Vec3::UnitZ());
    }
    return normals;
}

render::MeshBuffer stock_buffer(const plan::StockPicture& picture, double tolerance) {
    const std::vector<Vec3> normals = normals_of(picture.mesh);
    std::vector<render::MeshVertex> vertices;
    vertices.reserve(normals.size());
    for (std::size_t n = 0; n < normals.size(); ++n) {
        const auto& height = picture.heights[n];
        const bool is_cut = picture.mesh.moves[n] != simulation::stock_surface;
        const bool is_compared = height && (is_cut || *height <= tolerance);
        const glm::vec3 color = is_compared ? stock_color(*height, tolerance) : stock_color(is_cut);
        vertices.push_back({.position = render::to_float(picture.mesh.points[n]),
                            .normal = render::to_float(normals[n]),
                            .color = with_opacity(color, 1.0F)});
    }
    std::vector<std::uint32_t> corners;
    corners.reserve(3 * picture.mesh.triangles.size());
    for (const auto& triangle : picture.mesh.triangles) {
        for (const int corner : triangle) {
            corners.push_back(static_cast<std::uint32_t>(corner));
        }
    }
    return {vertices, corners};
}

class StockLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (!shows_stock(scene)) {
            return;
        }
        const bool same_tolerance =
            !(scene.stock_tolerance < tolerance_ || scene.stock_tolerance > tolerance_);
        if (scene.stock == picture_ && same_tolerance) {
            return;
        }
        picture_ = scene.stock;
        tolerance_ = scene.stock_tolerance;
        mesh_ = stock_buffer(*picture_, tolerance_);
        outline_.clear();
        const std::size_t stride = picture_->mesh.points.size() / most_stock_outline + 1;
        for (std::size_t n = 0; n < picture_->mesh.points.size(); n += stride) {
            outline_.push_back(picture_->mesh.points[n]);
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (shows_stock(scene)) {
            canvas.painter.mesh(mesh_,
                                {.coloring = {.from = render::ColorFrom::vertex},
                                 .model = canvas.s_T_w,
                                 .back_color = {},
                                 .highlight = 0.06F,
                                 .closed = true},
                                canvas.view);
        }
    }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        return shows_stock(scene) ? moved(outline_, scene_from_workpiece(scene)) : std::vector<glm::dvec3>{};
    }

private:
    std::shared_ptr<const plan::StockPicture> picture_;
    double tolerance_ = 0.0;
    render::MeshBuffer mesh_;
    std::vector<Vec3> outline_;
};

} // namespace

std::unique_ptr<Layer> make_stock_layer() {
    return std::make_unique<StockLayer>();
}

} // namespace millwright::viewport
