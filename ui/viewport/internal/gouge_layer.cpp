// Where the tool gouges: the deepest place of every block that brings the cutter or the holder into the part,
// and the nodes at which the cutter does not fit into the surface.

#include "core/base/text.h"
#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/layers.h"

#include <algorithm>
#include <string>
#include <vector>

namespace millwright::viewport {

namespace {

const plan::BlockBite* deepest_of(const plan::CutStudy& cut, bool by_holder) {
    const plan::BlockBite* deepest = nullptr;
    for (const plan::BlockBite& bite : cut.bites) {
        if (bite.by_holder == by_holder && (!deepest || bite.bite.depth > deepest->bite.depth)) {
            deepest = &bite;
        }
    }
    return deepest;
}

class GougeLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (!scene.layers.path.gouges || scene.cut == cut_) {
            return;
        }
        cut_ = scene.cut;
        std::vector<render::PointVertex> cutter;
        std::vector<render::PointVertex> holder;
        std::vector<render::PointVertex> local;
        if (cut_) {
            for (const plan::BlockBite& bite : cut_->bites) {
                (bite.by_holder ? holder : cutter)
                    .push_back({.position = render::to_float(bite.bite.position)});
            }
            for (const plan::LocalGouge& gouge : cut_->local_gouges) {
                local.push_back({.position = render::to_float(gouge.contact)});
            }
        }
        cutter_ = render::PointBuffer(cutter);
        holder_ = render::PointBuffer(holder);
        local_ = render::PointBuffer(local);
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.layers.path.gouges || !scene.cut) {
            return;
        }
        const render::ViewColors& colors = canvas.colors;
        draw_rings(canvas, local_, 9.0F, 2.0F, colors.warning, 0.0F);
        draw_rings(canvas, cutter_, 8.0F, 1.0F, colors.danger, 1.0F);
        draw_rings(canvas, holder_, 13.0F, 3.0F, colors.danger, 0.0F);
    }

    [[nodiscard]] std::vector<Label> labels(const Scene& scene, const Canvas& canvas) const override {
        std::vector<Label> labels;
        if (!scene.layers.path.gouges || !scene.cut) {
            return labels;
        }
        const Frame s_T_w = scene_from_workpiece(scene);
        for (const bool by_holder : {false, true}) {
            if (const plan::BlockBite* bite = deepest_of(*scene.cut, by_holder)) {
                labels.push_back({render::to_glm(s_T_w * bite->bite.position),
                                  (by_holder ? "holder " : "gouge ") + fixed(bite->bite.depth, 3) + " mm",
                                  canvas.colors.danger});
            }
        }
        return labels;
    }

private:
    std::shared_ptr<const plan::CutStudy> cut_;
    render::PointBuffer cutter_;
    render::PointBuffer holder_;
    render::PointBuffer local_;
};

} // namespace

std::unique_ptr<Layer> make_gouge_layer() {
    return std::make_unique<GougeLayer>();
}

} // namespace millwright::viewport
