#include "ui/viewport/viewport.h"

#include "ui/viewport/internal/legends.h"
#include "ui/viewport/internal/view_controls.h"
#include "ui/viewport/internal/view_pane.h"
#include "ui/widgets/icons.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace millwright::viewport {

namespace {

using render::Projection;
using render::StandardView;
using widgets::Rect;

constexpr float pane_gap = 2.0F;  // between four pictures
constexpr int buttons_of_one = 4; // with the one more of next_button()
constexpr int buttons_of_two = 3;

std::array<ViewPane, 4> make_panes() {
    return {ViewPane("top", "Top", StandardView::top, Projection::orthographic),
            ViewPane("iso", "", StandardView::iso, Projection::perspective),
            ViewPane("front", "Front", StandardView::front, Projection::orthographic),
            ViewPane("right", "Right", StandardView::right, Projection::orthographic)};
}

std::array<ViewPane, 2> make_pair() {
    return {ViewPane("left", "", StandardView::iso, Projection::perspective),
            ViewPane("right", "", StandardView::iso, Projection::perspective)};
}

constexpr std::size_t isometric_pane = 1; // the picture that is alone where there is one

/// The quarter of `place` in that row and column.
Rect quarter(const Rect& place, int row, int column, float space) {
    const float w = std::floor(0.5F * (place.w - space));
    const float h = std::floor(0.5F * (place.h - space));
    return {place.x + (column == 0 ? 0.0F : w + space),
            place.y + (row == 0 ? 0.0F : h + space),
            column == 0 ? w : place.w - w - space,
            row == 0 ? h : place.h - h - space};
}

/// In a strip below two pictures, which have the same colours; gives the height that is left to these.
float draw_shared_legends(widgets::Ui& ui,
                          const Rect& place,
                          const Scene& scene,
                          const Scene& beside,
                          const render::ViewColors& colors) {
    const float margin = ui.px(8.0F);
    const LegendPlaces places = lying_legends(ui, place, place.x + margin, scene);
    draw_legends(ui, places, colors, scene, &beside);
    return places.free.h;
}

} // namespace

/// What the left one of two scenes is drawn with.
struct OtherScene {
    SceneView view;
    SurfacePicker picker;
};

struct Viewport::State {
    SceneView view;
    SurfacePicker picker;
    std::array<ViewPane, 4> panes = make_panes();
    std::array<ViewPane, 2> pair = make_pair(); ///< for two scenes
    int sight = 0;                              ///< of the scene that is looked at
    std::set<int> paired_sights;                ///< those that were two scenes when they were last seen
    std::unique_ptr<OtherScene> other;          ///< null before two scenes were drawn
    std::size_t active = isometric_pane;        ///< last worked in
    Arrangement arrangement = Arrangement::one;
    UnderMouse under_mouse;
    widgets::Point next_button;
    bool dragging = false;

    std::vector<ViewEvent> draw_pane(const Frame3D& frame, std::size_t k, const Rect& place) {
        ViewPane& pane = panes[k];
        std::vector<ViewEvent> events = pane.draw(frame, place);
        if (pane.in_use()) {
            active = k;
            under_mouse = pane.mouse_tool().under_mouse();
        }
        dragging = dragging || pane.mouse_tool().drag().has_value();
        return events;
    }

    [[nodiscard]] bool paired() const { return paired_sights.contains(sight); }
    void look_at(const Scene& scene) {
        sight = scene.sight;
        for (ViewPane& pane : panes) {
            pane.look_at(scene);
        }
        for (ViewPane& pane : pair) {
            pane.look_at(scene);
        }
    }

    [[nodiscard]] ViewPane& now() { return paired() ? pair[1] : panes[active]; }
    [[nodiscard]] const ViewPane& now() const { return paired() ? pair[1] : panes[active]; }

    /// One of two scenes.
    std::vector<ViewEvent> draw_of_two(const Frame3D& frame, std::size_t k, const Rect& place) {
        const auto scope = frame.ui.scope(pair[k].id());
        return pair[k].draw(frame, place);
    }

    /// Buttons below the axes of the picture at `place`.
    void draw_buttons(widgets::Ui& ui, const Rect& place) {
        const Rect all = view_controls(ui, place, paired() ? buttons_of_two : buttons_of_one).buttons;
        ImGui::GetWindowDrawList()->AddRectFilled({all.x, all.y},
                                                  {all.right(), all.bottom()},
                                                  widgets::faded(ui.colours().pane, 0.88),
                                                  ui.px(widgets::gaps::rounding));
        ImVec2 at = {all.x, all.y};
        const auto button = [&](const char* id, const char* icon, const char* tip, bool chosen) {
            ImGui::SetCursorScreenPos(at);
            at.y += ui.px(view_button_px);
            return ui.icon_button(id, icon, tip, {}, chosen);
        };
        const bool flat = now().camera().pose().projection != Projection::perspective;
        const bool four = arrangement == Arrangement::four;
        bool changed = false;
        if (button("fit", widgets::icons::fit_view, "Zoom to fit (F)", false)) {
            fit();
            changed = true;
        }
        if (button("parallel", widgets::icons::projection, "Orthographic / perspective (P)", flat)) {
            set_projection(flat ? Projection::perspective : Projection::orthographic);
            changed = true;
        }
        if (!paired() &&
            button("four", widgets::icons::grid, "Four views: top, front, right and isometric", four)) {
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
            for (ViewPane& pane : panes) {
                pane.fit_all();
            }
        }
    }

