// The produced surface: the true path of the tool with straight lines from track to track, as a surface with
// its lines along u and v. Source: Parasilmongkol 1997, figure 6-17.

#include "core/toolpath/actual_trajectory.h"
#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::viewport {

namespace {

using toolpath::ProducedSurface;

constexpr int most_produced_lines = 60;              // of one direction: more run together
constexpr std::size_t most_produced_points = 400000; // that are drawn quickly

/// Even, so that the middle of each move is there.
int steps_per_move(std::size_t moves) {
    constexpr int finest = 8;
    const std::size_t room = most_produced_points / std::max<std::size_t>(moves, 1);
    return std::clamp(2 * static_cast<int>(room / 2), 2, finest);
}

glm::vec3 produced_corner(const ProducedSurface& surface, int track, int place) {
    return render::to_float(
        surface.at(std::clamp(track, 0, surface.tracks - 1), std::clamp(place, 0, surface.places - 1)));
}

/// Across the neighbours; towards the tool.
glm::vec3 normal_at(const ProducedSurface& surface, int track, int place, float side) {
    const glm::vec3 along =
        produced_corner(surface, track, place + 1) - produced_corner(surface, track, place - 1);
    const glm::vec3 across =
        produced_corner(surface, track + 1, place) - produced_corner(surface, track - 1, place);
    return side * glm::cross(across, along);
}

/// `side`: 1 where growing tracks and places turn counterclockwise seen from the tool, else -1.
render::MeshBuffer produced_mesh(const ProducedSurface& surface, float side) {
    std::vector<render::MeshVertex> vertices;
    std::vector<std::uint32_t> triangles;
    for (int t = 0; t < surface.tracks; ++t) {
        for (int p = 0; p < surface.places; ++p) {
            vertices.push_back(
                {.position = produced_corner(surface, t, p), .normal = normal_at(surface, t, p, side)});
        }
    }
    const auto index = [&](int t, int p) { return static_cast<std::uint32_t>(t * surface.places + p); };
    for (int t = 0; t + 1 < surface.tracks; ++t) {
        for (int p = 0; p + 1 < surface.places; ++p) {
            std::array<std::uint32_t, 4> cell{
                index(t, p), index(t + 1, p), index(t + 1, p + 1), index(t, p + 1)};
            if (side < 0.0F) {
                std::swap(cell[1], cell[3]);
            }
            triangles.insert(triangles.end(), {cell[0], cell[1], cell[2], cell[0], cell[2], cell[3]});
        }
    }
    return {vertices, triangles};
}

std::vector<int> spread_numbers(int count, int each) {
    std::vector<int> numbers;
    for (int n = 0; n + 1 < count; n += each) {
        numbers.push_back(n);
    }
    numbers.push_back(count - 1);
    return numbers;
}

render::LineBuffer produced_lines_along(const ProducedSurface& surface) {
    std::vector<render::LineVertex> vertices;
    for (const int t : spread_numbers(surface.tracks, 1 + surface.tracks / most_produced_lines)) {
        std::vector<Vec3> track;
        for (int p = 0; p < surface.places; ++p) {
            track.push_back(surface.at(t, p));
        }
        append(vertices, track);
    }
    return {vertices, render::LineTopology::segments};
}

/// Through the nodes.
render::LineBuffer produced_lines_across(const ProducedSurface& surface, int steps) {
    std::vector<render::LineVertex> vertices;
    const int moves = (surface.places - 1) / steps;
    for (const int p : spread_numbers(surface.places, steps * (1 + moves / most_produced_lines))) {
        std::vector<Vec3> line;
        for (int t = 0; t < surface.tracks; ++t) {
            line.push_back(surface.at(t, p));
        }
        append(vertices, line);
    }
    return {vertices, render::LineTopology::segments};
}

class ProducedLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (!scene.layers.design.produced ||
            (scene.shown == shown_ && scene.cutting_setup == cutting_setup_)) {
            return;
        }
        shown_ = scene.shown;
        cutting_setup_ = scene.cutting_setup;
        mesh_ = {};
        along_ = {};
        across_ = {};
        outline_.clear();
        if (shown_ && cutting_setup_) {
            rebuild();
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.layers.design.produced) {
            return;
        }
        const render::ViewColors& colors = canvas.colors;
        const glm::vec3 plain =
            render::color_of(colors, render::LayerColor::produced).value_or(colors.surface);
        canvas.painter.mesh(mesh_,
                            {.coloring = {.color = with_opacity(plain, 1.0F)},
                             .model = canvas.s_T_w,
                             .back_color = glm::mix(plain, colors.surface_back, 0.5F)},
                            canvas.view);
        const bool tracks_along_u =
            cutting_setup_ && cutting_setup_->direction == grid::TrackDirection::along_u;
        const auto of_u = line_color(colors, render::LayerColor::produced_u);
        const auto of_v = line_color(colors, render::LayerColor::produced_v);
        render::LineStyle line = {.model = canvas.s_T_w, .width_px = 1.0F};
        line.coloring.color = tracks_along_u ? of_v : of_u;
        canvas.painter.lines(across_, line, canvas.view);
        line.coloring.color = tracks_along_u ? of_u : of_v;
        canvas.painter.lines(along_, line, canvas.view);
    }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        return scene.layers.design.produced ? moved(outline_, scene_from_workpiece(scene))
                                            : std::vector<glm::dvec3>{};
    }

private:
    static glm::vec4 line_color(const render::ViewColors& colors, render::LayerColor which) {
        const auto& chosen = colors.chosen.of(which);
        return chosen ? with_opacity(*chosen, 1.0F) : with_opacity(colors.wire, 0.55F);
    }

    void rebuild() {
        const int steps = steps_per_move(shown_->toolpath.points.size());
        const auto surface =
            toolpath::produced_surface(cutting_setup_->machine, shown_->toolpath, shown_->axes, steps);
        if (!surface) {
            return;
        }
        // Growing u and v turn counterclockwise seen from the side of S_u x S_v.
        const bool turns =
            (cutting_setup_->direction == grid::TrackDirection::along_v) != cutting_setup_->flipped;
        mesh_ = produced_mesh(*surface, turns ? 1.0F : -1.0F);
        along_ = produced_lines_along(*surface);
        across_ = produced_lines_across(*surface, steps);
        constexpr std::size_t stride = 7; // of the points: the view need not be fitted to all
        for (std::size_t n = 0; n < surface->points.size(); n += stride) {
            outline_.push_back(surface->points[n]);
        }
    }

    std::shared_ptr<const plan::Evaluation> shown_;
    std::shared_ptr<const plan::CuttingSetup> cutting_setup_;
    render::MeshBuffer mesh_;
    render::LineBuffer along_, across_;
    std::vector<Vec3> outline_;
};

} // namespace

std::unique_ptr<Layer> make_produced_layer() {
    return std::make_unique<ProducedLayer>();
}

} // namespace millwright::viewport
