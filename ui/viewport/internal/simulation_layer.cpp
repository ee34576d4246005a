// The tool at the present moment, and the way that it really took so far. Where the machine is shown and
// the project's tool is a point, the machine's own cutter is the tool.

#include "core/kinematics/forward.h"
#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/internal/solids.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>

namespace millwright::viewport {

namespace {

constexpr double tool_share = 0.035; // radius of a tool that is a point to that of the part

Frame pose_frame(const geometry::ToolPose& pose) {
    Frame frame = Frame::Identity();
    frame.linear() = frame_along(pose.axis);
    frame.translation() = pose.tip;
    return frame;
}

class SimulationLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (!tool_ || scene.cutting_setup != tool_of_) {
            tool_.emplace(has_cutter(scene) ? tool_solid(scene.cutting_setup->tool) : tool_solid());
            tool_of_ = scene.cutting_setup;
        }
        if (!traced(scene) || (scene.shown == shown_ && scene.cutting_setup == cutting_setup_)) {
            return;
        }
        shown_ = scene.shown;
        cutting_setup_ = scene.cutting_setup;
        trace_ = shown_ && cutting_setup_ ? trace_of(*cutting_setup_, *shown_) : PathLines();
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.now || !scene.cutting_setup) {
            return;
        }
        if (traced(scene)) {
            draw_trace(scene, canvas);
        }
        if (scene.layers.machine.tool && (!scene.layers.machine.bodies || has_cutter(scene))) {
            draw_tool(scene, canvas);
        }
    }

private:
    static bool has_cutter(const Scene& scene) {
        return scene.cutting_setup && scene.cutting_setup->tool.cutter;
    }

    /// The error layer draws the same way in colours of its own.
    static bool traced(const Scene& scene) {
        return scene.layers.path.trace && scene.now && scene.now->move >= 0 && !scene.layers.path.errors;
    }

    static PathLines trace_of(const plan::CuttingSetup& cutting_setup, const plan::Evaluation& shown) {
        const int moves = static_cast<int>(shown.field.moves.size());
        const int steps = std::max(smooth_steps(moves), 2);
        return PathLines(moves, [&](int move) -> PathLines::Move {
            const bool cuts =
                shown.field.moves[static_cast<std::size_t>(move)].kind == toolpath::MoveKind::track;
            return {.points = cuts ? actual_tips(cutting_setup, shown, move, steps) : std::vector<Vec3>{}};
        });
    }

    void draw_trace(const Scene& scene, const Canvas& canvas) const {
        draw_seamed(canvas,
                    trace_.buffer(),
                    {.coloring = {.color = with_opacity(canvas.colors.selected, 1.0F)},
                     .model = canvas.s_T_w,
                     .width_px = track_width_px(shown_.get(), canvas),
                     .count = segments_done(trace_, scene.now)},
                    canvas.view);
    }

    void draw_tool(const Scene& scene, const Canvas& canvas) const {
        const Frame w_T_tool = pose_frame(kinematics::forward(scene.cutting_setup->machine, axes_now(scene)));
        const float size = has_cutter(scene) ? 1.0F : static_cast<float>(tool_share * radius(canvas.content));
        const glm::mat4 placed = canvas.s_T_w * glm::mat4(render::to_glm(w_T_tool));
        tool_->draw(canvas, glm::scale(placed, glm::vec3(size)), canvas.colors.tool);
    }

    std::optional<SolidBuffers> tool_;
    std::shared_ptr<const plan::CuttingSetup> tool_of_; // whose tool that is
    std::shared_ptr<const plan::Evaluation> shown_;
    std::shared_ptr<const plan::CuttingSetup> cutting_setup_;
    PathLines trace_;
};

} // namespace

std::unique_ptr<Layer> make_simulation_layer() {
    return std::make_unique<SimulationLayer>();
}

} // namespace millwright::viewport
