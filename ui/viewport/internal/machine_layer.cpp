// The machine: the bodies of its glb file, else the simple ones of its machine file, each carried by its
// axis. The scene's frame is then the machine's.

#include "core/base/numbers.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/machine_solids.h"
#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/internal/solid_buffers.h"
#include "ui/viewport/internal/solids.h"
#include "ui/viewport/machine_bodies.h"

#include <algorithm>
#include <array>
#include <optional>

namespace millwright::viewport {

namespace {

/// Height of the project's tool above its tip, which the machine's own cutter makes room for; 0 for a point.
double height_of_tool(const Scene& scene) {
    if (!scene.cutting_setup || !scene.cutting_setup->tool.cutter) {
        return 0.0;
    }
    const toolpath::Tool& tool = scene.cutting_setup->tool;
    return (tool.holder ? *tool.holder : *tool.cutter).shape().top;
}

/// What is left of the machine's cutter above the project's tool.
Solid cutter_above(const kinematics::MachineBody& body, double height) {
    const auto r = static_cast<float>(0.5 * body.size.x());
    const auto top = static_cast<float>(0.5 * body.size.z());
    const auto bottom = static_cast<float>(height - 0.5 * body.size.z());
    if (bottom >= top) {
        return {};
    }
    const std::array<glm::vec2, 4> profile = {{{0.0F, bottom}, {r, bottom}, {r, top}, {0.0F, top}}};
    return turned_solid(profile);
}

Solid solid_of(const kinematics::MachineBody& body) {
    if (body.shape == kinematics::MachineBody::Shape::cylinder) {
        return cylinder_solid(static_cast<float>(body.size.x()), static_cast<float>(body.size.z()));
    }
    const Box3 box = body_box(body);
    return box_solid(render::to_float(Vec3(box.min())), render::to_float(Vec3(box.max())));
}

/// While another machine is being derived, bodies and machine can be of two.
bool fit(const kinematics::MachineModel& machine, const std::vector<geometry::SolidBody>& solids) {
    return std::ranges::all_of(solids, [&](const geometry::SolidBody& body) {
        const char carrier = kinematics::carrier_of(body);
        return carrier == '\0' ||
               std::ranges::any_of(machine.axes(), [&](const kinematics::MachineAxis& axis) {
                   return axis.letter == carrier;
               });
    });
}

class MachineLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        const auto machine = machine_of(scene);
        const double height = height_of_tool(scene);
        const bool own =
            !scene.opened && scene.machine_solids && machine && fit(*machine, *scene.machine_solids);
        const auto solids = own ? scene.machine_solids : nullptr;
        if (!scene.layers.machine.bodies ||
            (machine == machine_ && solids == solids_ && exactly_equal(height, height_of_tool_))) {
            return;
        }
        machine_ = machine;
        height_of_tool_ = height;
        if (solids != solids_) {
            solids_ = solids;
            meshes_.clear();
            for (std::size_t n = 0; solids_ && n < solids_->size(); ++n) {
                meshes_.push_back(buffers_of((*solids_)[n]));
            }
        }
        bodies_.clear();
        if (machine_) {
            for (const kinematics::MachineBody& body : machine_->description().bodies) {
                bodies_.emplace_back(is_cutter(*machine_, body) ? cutter_above(body, height)
                                                                : solid_of(body));
            }
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.layers.machine.bodies || !machine_) {
            return;
        }
        const kinematics::AxisPositions axes = axes_now(scene);
        const std::vector<Frame> poses = body_poses(*machine_, axes);
        for (std::size_t k = 0; k < bodies_.size(); ++k) {
            const kinematics::MachineBody& body = machine_->description().bodies[k];
            if (!solids_ || is_cutter(*machine_, body)) {
                bodies_[k].draw(
                    canvas, glm::mat4(render::to_glm(poses[k])), color_of(*machine_, body, canvas.colors));
            }
        }
        if (solids_) {
            draw_solids(canvas, axes);
        }
    }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        std::vector<glm::dvec3> all;
        const auto machine = scene.layers.machine.bodies ? machine_of(scene) : nullptr;
        if (machine) {
            const std::vector<Frame> poses = body_poses(*machine, axes_now(scene));
            for (std::size_t k = 0; k < poses.size(); ++k) {
                const Box3 box = body_box(machine->description().bodies[k]);
                const std::vector<glm::dvec3> corners = moved_corners(box, poses[k]);
                all.insert(all.end(), corners.begin(), corners.end());
            }
        }
        return all;
    }

private:
    static glm::vec3 color_of(const kinematics::MachineModel& machine,
                              const kinematics::MachineBody& body,
                              const render::ViewColors& colors) {
        if (is_cutter(machine, body)) {
            return colors.tool;
        }
        return body.carried_by == '\0' ? colors.machine : colors.machine_moving;
    }

    /// But the cutter, which is drawn as long as the project's tool leaves it.
    void draw_solids(const Canvas& canvas, const kinematics::AxisPositions& axes) const {
        for (std::size_t n = 0; n < meshes_.size(); ++n) {
            const char carrier = kinematics::carrier_of((*solids_)[n]);
            const glm::mat4 model(render::to_glm(kinematics::carrier_motion(*machine_, axes, carrier)));
            const std::optional<std::size_t> cutter = cutter_among(carrier);
            for (std::size_t m = 0; m < meshes_[n].size(); ++m) {
                if (m != cutter) {
                    const auto& [mesh, color, closed] = meshes_[n][m];
                    canvas.painter.mesh(mesh,
                                        {.coloring = {.color = with_opacity(color, 1.0F)},
                                         .model = model,
                                         .back_color = {},
                                         .closed = closed},
                                        canvas.view);
                }
            }
        }
    }

    /// Which of the bodies of a carrier is the cutter.
    [[nodiscard]] std::optional<std::size_t> cutter_among(char carrier) const {
        std::size_t n = 0;
        for (const kinematics::MachineBody& body : machine_->description().bodies) {
            if (body.carried_by == carrier) {
                if (is_cutter(*machine_, body)) {
                    return n;
                }
                ++n;
            }
        }
        return std::nullopt;
    }

    std::shared_ptr<const kinematics::MachineModel> machine_;
    std::shared_ptr<const std::vector<geometry::SolidBody>> solids_;
    double height_of_tool_ = 0.0;
    std::vector<SolidBuffers> bodies_;
    std::vector<std::vector<ColoredMesh>> meshes_; // of `solids_`
};

} // namespace

std::unique_ptr<Layer> make_machine_layer() {
    return std::make_unique<MachineLayer>();
}

} // namespace millwright::viewport
