// The whole window: lays out the panes, draws every panel, hands shortcuts and requests to the app
// controller. Knows neither GLFW nor files: the app runs it in a window, tests and pictures run it in memory.
#pragma once

#include "ui/actions/app_controller.h"
#include "ui/arm_panels/arm_jog_panel.h"
#include "ui/arm_panels/arm_panel.h"
#include "ui/design_panels/design_panel.h"
#include "ui/design_panels/grid_panel.h"
#include "ui/machine_panels/jog_gate.h"
#include "ui/machine_panels/machine_panel.h"
#include "ui/plot_panels/plot_panel.h"
#include "ui/processor_panels/processor_panel.h"
#include "ui/toolpath_panels/listing_panel.h"
#include "ui/toolpath_panels/program_panel.h"
#include "ui/toolpath_panels/toolpath_panel.h"
#include "ui/widgets/notices.h"
#include "ui/widgets/search.h"
#include "ui/window/dialogs.h"
#include "ui/window/lower_panel.h"
#include "ui/window/menu_bar.h"
#include "ui/window/outline_panel.h"
#include "ui/window/timeline_panel.h"
#include "ui/window/view_panel.h"

namespace millwright::panels {

class Window {
public:
    explicit Window(actions::AppController& app);

    /// One frame of `width` x `height` pixels between Ui::begin_frame and end_frame: draws, then performs
    /// what was asked.
    /// `focused`: the window has the keyboard.
    void draw(Ui& ui, float width, float height, bool focused = true);

    /// Seconds until the picture changes without input; empty: only when something happens.
    [[nodiscard]] std::optional<double> next_change() const;

    [[nodiscard]] ViewPanel& view() { return view_; }

private:
    struct Layout;
    [[nodiscard]] Layout
    layout(const Ui& ui, const actions::ViewState& view_state, float width, float height) const;
    [[nodiscard]] static bool no_jog(const FrameState& now);
    void draw_panes(Ui& ui, const FrameState& now, const Layout& layout);
    void draw_emergency_stop(Ui& ui, const FrameState& now);
    [[nodiscard]] static widgets::Rect below_alarm(Ui& ui, const FrameState& now, const widgets::Rect& view);
    void draw_middle(Ui& ui, const FrameState& now, const Layout& place);
    void draw_left(Ui& ui, const FrameState& now, const widgets::Rect& place);
    void draw_inspector(Ui& ui, const FrameState& now);
    void draw_splitters(Ui& ui, const FrameState& now, const Layout& layout, float width, float height);
    void draw_over(Ui& ui, const FrameState& now, const widgets::Rect& view);
    void obey_shortcuts(const Ui& ui, const FrameState& now);
    void forget_machine_notices(const FrameState& now);

    struct MachineSeen { ///< in the frame before
        bool connected = false, alarm = false, job = false;
    };

    actions::AppController& app_;
    ActionQueue ask_;
    MenuBar menu_bar_;
    OutlinePanel outline_;
    ListingPanel listing_;
    DesignPanel design_;
    GridPanel grid_;
    ToolpathPanel toolpath_;
    ProgramPanel program_;
    MachinePanel machine_;
    ArmPanel arm_;
    ArmJogPanel arm_jog_;
    ProcessorPanel processor_;
    PlotPanel plot_;
    LowerPanel lower_;
    TimelinePanel timeline_;
    Dialogs dialogs_;
    ViewPanel view_;
    widgets::Toasts toasts_;
    MachineSeen machine_seen_;
    widgets::Search search_;
    JogGate jog_gate_;
};

} // namespace millwright::panels
