// What a frame of the 3D view costs: where no graphics card is, Mesa's llvmpipe draws on the processor, and
// the person who turns the view waits for it. In memory, so no display is needed.
#include "core/arm/arm_simulation.h"
#include "core/geometry/mesh.h"
#include "core/geometry/presets.h"
#include "core/plan/plan.h"
#include "core/project/assets.h"
#include "core/project/project_file.h"
#include "ui/render/camera.h"
#include "ui/render/convert.h"
#include "ui/render/framebuffer.h"
#include "ui/render/offscreen_context.h"
#include "ui/render/painter.h"
#include "ui/viewport/picture.h"
#include "ui/viewport/scene_view.h"

#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

namespace millwright::viewport {
namespace {

constexpr render::PixelSize pane{1028, 612}; // of the 3D view in a window of 1600 x 1000

struct TessellatedDome {
    std::vector<render::MeshVertex> vertices;
    std::vector<std::uint32_t> triangles;
    std::vector<glm::dvec3> outline;
};

/// `cells` x `cells` x 2 triangles.
TessellatedDome dome(int cells) {
    const geometry::Surface surface = geometry::surface_preset("dome").make();
    const geometry::Mesh mesh = geometry::tessellate(surface.patch(geometry::PatchId{0}), cells, cells);
    TessellatedDome made;
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        made.vertices.push_back({.position = render::to_float(mesh.positions[k]),
                                 .normal = render::to_float(mesh.normals[k]),
                                 .value = static_cast<float>(mesh.positions[k].z())});
        made.outline.push_back(render::to_glm(mesh.positions[k]));
    }
    for (const auto& [a, b, c] : mesh.triangles) {
        for (const auto corner : {a, b, c}) {
            made.triangles.push_back(static_cast<std::uint32_t>(corner));
        }
    }
    return made;
}

constexpr int cells_of_100k = 224; // 100,352 triangles
constexpr int cells_of_7k = 60;    // of a bicubic patch in the view

/// A new angle each frame, as when turning.
render::Camera turned(const render::Camera& camera, int frame) {
    return camera.orbited(0.01 * frame, 0.0);
}

enum Light { unlit, lit };
enum Color { plain, by_value };

void mesh(benchmark::State& state) {
    const render::OffscreenContext context(pane);
    const render::Painter painter;
    const TessellatedDome model = dome(static_cast<int>(state.range(3)));
    const render::MeshBuffer buffer(model.vertices, model.triangles);
    const render::Camera camera = render::Camera().fitted(model.outline, render::aspect(pane));
    const render::ViewColors colors = render::view_colors(render::Theme::dark);
    render::MeshStyle style;
    style.lit = state.range(1) == lit;
    if (state.range(2) == by_value) {
        style.coloring.from = render::ColorFrom::value;
        style.coloring.scale.high = 80.0;
    }
    render::ViewTarget target(static_cast<int>(state.range(0)));
    render::Bounds bounds;
    for (const glm::dvec3& point : model.outline) {
        bounds = united(bounds, point);
    }
    int frame = 0;
    for (auto _ : state) {
        target.begin(pane);
        painter.background(colors);
        painter.mesh(buffer, style, turned(camera, ++frame).view(pane, bounds));
        target.end();
        glFinish();
    }
    state.counters["triangles"] = static_cast<double>(model.triangles.size() / 3);
}

void upload_100k(benchmark::State& state) {
    const render::OffscreenContext context(pane);
    const TessellatedDome model = dome(cells_of_100k);
    for (auto _ : state) {
        const render::MeshBuffer buffer(model.vertices, model.triangles);
        glFinish();
    }
}

void background(benchmark::State& state) {
    const render::OffscreenContext context(pane);
    const render::Painter painter;
    render::ViewTarget target(static_cast<int>(state.range(0)));
    for (auto _ : state) {
        target.begin(pane);
        painter.background(render::view_colors(render::Theme::dark));
        target.end();
        glFinish();
    }
}

void view(benchmark::State& state) {
    const render::OffscreenContext context(pane);
    const std::filesystem::path assets = project::assets_folder();
    const project::Project project = project::read_project(assets / "projects/dome.json");
    const plan::Plan plan =
        plan::make_plan(project, {assets / "projects", assets}, Progress(), plan::Scope::program);
    const auto kind = static_cast<ViewKind>(state.range(1));
    SceneView drawn;
    drawn.update(scene_of(project, plan, kind));
    const render::Camera camera = render::Camera().fitted(drawn.outline(), render::aspect(pane));
    const render::ViewColors colors = render::view_colors(render::Theme::dark);
    render::ViewTarget target(static_cast<int>(state.range(0)));
    int frame = 0;
    for (auto _ : state) {
        target.begin(pane);
        drawn.draw(turned(camera, ++frame).view(pane, drawn.depth_range()), colors, {});
        target.end();
        glFinish();
    }
    state.SetLabel(std::string(id(kind)));
}

std::size_t triangle_count(const ArmLook& look) {
    std::size_t count = 0;
    for (const geometry::SolidBody& body : look.bodies) {
        for (const geometry::SolidMesh& mesh : body.meshes) {
            count += mesh.triangles.size();
        }
    }
    return count;
}

/// Cuts each triangle into three until there are `wanted`.
void refine(ArmLook& look, std::size_t wanted) {
    std::size_t count = triangle_count(look);
    while (count < wanted) {
        for (geometry::SolidBody& body : look.bodies) {
            for (geometry::SolidMesh& mesh : body.meshes) {
                const std::size_t before = mesh.triangles.size();
                for (std::size_t n = 0; n < before && count < wanted; ++n, count += 2) {
                    const auto [a, b, c] = mesh.triangles[n];
                    const auto at = [](const auto& list, int k) { return list[static_cast<std::size_t>(k)]; };
                    const auto middle = static_cast<int>(mesh.positions.size());
                    const Vec3 place =
                        (at(mesh.positions, a) + at(mesh.positions, b) + at(mesh.positions, c)) / 3.0;
                    const Vec3 normal = at(mesh.normals, a);
                    mesh.positions.push_back(place);
                    mesh.normals.push_back(normal);
                    mesh.triangles[n] = {a, b, middle};
                    mesh.triangles.push_back({b, c, middle});
                    mesh.triangles.push_back({c, a, middle});
                }
            }
        }
    }
}

/// The arm of 100,000 triangles with a path and a trace of 10,000 points, its base turning.
void arm(benchmark::State& state) {
    const render::OffscreenContext context(pane);
    const auto look = std::make_shared<ArmLook>(
        *read_arm_look(project::arm_path("motoman-l3", ".", project::assets_folder())));
    refine(*look, 100'000);
    constexpr int points = 10'000;
    auto track = std::make_shared<ArmTrack>();
    for (int n = 0; n < points; ++n) {
        const double share = static_cast<double>(n) / points;
        track->tips.emplace_back(700.0 + 200.0 * std::cos(400.0 * share), 400.0 * (share - 0.5), 300.0);
        track->troubles.push_back(n % 100 < 90 ? arm::ArmTrouble::none : arm::ArmTrouble::out_of_reach);
    }
    Scene scene;
    scene.layers = layers_of_arm();
    scene.arm = ArmScene{};
    scene.arm->look = look;
    scene.arm->joints = arm::arm_home();
    scene.arm->track = track;
    scene.arm->trace = std::make_shared<const std::vector<Vec3>>(track->tips);
    SceneView drawn;
    drawn.update(scene);
    const render::Camera camera = render::Camera().fitted(drawn.outline(), render::aspect(pane));
    const render::ViewColors colors = render::view_colors(render::Theme::dark);
    render::ViewTarget target(static_cast<int>(state.range(0)));
    int frame = 0;
    for (auto _ : state) {
        scene.arm->joints[0] = 0.001 * ++frame;
        drawn.update(scene);
        target.begin(pane);
        const render::Edges edges = state.range(0) == 1 ? render::Edges::rough : render::Edges::smooth;
        drawn.draw(turned(camera, frame).view(pane, drawn.depth_range()), colors, {}, edges);
        target.end();
        glFinish();
    }
    state.counters["triangles"] = static_cast<double>(triangle_count(*look));
}

BENCHMARK(mesh)
    ->ArgNames({"samples", "lit", "by_value", "cells"})
    ->ArgsProduct({{1, 4}, {unlit, lit}, {plain, by_value}, {cells_of_7k, cells_of_100k}})
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(upload_100k)->UseRealTime()->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
BENCHMARK(background)
    ->ArgName("samples")
    ->Arg(1)
    ->Arg(4)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(arm)->ArgName("samples")->Arg(1)->Arg(4)->UseRealTime()->MeasureProcessCPUTime()->Unit(
    benchmark::kMillisecond);
BENCHMARK(view)
    ->ArgNames({"samples", "kind"})
    ->ArgsProduct({{1, 4}, {0, 1, 2, 3, 4}})
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace millwright::viewport
