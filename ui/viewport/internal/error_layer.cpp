// The path that the machine really takes, each move coloured by its error; on request the whole surface by
// the errors around each place. Moves between tracks do not cut, so they are only hinted at. While stepping,
// what is still to come is dim.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/error_surface.h"
#include "ui/viewport/internal/layers.h"

#include <algorithm>

namespace millwright::viewport {

namespace {

constexpr float remaining_error_opacity = 0.6F;
constexpr double deepest_share = 0.05; // of the content's radius: deeper under the surface, the way is hidden

using toolpath::MoveKind;

PathLines actual_lines(const plan::CuttingSetup& cutting_setup,
                       const plan::Evaluation& shown,
                       MoveKind kind,
                       int steps) {
    return PathLines(static_cast<int>(shown.field.moves.size()), [&](int move) -> PathLines::Move {
        const toolpath::MoveDeviation& deviation = shown.field.moves[static_cast<std::size_t>(move)];
        if (deviation.kind != kind) {
            return {};
        }
        return {.points = actual_tips(cutting_setup, shown, move, steps),
                .value = static_cast<float>(deviation.closest),
                .dashed = kind == MoveKind::cross};
    });
}

class ErrorLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (scene.layers.path.errors) {
            update_path(scene);
        }
        if (scene.layers.colored.errors && !of_surface_.same(scene)) {
            of_surface_.follow(scene);
            surface_ = of_surface_.complete() ? error_surface(*scene.cutting_setup, *scene.shown)
                                              : render::MeshBuffer();
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        const render::Coloring by_error = {.from = render::ColorFrom::value,
                                           .scale = error_colors(scene, canvas.colors.over_limit)};
        if (surface_colors(scene) == SurfaceColors::error) {
            canvas.painter.mesh(
                surface_,
                {.coloring = by_error, .model = canvas.s_T_w, .back_color = {}, .highlight = 0.05F},
                canvas.view);
        }
        if (!scene.layers.path.errors) {
            return;
        }
        // Where the tool gouges, its way lies under the surface.
        const double lift =
            scene.shown ? std::min(scene.shown->closest.max, deepest_share * radius(canvas.content)) : 0.0;
        const render::View view = nearer(canvas, lift);
        render::LineStyle style = {.coloring = by_error, .model = canvas.s_T_w, .width_px = 3.0F};
        draw_moves(scene, canvas, tracks_, style, view);
        draw_move(canvas, tracks_, canvas.highlight.move, style, view);
        style.coloring = {.color = with_opacity(canvas.colors.rapid, 0.6F)};
        style.width_px = 1.0F;
        draw_moves(scene, canvas, crossings_, style, view);
    }

private:
    /// Which results a buffer was made from.
    struct Made {
        std::shared_ptr<const plan::Evaluation> shown;
        std::shared_ptr<const plan::CuttingSetup> cutting_setup;

        [[nodiscard]] bool same(const Scene& scene) const {
            return shown == scene.shown && cutting_setup == scene.cutting_setup;
        }
        void follow(const Scene& scene) {
            shown = scene.shown;
            cutting_setup = scene.cutting_setup;
        }
        [[nodiscard]] bool complete() const { return shown && cutting_setup; }
    };

    void update_path(const Scene& scene) {
        if (of_path_.same(scene)) {
            return;
        }
        of_path_.follow(scene);
        tracks_ = {};
        crossings_ = {};
        if (of_path_.complete()) {
            const int steps = std::max(smooth_steps(static_cast<int>(scene.shown->field.moves.size())), 2);
            tracks_ = actual_lines(*scene.cutting_setup, *scene.shown, MoveKind::track, steps);
            crossings_ = actual_lines(*scene.cutting_setup, *scene.shown, MoveKind::cross, 2 * steps - 1);
        }
    }

    static void draw_moves(const Scene& scene,
                           const Canvas& canvas,
                           const PathLines& lines,
                           render::LineStyle style,
                           const render::View& view) {
        const int done = segments_done(lines, scene.now);
        style.coloring.opacity = remaining_error_opacity;
        style.first = done;
        canvas.painter.lines(lines.buffer(), style, view);
        style.coloring.opacity = 1.0F;
        style.first = 0;
        style.count = done;
        draw_seamed(canvas, lines.buffer(), style, view);
    }

    Made of_path_;
    PathLines tracks_;
    PathLines crossings_;
    Made of_surface_;
    render::MeshBuffer surface_;
};

} // namespace

std::unique_ptr<Layer> make_error_layer() {
    return std::make_unique<ErrorLayer>();
}

} // namespace millwright::viewport
