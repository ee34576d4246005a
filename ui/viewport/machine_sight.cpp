#include "ui/viewport/machine_sight.h"

#include "core/base/units.h"
#include "ui/render/convert.h"
#include "ui/viewport/machine_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::viewport {

namespace {

constexpr int surface_samples = 7; // in each direction
constexpr int tried_directions = 24;
constexpr double enough = 0.8; // of the most that can be seen

/// Whether the ray from `origin` meets the box (slabs; Kay and Kajiya 1986).
bool meets(const Box3& box, const Vec3& origin, const Vec3& direction) {
    double first = 0.0;
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        if (std::abs(direction[k]) > 0.0) {
            const double a = (box.min()[k] - origin[k]) / direction[k];
            const double b = (box.max()[k] - origin[k]) / direction[k];
            first = std::max(first, std::min(a, b));
            last = std::min(last, std::max(a, b));
        } else if (origin[k] < box.min()[k] || origin[k] > box.max()[k]) {
            return false;
        }
    }
    return first < last;
}

/// The machine's bodies as boxes with the way into their frames.
struct Obstacle {
    Box3 box;
    Frame b_T_m;
};

std::vector<Obstacle> obstacles(const Scene& scene) {
    const kinematics::MachineModel& machine = scene.cutting_setup->machine;
    const std::vector<Frame> poses = body_poses(machine, axes_now(scene));
    std::vector<Obstacle> found;
    for (std::size_t k = 0; k < poses.size(); ++k) {
        found.push_back({body_box(machine.description().bodies[k]), poses[k].inverse()});
    }
    return found;
}

bool free_sight(const std::vector<Obstacle>& bodies, const Vec3& from, const Vec3& to_eye) {
    return std::ranges::none_of(bodies, [&](const Obstacle& body) {
        return meets(body.box, body.b_T_m * from, body.b_T_m.linear() * to_eye);
    });
}

} // namespace

double part_seen(const Scene& scene, const Vec3& to_eye) {
    if (!scene.cutting_setup) {
        return 0.0;
    }
    const std::vector<Obstacle> bodies = obstacles(scene);
    const Frame s_T_w = scene_from_workpiece(scene);
    const double side = scene.cutting_setup->flipped ? -1.0 : 1.0;
    double seen = 0.0;
    for (int k = 0; k < surface_samples * surface_samples; ++k) {
        const double u = (0.5 + k % surface_samples) / surface_samples;
        const double v = (0.5 + k / surface_samples) / surface_samples;
        const Vec3 place = s_T_w * scene.cutting_setup->patch.position(u, v);
        const Vec3 normal =
            s_T_w.linear() * scene.cutting_setup->patch.unit_normal(u, v).value_or(Vec3::UnitZ());
        const double facing = side * normal.dot(to_eye);
        seen += facing > 0.0 && free_sight(bodies, place, to_eye) ? facing : 0.0;
    }
    return seen / (surface_samples * surface_samples);
}

render::Camera part_in_sight(const Scene& scene, const render::Camera& camera) {
    std::vector<render::Camera> cameras;
    std::vector<double> seen;
    for (int k = 0; k < tried_directions; ++k) {
        // 0, 1, -1, 2, -2 ... steps from where the camera is
        const double turn = (k % 2 == 1 ? 1.0 : -1.0) * ((k + 1) / 2) * (2.0 * pi / tried_directions);
        cameras.push_back(camera.orbited(turn, 0.0));
        seen.push_back(part_seen(scene, render::to_core(cameras.back().backward())));
    }
    const double most = *std::ranges::max_element(seen);
    const auto good = std::ranges::find_if(seen, [&](double part) { return part >= enough * most; });
    return cameras[static_cast<std::size_t>(good - seen.begin())];
}

} // namespace millwright::viewport
