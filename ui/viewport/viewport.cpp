#include "ui/viewport/viewport.h"

#include "ui/viewport/internal/axis_gizmo.h"
#include "ui/viewport/internal/view_pane.h"
#include "ui/widgets/icons.h"

#include <imgui.h>

#include <array>
#include <cmath>

namespace millwright::viewport {

namespace {

using render::Projection;
using render::StandardView;
using widgets::Rect;

constexpr float gap = 2.0F; // between four pictures
constexpr float button_px = 28.0F;

std::array<ViewPane, 4> make_panes() {
    return {ViewPane("top", "Top", StandardView::top, Projection::orthographic),
            ViewPane("iso", "", StandardView::iso, Projection::perspective),
            ViewPane("front", "Front", StandardView::front, Projection::orthographic),
            ViewPane("right", "Right", StandardView::right, Projection::orthographic)};
}

constexpr std::size_t iso = 1; // the picture that is alone where there is one

/// The quarter of `place` in that row and column.
Rect quarter(const Rect& place, int row, int column, float space) {
    const float w = std::floor(0.5F * (place.w - space));
    const float h = std::floor(0.5F * (place.h - space));
    return {place.x + (column == 0 ? 0.0F : w + space),
            place.y + (row == 0 ? 0.0F : h + space),
            column == 0 ? w : place.w - w - space,
            row == 0 ? h : place.h - h - space};
}

} // namespace

struct Viewport::State {
    SceneView view;
    SurfacePicker picker;
    std::array<ViewPane, 4> panes = make_panes();
    std::size_t active = iso; ///< last worked in
    Arrangement arrangement = Arrangement::one;
    UnderMouse under_mouse;
    widgets::Point next_button;
    bool dragging = false;

    std::vector<ViewEvent> draw_pane(const Frame3D& frame, std::size_t k, const Rect& place) {
        ViewPane& pane = panes[k];
        std::vector<ViewEvent> events = pane.draw(frame, place);
        if (pane.in_use()) {
            active = k;
            under_mouse = pane.hand().under_mouse();
        }
        dragging = dragging || pane.hand().drag().has_value();
        return events;
    }

    /// Buttons below the axes of the picture at `place`.
    void draw_buttons(widgets::Ui& ui, const Rect& place) {
        ImVec2 at = {place.right() - ui.px(8.0F + 0.5F * (gizmo_size + button_px)),
                     place.y + ui.px(12.0F + gizmo_size)};
        const auto button = [&](const char* id, const char* icon, const char* tip, bool chosen) {
            ImGui::SetCursorScreenPos(at);
            at.y += ui.px(button_px);
            return ui.icon_button(id, icon, tip, {}, chosen);
        };
        const bool flat = panes[active].camera().pose().projection == Projection::orthographic;
        const bool four = arrangement == Arrangement::four;
        bool changed = false;
        if (button("fit", widgets::icons::fit_view, "Fit everything in the view (F)", false)) {
            fit();
            changed = true;
        }
        if (button("parallel", widgets::icons::projection, "Parallel lines stay parallel (P)", flat)) {
            set_projection(flat ? Projection::perspective : Projection::orthographic);
            changed = true;
        }
        if (button("four", widgets::icons::grid, "Four views: top, front, right and free", four)) {
            arrange(four ? Arrangement::one : Arrangement::four);
            changed = true;
        }
        if (changed) {
            ui.change_in(0.0);
        }
        next_button = {at.x, at.y};
    }

    void arrange(Arrangement wanted) {
        if (wanted != arrangement) {
            arrangement = wanted;
            fit();
        }
    }

    void fit() {
        for (ViewPane& pane : panes) {
            pane.fit();
        }
    }

    void set_projection(Projection projection) {
        panes[active].set_camera(panes[active].camera().with(projection));
    }
};

Viewport::Viewport() : state_(std::make_unique<State>()) {}

Viewport::~Viewport() = default;

std::vector<ViewEvent> Viewport::draw(widgets::Ui& ui, const Rect& place, const Scene& scene) {
    State& state = *state_;
    state.view.update(scene);
    state.picker.follow(scene.surface);
    state.under_mouse = {};
    state.dragging = false;
    Frame3D frame = {.ui = ui,
                     .scene = scene,
                     .view = state.view,
                     .picker = state.picker,
                     .colors = render::view_colors(theme_of(ui))};
    if (state.arrangement == Arrangement::one) {
        state.active = iso;
        std::vector<ViewEvent> events = state.draw_pane(frame, iso, place);
        state.draw_buttons(ui, place);
        return events;
    }
    std::vector<ViewEvent> all;
    for (std::size_t k = 0; k < state.panes.size(); ++k) {
        const auto scope = ui.scope(state.panes[k].id());
        const Rect part = quarter(place, static_cast<int>(k / 2), static_cast<int>(k % 2), ui.px(gap));
        frame.details = k == iso;
        for (ViewEvent& event : state.draw_pane(frame, k, part)) {
            all.push_back(std::move(event));
        }
    }
    state.draw_buttons(ui, quarter(place, 0, 1, ui.px(gap)));
    return all;
}

void Viewport::fit() {
    state_->fit();
}

void Viewport::look_from(StandardView side) {
    ViewPane& pane = state_->panes[state_->active];
    pane.set_camera(pane.camera().seen_from(side));
    pane.fit();
}

void Viewport::set_projection(Projection projection) {
    state_->set_projection(projection);
}

void Viewport::set_arrangement(Arrangement arrangement) {
    state_->arrange(arrangement);
}

Arrangement Viewport::arrangement() const {
    return state_->arrangement;
}

const render::Camera& Viewport::camera() const {
    return state_->panes[state_->active].camera();
}

void Viewport::set_camera(const render::Camera& camera) {
    state_->panes[state_->active].set_camera(camera);
}

const UnderMouse& Viewport::under_mouse() const {
    return state_->under_mouse;
}

widgets::Point Viewport::next_button() const {
    return state_->next_button;
}

bool Viewport::dragging() const {
    return state_->dragging;
}

} // namespace millwright::viewport
