// The machine: simple bodies, each carried by its axis. The scene's frame is then the machine's.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/internal/solids.h"
#include "ui/viewport/machine_bodies.h"

namespace millwright::viewport {

namespace {

Solid solid_of(const kinematics::MachineBody& body) {
    if (body.shape == kinematics::MachineBody::Shape::cylinder) {
        return cylinder_solid(static_cast<float>(body.size.x()), static_cast<float>(body.size.z()));
    }
    const Box3 box = body_box(body);
    return box_solid(render::to_float(Vec3(box.min())), render::to_float(Vec3(box.max())));
}

class MachineLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        const auto machine = machine_of(scene);
        if (!scene.layers.machine || machine == machine_) {
            return;
        }
        machine_ = machine;
        bodies_.clear();
        if (machine_) {
            for (const kinematics::MachineBody& body : machine_->description().bodies) {
                bodies_.emplace_back(solid_of(body));
            }
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.layers.machine || !machine_) {
            return;
        }
        const std::vector<Frame> poses = body_poses(*machine_, axes_now(scene));
        for (std::size_t k = 0; k < bodies_.size(); ++k) {
            const kinematics::MachineBody& body = machine_->description().bodies[k];
            bodies_[k].draw(
                canvas, glm::mat4(render::to_glm(poses[k])), color_of(*machine_, body, canvas.colors));
        }
    }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        std::vector<glm::dvec3> all;
        const auto machine = scene.layers.machine ? machine_of(scene) : nullptr;
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

    std::shared_ptr<const kinematics::MachineModel> machine_;
    std::vector<SolidBuffers> bodies_;
};

} // namespace

std::unique_ptr<Layer> make_machine_layer() {
    return std::make_unique<MachineLayer>();
}

} // namespace millwright::viewport
