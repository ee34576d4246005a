// Collisions along 100,000 moves of five bodies close above a part of 100,352 triangles: shank and holder of
// a tool, spindle head, a fixture and the table, on a machine whose table turns. A move is 1 mm and turns by
// up to half a degree; the nearest part of the shank is 0.5 to 1.7 mm above the surface.
//     build/release/bench/collision_bench
// Counters: moves, triangles, pairs that are looked at for each move, contacts.
#include "core/base/units.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/machine_file.h"
#include "core/simulation/collision.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace millwright::simulation {
namespace {

constexpr int steps = 224; // 2 x 224 x 224 = 100,352 triangles
constexpr double edge = 100.0;

double height(double x, double y) {
    return 4.0 * std::sin(0.12 * x) * std::cos(0.1 * y);
}

CollisionTriangles bumps() {
    CollisionTriangles surface;
    for (int j = 0; j <= steps; ++j) {
        for (int i = 0; i <= steps; ++i) {
            const double x = edge * i / steps - 0.5 * edge, y = edge * j / steps - 0.5 * edge;
            surface.points.emplace_back(x, y, height(x, y));
        }
    }
    constexpr int row = steps + 1;
    for (int j = 0; j < steps; ++j) {
        for (int i = 0; i < steps; ++i) {
            const int a = j * row + i;
            surface.triangles.push_back({a, a + 1, a + row + 1});
            surface.triangles.push_back({a, a + row + 1, a + row});
        }
    }
    return surface;
}

CollisionBody box(const char* name, char carrier, BodyRole role, const Vec3& low, const Vec3& high) {
    return {name,
            role,
            carrier,
            std::make_shared<const CollisionMesh>(surface_of(Stock(BoxStock{low, high}))),
            true};
}

/// Rows over the part on a machine with five axes, rotary axes swinging by some degrees.
program::Program rows_over(const kinematics::MachineModel& machine, int moves) {
    program::Program made;
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        made.axes.push_back({axis.letter, axis.kind});
    }
    kinematics::AxisPositions at = kinematics::AxisPositions::Zero(machine.axis_count());
    const auto axis = [&](char letter) { return machine.axis_index(letter); };
    for (int n = 0; n <= moves; ++n) {
        const double along = n % 200, row = n / 200;
        const double x = (static_cast<int>(row) % 2 == 0 ? along : 199.0 - along) * 0.45 - 45.0;
        const double y = row * 0.179 - 45.0;
        at[axis('A')] = from_degrees(3.0 * std::sin(0.15 * n));
        at[axis('C')] = from_degrees(5.0 * std::sin(0.05 * n));
        // The tip that is wanted, by Newton's method on the linear axes.
        const Vec3 wanted(x, y, height(x, y) + 1.7);
        const kinematics::LinearMap map = kinematics::linear_map(machine, at);
        const Vec3 linear = map.columns.inverse() * (wanted - map.tip_at_zero);
        for (int k = 0; k < 3; ++k) {
            at[machine.linear_axes().at(static_cast<std::size_t>(k))] = linear[k];
        }
        program::Block block;
        block.kind = program::BlockKind::feed;
        block.target = at;
        made.blocks.push_back(std::move(block));
    }
    made.start = made.blocks.front().target;
    return made;
}

void five_bodies(benchmark::State& state) {
    const kinematics::MachineModel machine = kinematics::read_machine("assets/machines/ac-table.json");
    const program::Program program = rows_over(machine, static_cast<int>(state.range(0)));
    const CollisionTriangles part = bumps();
    std::vector<CollisionBody> bodies;
    bodies.push_back(collision_body(machine, "part", BodyRole::part, part, false));
    bodies.push_back(box("head", 'Z', BodyRole::machine, {-43, -43, 90}, {43, 43, 230}));
    bodies.push_back(box("table", 'A', BodyRole::machine, {-170, -130, -168}, {170, 130, -124}));
    bodies.push_back(box("fixture", 'C', BodyRole::fixture, {60, -20, -100}, {80, 20, -45}));
    CollisionTool tool;
    tool.shank = toolpath::Profile({.flat = 2.0, .radius = 2.0, .bottom = 0.0, .top = 30.0});
    tool.holder = toolpath::Profile({.flat = 16.0, .radius = 16.0, .bottom = 30.0, .top = 80.0});
    CollisionReport report;
    for (auto _ : state) {
        report = check_collisions(
            {.program = program, .machine = machine, .tools = {tool}, .bodies = bodies, .first_block = 1},
            Progress());
    }
    state.counters["moves"] = report.moves;
    state.counters["triangles"] = static_cast<double>(part.triangles.size());
    state.counters["pairs"] = report.pairs;
    state.counters["contacts"] = static_cast<double>(report.collisions.size());
}

BENCHMARK(five_bodies)
    ->ArgName("moves")
    ->Arg(100'000)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(1);

} // namespace
} // namespace millwright::simulation
