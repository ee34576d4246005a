// What stands between the table and the surface when the machine is shown: the part's walls below the border
// of the surface, a plate under it and a column down to the table. Only for looking at: the project knows
// none.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/internal/solids.h"

#include <algorithm>

namespace millwright::viewport {

namespace {

constexpr double wall_share = 0.08;   // of the part's size: how far the walls reach below its lowest place
constexpr double plate_mm = 12.0;     // at most
constexpr double column_share = 0.45; // of the plate's edges
constexpr int part_border_steps = 48;

struct Heights {
    double table = 0.0;  ///< of the table's top
    double bottom = 0.0; ///< of the part's underside
    double plate = 0.0;  ///< of the plate's underside
};

/// Heights along z of the workpiece, in which the table's top lies where the workpiece offset is counted
/// from.
Heights heights(const Box3& part, const kinematics::MachineModel& machine) {
    const double table = -machine.description().workpiece_offset.z();
    const double wall = wall_share * part.diagonal().norm();
    const double lowest = part.min().z();
    const double bottom = std::min(lowest, std::max(table, lowest - wall));
    return {.table = table, .bottom = bottom, .plate = std::max(table, bottom - plate_mm)};
}

std::vector<Vec3> border(const geometry::ParametricSurface& patch) {
    constexpr std::array<std::array<double, 2>, 5> corners = {
        {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {0.0, 0.0}}};
    std::vector<Vec3> points;
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
        const std::vector<Vec3> side = on_surface(
            patch, {corners[k][0], corners[k][1]}, {corners[k + 1][0], corners[k + 1][1]}, part_border_steps);
        points.insert(points.end(), side.begin(), side.end() - 1);
    }
    points.push_back(points.front());
    return points;
}

/// Twice the area of the border seen from above, positive if it turns counter-clockwise.
double turning(const std::vector<Vec3>& points) {
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        sum += points[k].x() * points[k + 1].y() - points[k + 1].x() * points[k].y();
    }
    return sum;
}

void add_walls(Solid& solid, std::vector<Vec3> points, double bottom) {
    if (turning(points) < 0.0) {
        std::ranges::reverse(points);
    }
    std::vector<Vec3> below = points;
    for (std::size_t k = 0; k < points.size(); ++k) {
        below[k].z() = bottom;
    }
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        if ((points[k + 1] - points[k]).norm() > 0.0 && points[k].z() > bottom) {
            add_quad(solid,
                     {render::to_float(below[k]),
                      render::to_float(below[k + 1]),
                      render::to_float(points[k + 1]),
                      render::to_float(points[k])});
        }
    }
    append(solid.edges, below);
}

glm::vec3 corner(const Vec2& xy, double z) {
    return render::to_float(Vec3(xy.x(), xy.y(), z));
}

/// A block of `share` of the part's edges between two heights.
SolidBuffers block(const Box3& part, double share, double low, double high) {
    if (!(low < high)) {
        return {};
    }
    const Vec2 center = part.center().head<2>();
    const Vec2 half = 0.5 * share * part.sizes().head<2>();
    return SolidBuffers(box_solid(corner(center - half, low), corner(center + half, high)));
}

class FixtureLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (!scene.layers.machine.bodies ||
            (scene.surface == surface_ && scene.cutting_setup == cutting_setup_)) {
            return;
        }
        surface_ = scene.surface;
        cutting_setup_ = scene.cutting_setup;
        walls_ = {};
        plate_ = {};
        column_ = {};
        if (surface_ && cutting_setup_) {
            rebuild();
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.layers.machine.bodies || !scene.layers.design.surface) {
            return;
        }
        walls_.draw(canvas, canvas.s_T_w, canvas.colors.surface);
        plate_.draw(canvas, canvas.s_T_w, canvas.colors.machine);
        column_.draw(canvas, canvas.s_T_w, canvas.colors.machine);
    }

private:
    void rebuild() {
        std::vector<std::vector<Vec3>> borders;
        Box3 part;
        for (const geometry::ParametricSurface* part_surface : surface_->parts()) {
            borders.push_back(border(*part_surface));
            for (const Vec3& point : borders.back()) {
                part.extend(point);
            }
        }
        const Heights z = heights(part, cutting_setup_->machine);
        Solid walls;
        for (const std::vector<Vec3>& points : borders) {
            add_walls(walls, points, z.bottom);
        }
        walls_ = SolidBuffers(walls);
        plate_ = block(part, 1.0, z.plate, z.bottom);
        column_ = block(part, column_share, z.table, z.plate);
    }

    std::shared_ptr<const geometry::Surface> surface_;
    std::shared_ptr<const plan::CuttingSetup> cutting_setup_;
    SolidBuffers walls_;
    SolidBuffers plate_;
    SolidBuffers column_;
};

} // namespace

std::unique_ptr<Layer> make_fixture_layer() {
    return std::make_unique<FixtureLayer>();
}

} // namespace millwright::viewport
