#include "core/kinematics/machine_solids.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/json.h"

#include <algorithm>
#include <array>
#include <string>

namespace millwright::kinematics {

namespace {

constexpr std::string_view base_name = "base";
constexpr std::string_view axis_prefix = "axis ";

using geometry::Circle;
using geometry::Extent;
using geometry::SolidMesh;

const Vec3 carbide(0.78, 0.60, 0.33);

constexpr double widest_edge = 3.0; // mm
constexpr double widest_corner = 12.0;

/// What stands is dark, what an axis of the table carries is steel, the head is painted; slender things of
/// the head are the cutter.
Vec3 color_of(const MachineModel& machine, const MachineBody& body) {
    if (body.carried_by == '\0') {
        return graphite;
    }
    const MachineAxis& carrier = machine.axis(machine.axis_index(body.carried_by));
    if (carrier.side == AxisSide::table) {
        return carrier.kind == AxisKind::rotary ? steel : graphite;
    }
    constexpr double slender = 0.5; // of width to height
    const bool is_cutter =
        body.shape == MachineBody::Shape::cylinder && body.size.x() < slender * body.size.z();
    return is_cutter && (body.center - machine.description().tool_tip).norm() < body.size.z() ? carbide
                                                                                              : paint;
}

std::vector<Circle> corners_of(const Vec3& size, double radius) {
    const double x = 0.5 * size.x() - radius;
    const double y = 0.5 * size.y() - radius;
    return {{Vec2(x, y), radius}, {Vec2(-x, y), radius}, {Vec2(-x, -y), radius}, {Vec2(x, -y), radius}};
}

SolidMesh solid_of(const MachineModel& machine, const MachineBody& body) {
    const double half = 0.5 * body.size.z();
    const double edge = std::min(widest_edge, 0.1 * body.size.minCoeff());
    const Extent extent{-half, half, edge};
    Frame m_T_b = Frame::Identity();
    m_T_b.translation() = body.center;
    if (body.shape == MachineBody::Shape::cylinder) {
        m_T_b.linear() = frame_along(body.direction);
        const std::array circle{Circle{Vec2::Zero(), 0.5 * body.size.x()}};
        return moved(hull_of(circle, extent, color_of(machine, body)), m_T_b);
    }
    const double corner = std::min(widest_corner, 0.3 * std::min(body.size.x(), body.size.y()));
    return moved(hull_of(corners_of(body.size, corner), extent, color_of(machine, body)), m_T_b);
}

geometry::PlacedBody carried_by(const MachineModel& machine, char carrier) {
    geometry::PlacedBody placed;
    placed.body.name = carrier == '\0' ? std::string(base_name) : std::string(axis_prefix) + carrier;
    for (const MachineBody& body : machine.description().bodies) {
        if (body.carried_by == carrier) {
            placed.body.meshes.push_back(solid_of(machine, body));
        }
    }
    return placed;
}

} // namespace

std::vector<geometry::PlacedBody> machine_solids(const MachineModel& machine) {
    std::vector<geometry::PlacedBody> solids{carried_by(machine, '\0')};
    for (const MachineAxis& axis : machine.axes()) {
        solids.push_back(carried_by(machine, axis.letter));
    }
    std::erase_if(solids, [](const geometry::PlacedBody& placed) { return placed.body.meshes.empty(); });
    return solids;
}

bool is_cutter(const MachineModel& machine, const MachineBody& body) {
    constexpr double touching = 1e-3; // mm: machine files are rounded to micrometres
    const MachineDescription& description = machine.description();
    const Vec3 lower_end = body.center - 0.5 * body.size.z() * body.direction;
    const Vec3 own_tip = description.tool_tip + description.tool_length_offset * description.tool_axis;
    return body.shape == MachineBody::Shape::cylinder && !description.head.empty() &&
           body.carried_by == description.head.back().letter && (lower_end - own_tip).norm() < touching;
}

char carrier_of(const geometry::SolidBody& body) {
    return body.name.starts_with(axis_prefix) ? body.name.back() : '\0';
}

std::shared_ptr<const std::vector<geometry::SolidBody>>
read_machine_solids(const std::filesystem::path& machine_file, const MachineModel& machine) {
    const JsonValue root = JsonValue::read(machine_file);
    const auto named = root.find("solids");
    if (!named) {
        return nullptr;
    }
    const std::filesystem::path file = machine_file.parent_path() / named->text();
    auto bodies = geometry::parse_glb(read_file(file), file);
    for (const geometry::SolidBody& body : bodies) {
        bool known = body.name == base_name;
        for (const MachineAxis& axis : machine.axes()) {
            known = known || body.name == std::string(axis_prefix) + axis.letter;
        }
        if (!known) {
            throw Error("no axis matches the body '" + body.name + "'",
                        file.string(),
                        "name a body \"base\" or \"axis C\", with the letter of one of the machine's axes");
        }
    }
    return std::make_shared<const std::vector<geometry::SolidBody>>(std::move(bodies));
}

} // namespace millwright::kinematics
