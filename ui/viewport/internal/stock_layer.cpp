// What a simulation has left of the stock, coloured by comparison with the part.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/stock_section.h"
#include "ui/viewport/stock_sight.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace millwright::viewport {

namespace {

constexpr std::size_t most_stock_outline = 2'000; // points that the view is fitted to
constexpr double least_strip = 0.02;              // mm, of a section

struct Triangles {
    std::vector<render::MeshVertex> vertices;
    std::vector<std::uint32_t> corners;

    void add(const auto& triangle) {
        for (const auto& corner : triangle) {
            corners.push_back(static_cast<std::uint32_t>(corner));
        }
    }
};

Triangles whole(const plan::StockPicture& picture, double tolerance) {
    const std::vector<Vec3> normals = simulation::normals_of(picture.mesh);
    Triangles all;
    all.vertices.reserve(normals.size());
    for (std::size_t n = 0; n < normals.size(); ++n) {
        all.vertices.push_back({.position = render::to_float(picture.mesh.points[n]),
                                .normal = render::to_float(normals[n]),
                                .color = with_opacity(stock_color(picture, n, tolerance), 1.0F)});
    }
    for (const auto& triangle : picture.mesh.triangles) {
        all.add(triangle);
    }
    return all;
}

/// What stays of `all`, closed by the material in the plane.
Triangles sectioned(const Triangles& all, const plan::StockPicture& picture, const StockSection& section) {
    const double strip = std::max(picture.result ? picture.result->cell.maxCoeff() : 0.0, least_strip);
    const SectionedMesh made = section_of(picture.mesh, section, strip);
    Triangles kept;
    for (const SectionedMesh::Corner& corner : made.corners) {
        const render::MeshVertex& from = all.vertices[static_cast<std::size_t>(corner.from)];
        const render::MeshVertex& to = all.vertices[static_cast<std::size_t>(corner.to)];
        const auto share = static_cast<float>(corner.share);
        kept.vertices.push_back({.position = glm::mix(from.position, to.position, share),
                                 .normal = glm::mix(from.normal, to.normal, share),
                                 .color = glm::mix(from.color, to.color, share)});
    }
    for (const auto& triangle : made.triangles) {
        kept.add(triangle);
    }
    Vec3 normal = Vec3::Zero();
    normal[section.axis] = section.keeps_above ? -1.0 : 1.0;
    for (const auto& triangle : made.cap) {
        for (const Vec3& place : triangle) {
            kept.corners.push_back(static_cast<std::uint32_t>(kept.vertices.size()));
            kept.vertices.push_back({.position = render::to_float(place),
                                     .normal = render::to_float(normal),
                                     .color = with_opacity(section_color(), 1.0F)});
        }
    }
    return kept;
}

render::MeshBuffer stock_buffer(const plan::StockPicture& picture,
                                double tolerance,
                                const std::optional<StockSection>& section) {
    const Triangles all = whole(picture, tolerance);
    const Triangles drawn = section ? sectioned(all, picture, *section) : all;
    return {drawn.vertices, drawn.corners};
}

class StockLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (!shows_stock(scene)) {
            return;
        }
        const bool same_tolerance =
            !(scene.stock_tolerance < tolerance_ || scene.stock_tolerance > tolerance_);
        if (scene.stock == picture_ && same_tolerance && scene.stock_section == section_) {
            return;
        }
        picture_ = scene.stock;
        tolerance_ = scene.stock_tolerance;
        section_ = scene.stock_section;
        mesh_ = stock_buffer(*picture_, tolerance_, section_);
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
    std::optional<StockSection> section_;
    render::MeshBuffer mesh_;
    std::vector<Vec3> outline_;
};

} // namespace

std::unique_ptr<Layer> make_stock_layer() {
    return std::make_unique<StockLayer>();
}

} // namespace millwright::viewport
