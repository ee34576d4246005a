// The surface coloured by the height of the material that the tool leaves over it.

#include "core/grid/grid.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/internal/value_surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace millwright::viewport {

namespace {

class ScallopLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        const bool same = cut_ == scene.cut && cutting_setup_ == scene.cutting_setup;
        if (surface_colors(scene) != SurfaceColors::scallop || same) {
            return;
        }
        cut_ = scene.cut;
        cutting_setup_ = scene.cutting_setup;
        const toolpath::SweptCut& swept = cut_->swept;
        const double not_cut = 2.0 * scallop_colors(scene, {}).high; // more than any that was cut
        std::vector<double> heights;
        for (const double height : swept.heights) {
            heights.push_back(std::isfinite(height) ? std::max(height, 0.0) : not_cut);
        }
        surface_ = value_surface(cutting_setup_->patch,
                                 cutting_setup_->trim,
                                 grid::Grid::uniform(swept.nu, swept.nv).array(),
                                 heights);
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (surface_colors(scene) == SurfaceColors::scallop) {
            canvas.painter.mesh(surface_,
                                {.coloring = {.from = render::ColorFrom::value,
                                              .scale = scallop_colors(scene, canvas.colors.over_limit)},
                                 .model = canvas.s_T_w,
                                 .back_color = {},
                                 .highlight = 0.05F},
                                canvas.view);
        }
    }

private:
    std::shared_ptr<const plan::CutStudy> cut_;
    std::shared_ptr<const plan::CuttingSetup> cutting_setup_;
    render::MeshBuffer surface_;
};

} // namespace

std::unique_ptr<Layer> make_scallop_layer() {
    return std::make_unique<ScallopLayer>();
}

} // namespace millwright::viewport