    void fit() {
        for (ViewPane& pane : panes) {
            pane.fit();
        }
        pair[1].fit();
    }

    void set_projection(Projection projection) {
        now().set_camera(now().camera().with(projection));
        pair[0].set_camera(pair[1].camera());
    }
};

Viewport::Viewport() : state_(std::make_unique<State>()) {}

Viewport::~Viewport() = default;

std::vector<ViewEvent> Viewport::draw(widgets::Ui& ui, const Rect& place, const Scene& scene) {
    State& state = *state_;
    state.look_at(scene);
    if (state.paired_sights.erase(scene.sight) > 0) {
        state.fit();
    }
    state.view.update(scene);
    state.picker.follow(scene.surface);
    state.under_mouse = {};
    state.dragging = false;
    Frame3D frame = {.ui = ui,
                     .scene = scene,
                     .view = state.view,
                     .picker = state.picker,
                     .colors = render::view_colors(theme_of(ui), scene.colors),
                     .buttons = buttons_of_one};
    if (state.arrangement == Arrangement::one) {
        state.active = isometric_pane;
        std::vector<ViewEvent> events = state.draw_pane(frame, isometric_pane, place);
        state.draw_buttons(ui, place);
        return events;
    }
    std::vector<ViewEvent> all;
    for (std::size_t k = 0; k < state.panes.size(); ++k) {
        const auto scope = ui.scope(state.panes[k].id());
        const Rect part = quarter(place, static_cast<int>(k / 2), static_cast<int>(k % 2), ui.px(pane_gap));
        frame.details = k == isometric_pane;
        for (ViewEvent& event : state.draw_pane(frame, k, part)) {
            all.push_back(std::move(event));
        }
    }
    state.draw_buttons(ui, quarter(place, 0, 1, ui.px(pane_gap)));
    return all;
}

std::vector<ViewEvent>
Viewport::draw_two(widgets::Ui& ui, const Rect& place, const Named& left, const Named& right) {
    State& state = *state_;
    if (!state.other) {
        state.other = std::make_unique<OtherScene>();
    }
    state.look_at(right.scene);
    state.pair[0].look_at(left.scene);
    if (state.paired_sights.insert(right.scene.sight).second) { // turned as before, but narrower
        state.pair[1].set_camera(state.panes[isometric_pane].camera());
        state.pair[1].fit();
    }
    state.view.update(right.scene);
    state.picker.follow(right.scene.surface);
    state.other->view.update(left.scene);
    state.other->picker.follow(left.scene.surface);
    state.under_mouse = {};
    state.dragging = false;
    state.pair[0].set_caption(left.caption);
    state.pair[1].set_caption(right.caption);
    const render::ViewColors colors = render::view_colors(theme_of(ui), right.scene.colors);
    const float space = ui.px(pane_gap);
    const float w = std::floor(0.5F * (place.w - space));
    const float h = draw_shared_legends(ui, place, right.scene, left.scene, colors);
    const Rect right_place{place.x + w + space, place.y, place.w - w - space, h};
    const Frame3D of_right{.ui = ui,
                           .scene = right.scene,
                           .view = state.view,
                           .picker = state.picker,
                           .colors = colors,
                           .buttons = buttons_of_two,
                           .legends = false,
                           .also = &state.other->view};
    std::vector<ViewEvent> events = state.draw_of_two(of_right, 1, right_place);
    if (state.pair[1].in_use()) {
        state.under_mouse = state.pair[1].mouse_tool().under_mouse();
    }
    state.dragging = state.pair[1].mouse_tool().drag().has_value();
    const Frame3D of_left{.ui = ui,
                          .scene = left.scene,
                          .view = state.other->view,
                          .picker = state.other->picker,
                          .colors = colors,
                          .details = false};
    if (!state.pair[0].in_use()) {
        state.pair[0].set_camera(state.pair[1].camera());
    }
    (void)state.draw_of_two(of_left, 0, {place.x, place.y, w, h});
    if (state.pair[0].in_use() && !(state.pair[0].camera().pose() == state.pair[1].camera().pose())) {
        state.pair[1].set_camera(state.pair[0].camera());
        ui.change_in(0.0);
    }
    state.panes[isometric_pane].set_camera(state.pair[1].camera());
    state.draw_buttons(ui, right_place);
    return events;
}

void Viewport::look_at(const Scene& scene) {
    state_->look_at(scene);
}

void Viewport::fit() {
    state_->fit();
}

void Viewport::fit_unturned() {
    for (ViewPane& pane : state_->panes) {
        pane.fit_unturned();
    }
    for (ViewPane& pane : state_->pair) {
        pane.fit_unturned();
    }
}

void Viewport::look_from(StandardView side) {
    ViewPane& pane = state_->now();
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
    return state_->now().camera();
}

void Viewport::set_camera(const render::Camera& camera) {
    state_->now().set_camera(camera);
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
