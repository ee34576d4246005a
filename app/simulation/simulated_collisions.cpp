#include "app/simulation/simulated_collisions.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/exchange/mesh_file.h"
#include "core/kinematics/machine_solids.h"
#include "core/project/json_text.h"
#include "core/simulation/spec_text.h"
#include "core/simulation/warnings.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string_view>
#include <utility>

namespace millwright::app {

namespace {

using nlohmann::ordered_json;
using simulation::BodyRole;
using simulation::Collision;
using simulation::CollisionReport;
using simulation::Finding;
using simulation::FindingKind;

ordered_json line_json(int line) {
    return line > 0 ? ordered_json(line) : ordered_json();
}

std::string_view body_of(const Finding& finding) {
    return finding.kind == FindingKind::holder_in_stock ? "holder" : "shank";
}

std::string_view kind_of(bool rapid) {
    return rapid ? "rapid" : "feed";
}

/// Of lengths mm, of rotary axes degrees.
double shown(const SimulatedWork& work, char axis, double position) {
    return work.machine.axis(work.machine.axis_index(axis)).kind == kinematics::AxisKind::rotary
               ? to_degrees(position)
               : position;
}

ordered_json json_of(const Collision& collision, bool contact) {
    ordered_json entry;
    entry["bodies"] = {collision.moving, collision.still};
    entry["line"] = line_json(collision.line);
    entry["block"] = collision.block;
    entry["time"] = project::rounded(collision.time);
    entry["move"] = kind_of(collision.rapid);
    entry["position_mm"] = project::vector(collision.place);
    entry[contact ? "depth_mm" : "distance_mm"] = project::rounded(collision.depth);
    if (contact) {
        entry["deepest_line"] = line_json(collision.deepest_line);
    }
    entry["last_line"] = line_json(collision.last_line);
    entry["moves"] = collision.moves;
    return entry;
}

ordered_json json_of(const SimulatedWork& work, const Finding& finding) {
    const program::Block& block = work.program.blocks[static_cast<std::size_t>(finding.block)];
    ordered_json entry;
    entry["bodies"] = {body_of(finding), "stock"};
    entry["line"] = line_json(finding.line);
    entry["block"] = finding.block;
    entry["time"] = project::rounded(finding.time);
    entry["move"] = kind_of(block.kind == program::BlockKind::rapid);
    entry["position_mm"] = project::vector(finding.contact.place);
    entry["depth_mm"] = project::rounded(finding.depth);
    entry["deepest_line"] = line_json(finding.line);
    entry["last_line"] = line_json(finding.line);
    entry["moves"] = 1;
    return entry;
}

void print_at_line(const SimulatedWork& work, int line, std::string message) {
    fmt::print(stderr,
               "millwright: {}\n",
               to_text(Diagnostic{{work.program_file, line, 0, -1}, std::move(message), {}}));
}

std::string place_text(const Vec3& place) {
    return fmt::format("{} {} {}", fixed(place.x(), 3), fixed(place.y(), 3), fixed(place.z(), 3));
}

/// Prints the first few.
class Few {
public:
    bool next() { return ++count_ <= named; }
    void finish(std::string_view one, std::string_view many) const {
        if (count_ > named) {
            fmt::print(
                stderr, "millwright: {}, all in simulation.json\n", counted(count_ - named, one, many));
        }
    }

private:
    static constexpr std::size_t named = 5;
    std::size_t count_ = 0;
};

std::string moves_text(const Collision& collision) {
    return collision.moves == 1
               ? std::string()
               : fmt::format(", through {} moves up to line {}", collision.moves, collision.last_line);
}

} // namespace

FixtureText parse_fixture(const std::string& text) {
    const simulation::StockText parsed = simulation::parse_stock(text);
    if (parsed.stock) {
        throw Error(
            fmt::format("\"{}\" is no mesh file", printable(text)), {}, "write FILE.stl or FILE.stl@X,Y,Z");
    }
    return {parsed.mesh_file, parsed.shift};
}

void add_part(const std::filesystem::path& file, SimulatedWork& work, const Progress& progress) {
    exchange::MeshFile read = exchange::read_mesh(file, 1.0, progress);
    const auto mesh = std::make_shared<const simulation::MeshStock>(
        simulation::MeshStock{read.mesh.points, read.mesh.triangles});
    const bool closed = simulation::fault_of(simulation::Stock(mesh)).empty();
    work.bodies.push_back(
        simulation::collision_body(work.machine,
                                   "part",
                                   BodyRole::part,
                                   {std::move(read.mesh.points), std::move(read.mesh.triangles)},
                                   closed));
}

void take_bodies(const SimulateOptions& options, SimulatedWork& work, const Progress& progress) {
    const auto solids = kinematics::read_machine_solids(work.machine_file, work.machine);
    const std::vector<simulation::CollisionBody> machine_bodies = simulation::machine_collision_bodies(
        work.machine, solids ? std::span(*solids) : std::span<const geometry::SolidBody>());
    work.bodies.insert(work.bodies.end(), machine_bodies.begin(), machine_bodies.end());
    for (const std::string& text : options.fixtures) {
        const FixtureText fixture = parse_fixture(text);
        exchange::MeshFile read = exchange::read_mesh(fixture.file, 1.0, progress);
        simulation::MeshStock mesh{std::move(read.mesh.points), std::move(read.mesh.triangles)};
        for (Vec3& point : mesh.points) {
            point += fixture.shift;
        }
        const auto shared = std::make_shared<const simulation::MeshStock>(mesh);
        if (const std::string fault = simulation::fault_of(simulation::Stock(shared)); !fault.empty()) {
            throw Error(fault, fixture.file, "repair it in the program that it comes from");
        }
        const std::string name = fmt::format("fixture {}", printable(fixture.file.filename().string()));
        work.bodies.push_back(simulation::collision_body(work.machine,
                                                         name,
                                                         BodyRole::fixture,
                                                         {std::move(mesh.points), std::move(mesh.triangles)},
                                                         true));
        simulation::expect_on_table(work.bodies.back(), machine_bodies, work.machine);
    }
    work.bodies.push_back(simulation::collision_body(
        work.machine, "stock", BodyRole::stock, simulation::surface_of(work.stock), true));
}

CollisionReport collisions_of(const SimulatedWork& work,
                              const SimulateOptions& options,
                              const simulation::SimulationInput& input,
                              const simulation::Simulation& found,
                              const Progress& progress) {
    std::vector<simulation::CollisionTool> tools;
    for (const simulation::ToolUse& tool : work.tools) {
        tools.push_back({tool.first_block, tool.body, tool.shank, tool.holder, tool.machine});
    }
    return simulation::check_collisions({.program = work.program,
                                         .machine = work.machine,
                                         .tools = std::move(tools),
                                         .bodies = work.bodies,
                                         .first_block = found.first_block,
                                         .clearance = options.clearance,
                                         .part_allowance = options.tolerance,
                                         .removal = &input},
                                        progress);
}

bool collides(const CollisionReport& report, const simulation::Simulation& found) {
    return !report.collisions.empty() || !report.limits.empty() ||
           std::ranges::any_of(found.findings, simulation::is_in_stock);
}

ordered_json collisions_json(const SimulatedWork& work,
                             const CollisionReport& report,
                             const simulation::Simulation& found,
                             double clearance) {
    ordered_json json;
    json["clearance_mm"] = project::rounded(clearance);
    json["bodies"] = ordered_json::array();
    for (const simulation::CollisionBody& body : work.bodies) {
        json["bodies"].push_back(body.name);
    }
    json["contacts"] = ordered_json::array();
    for (const Collision& collision : report.collisions) {
        json["contacts"].push_back(json_of(collision, true));
    }
    for (const Finding& finding : found.findings) {
        if (simulation::is_in_stock(finding)) {
            json["contacts"].push_back(json_of(work, finding));
        }
    }
    json["near_misses"] = ordered_json::array();
    for (const Collision& collision : report.near_misses) {
        json["near_misses"].push_back(json_of(collision, false));
    }
    json["limits"] = ordered_json::array();
    for (const simulation::LimitViolation& limit : report.limits) {
        ordered_json entry;
        entry["axis"] = std::string(1, limit.axis);
        entry["line"] = line_json(limit.line);
        entry["last_line"] = line_json(limit.last_line);
        entry["block"] = limit.block;
        entry["position"] = project::rounded(shown(work, limit.axis, limit.position));
        entry["limit"] = project::rounded(shown(work, limit.axis, limit.limit));
        entry["moves"] = limit.moves;
        json["limits"].push_back(std::move(entry));
    }
    json["not_checked"] = report.unchecked;
    return json;
}

void print_collisions(const SimulatedWork& work,
                      const CollisionReport& report,
                      const simulation::Simulation& found) {
    Few contacts;
    for (const Collision& collision : report.collisions) {
        if (contacts.next()) {
            print_at_line(work,
                          collision.line,
                          fmt::format("{} collides with {} at {}, {} mm deep{}",
                                      collision.moving,
                                      collision.still,
                                      place_text(collision.place),
                                      fixed(collision.depth, 3),
                                      moves_text(collision)));
        }
    }
    contacts.finish("more collision", "more collisions");
    Few in_stock;
    for (const Finding& finding : found.findings) {
        if (simulation::is_in_stock(finding) && in_stock.next()) {
            print_at_line(work,
                          finding.line,
                          fmt::format("{} collides with stock at {}, {} mm deep",
                                      body_of(finding),
                                      place_text(finding.contact.place),
                                      fixed(finding.depth, 3)));
        }
    }
    in_stock.finish("more move collides with stock", "more moves collide with stock");
    for (const simulation::LimitViolation& limit : report.limits) {
        print_at_line(work,
                      limit.line,
                      fmt::format("axis {} goes to {}, beyond its limit {}",
                                  limit.axis,
                                  fixed(shown(work, limit.axis, limit.position), 3),
                                  fixed(shown(work, limit.axis, limit.limit), 3)));
    }
    for (const std::string& sentence : report.unchecked) {
        fmt::print("not checked: {}\n", sentence);
    }
    const auto nearest = std::ranges::min_element(report.near_misses, {}, &Collision::depth);
    fmt::print("{}, {}{}\n",
               collides(report, found) ? "collisions found" : "no collisions",
               counted(report.near_misses.size(), "near miss", "near misses"),
               nearest == report.near_misses.end()
                   ? std::string()
                   : fmt::format(", the nearest {} mm: {} and {}{}",
                                 fixed(nearest->depth, 3),
                                 nearest->moving,
                                 nearest->still,
                                 nearest->line > 0 ? fmt::format(" (line {})", nearest->line) : ""));
}

} // namespace millwright::app
