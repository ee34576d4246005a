// The 3D view in the window: what it shows comes from the frame's state, what is done in it becomes actions.
#pragma once

#include "ui/panels/panel.h"
#include "ui/viewport/viewport.h"

#include <map>
#include <memory>
#include <optional>

namespace millwright::panels {

class ViewPanel {
public:
    /// `catalogue` must outlive it.
    explicit ViewPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}

    /// Into `place` of the current pane.
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask, const widgets::Rect& place);

    /// The surface point under the mouse, workpiece coordinates, mm.
    [[nodiscard]] std::optional<Vec3> under_mouse() const { return view_.under_mouse().on_surface; }
    [[nodiscard]] viewport::Viewport& viewport() { return view_; }

private:
    void fit(const FrameState& now, ActionQueue& ask);
    void fit_set_up(const viewport::Scene& shown);
    void fit_file(const FrameState& now, ActionQueue& ask);
    void fit_plot(const FrameState& now, ActionQueue& ask);
    void look_from(render::StandardView side, ActionQueue& ask);
    void follow_plot(const plan::PlotResult& made);

    const actions::Catalogue& catalogue_;
    viewport::Viewport view_;
    std::map<int, std::shared_ptr<const plan::SetUpResult>> set_ups_; ///< whose map was seen, by Scene::sight
    bool growing_ = false;    ///< an opened file was fitted before all of it was there
    Box3 plot_box_;           ///< where a plot lay when its view was fitted
    bool showed_arm_ = false; ///< when the Machine workspace was seen last
};

/// What the view shows of the frame's state.
[[nodiscard]] viewport::Scene scene_of(const FrameState& now);

/// The arm is shown in place of everything else.
[[nodiscard]] bool shows_arm(const FrameState& now);

/// A surface that is being imported stands there in place of the project's, once it is read.
[[nodiscard]] bool shows_import(const FrameState& now);

/// Turns what was done in the view into requests.
void obey(const viewport::ViewEvent& event, const FrameState& now, ActionQueue& ask);

} // namespace millwright::panels
