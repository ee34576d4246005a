// The surface coloured by the weight of the elliptic functional: cells become small where it is large.

#include "core/grid/grid.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/internal/value_surface.h"

namespace millwright::viewport {

namespace {

class WeightLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        const bool same = weight_ == scene.weight && cutting_setup_ == scene.cutting_setup;
        if (surface_colors(scene) != SurfaceColors::weight || same) {
            return;
        }
        weight_ = scene.weight;
        cutting_setup_ = scene.cutting_setup;
        const grid::Grid raster = grid::Grid::uniform(weight_->rows, weight_->columns);
        surface_ =
            value_surface(cutting_setup_->patch, cutting_setup_->trim, raster.array(), weight_->values);
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (surface_colors(scene) == SurfaceColors::weight) {
            canvas.painter.mesh(
                surface_,
                {.coloring = {.from = render::ColorFrom::value, .scale = weight_colors(scene)},
                 .model = canvas.s_T_w,
                 .back_color = {},
                 .highlight = 0.05F},
                canvas.view);
        }
    }

private:
    std::shared_ptr<const plan::WeightMap> weight_;
    std::shared_ptr<const plan::CuttingSetup> cutting_setup_;
    render::MeshBuffer surface_;
};

} // namespace

std::unique_ptr<Layer> make_weight_layer() {
    return std::make_unique<WeightLayer>();
}

} // namespace millwright::viewport
