#include "ui/window/window.h"

#include "ui/actions/shortcut.h"
#include "ui/actions/synonyms.h"
#include "ui/machine_panels/manual_fields.h"
#include "ui/panels/fields.h"
#include "ui/processor_panels/processor_diagram.h"
#include "ui/render/imgui_compat.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/splitter.h"
#include "ui/window/status_bar.h"
#include "ui/workspaces/arm_workspace.h"
#include "ui/workspaces/processor_workspace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace millwright::panels {

using actions::Workspace;
using widgets::Rect;

/// Where every pane lies, in pixels. A pane that is hidden has no width or height.
struct Window::Layout {
    Rect menu, emergency, outline, view, timeline, inspector, lower, status;
};

namespace {

constexpr float menu_height = 46.0F;
constexpr float status_height = 36.0F;
constexpr float timeline_height = 92.0F;
constexpr float emergency_width = 184.0F;
constexpr float seam = 2.0F;
constexpr float smallest_view = 240.0F;
constexpr float smallest_diagram = 440.0F;    ///< of the processor, with the buttons below it
constexpr double between_looks_at_pad = 0.02; ///< s
constexpr double between_looks_for_pad = 0.5; ///< s

/// Which of the sizes holds for the pane at the left, and for the lower one.
float actions::PaneSizes::*left_size(const actions::ViewState& view_state) {
    switch (view_state.workspace) {
    case Workspace::program:
    case Workspace::machine:
        return &actions::PaneSizes::listing;
    case Workspace::processor:
        return &actions::PaneSizes::code;
    case Workspace::plot:
        return &actions::PaneSizes::layers;
    case Workspace::arm:
        return &actions::PaneSizes::arm_jog;
    default:
        return &actions::PaneSizes::outline;
    }
}

float actions::PaneSizes::*lower_size(const actions::ViewState& view_state) {
    switch (view_state.workspace) {
    case Workspace::processor:
        return &actions::PaneSizes::processor;
    case Workspace::plot:
        return &actions::PaneSizes::plot_lower;
    case Workspace::arm:
        return &actions::PaneSizes::arm_lower;
    default:
        return &actions::PaneSizes::lower;
    }
}

/// Sizes are those of a window of 1280 x 1000 px at scale 1: a larger one gives more to texts and plots.
/// `side`: width or height of the window, px at scale 1.
float growth(float actions::PaneSizes::*size, float side) {
    using actions::PaneSizes;
    constexpr float most = 1.6F, usual_width = 1280.0F, usual_height = 1000.0F;
    constexpr std::array texts{&PaneSizes::listing, &PaneSizes::code};
    constexpr std::array plots{
        &PaneSizes::lower, &PaneSizes::processor, &PaneSizes::plot_lower, &PaneSizes::arm_lower};
    if (std::ranges::find(texts, size) != texts.end()) {
        return std::clamp(side / usual_width, 1.0F, most);
    }
    return std::ranges::find(plots, size) != plots.end() ? std::clamp(side / usual_height, 1.0F, most) : 1.0F;
}

float smallest_middle(const actions::ViewState& view_state) {
    return view_state.workspace == Workspace::processor ? smallest_diagram : smallest_view;
}

/// What a pane shows: where it is scrolled to is kept for each.
std::string content_of(const actions::ViewState& view_state) {
    return std::to_string(static_cast<int>(view_state.workspace));
}

/// Something that could hold a jog is down.
bool jog_may_be_held(const std::optional<render::Gamepad>& pad) {
    using render::Key;
    constexpr std::array keys{Key::left,
                              Key::right,
                              Key::up,
                              Key::down,
                              Key::page_up,
                              Key::page_down,
                              Key::space,
                              Key::equal,
                              Key::minus};
    const bool bumper = pad && (pad->left_bumper || pad->right_bumper);
    return bumper || ImGui::GetIO().MouseDown[0] || std::ranges::any_of(keys, render::key_down);
}

/// A text field keeps the keys that mean something to it; Ctrl+A is the text's, too.
/// With Ctrl, in a text: select all, copy, paste, cut, redo, undo.
constexpr std::array keys_of_texts{
    render::Key::a, render::Key::c, render::Key::v, render::Key::x, render::Key::y, render::Key::z};

bool pressed(const actions::Shortcut& keys, bool typing) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool edits_text = std::ranges::find(keys_of_texts, keys.key) != keys_of_texts.end();
    const bool is_texts = typing && keys.key < render::Key::f1 && (!keys.ctrl || edits_text);
    return !is_texts && io.KeyCtrl == keys.ctrl && io.KeyShift == keys.shift && io.KeyAlt == keys.alt &&
           render::key_pressed(keys.key);
}

/// By its key whatever else has the keyboard.
bool stops_machine(std::string_view action) {
    return action == "machine.hold" || action == "machine.stop" || action == "machine.emergency_stop";
}

} // namespace

Window::Window(actions::AppController& app)
    : app_(app), menu_bar_(app.catalogue()), design_(app.catalogue()), grid_(app.catalogue()),
      toolpath_(app.catalogue()), program_(app.catalogue()), machine_(app.catalogue()), arm_(app.catalogue()),
      arm_jog_(app.catalogue()), processor_(app.catalogue()), plot_(app.catalogue()), lower_(app.catalogue()),
      dialogs_(app.catalogue()), view_(app.catalogue()) {}

Window::Layout
Window::layout(const Ui& ui, const actions::ViewState& view_state, float width, float height) const {
    const actions::PaneSizes& sizes = view_state.panes;
    const float s = ui.px(seam);
    const float top = ui.px(menu_height);
    const float bottom = height - ui.px(status_height);
    // Sizes may be those of a larger window: the view keeps its room, and the left side gives more of it.
    const float wanted_right = sizes.inspector_shown ? ui.px(sizes.inspector) : 0.0F;
    const auto grown = [&](float actions::PaneSizes::*size, float side) {
        return ui.px(sizes.*size) * growth(size, side / ui.px(1.0F));
    };
    const float wanted_left = sizes.outline_shown ? grown(left_size(view_state), width) : 0.0F;
    const float missing =
        std::max(0.0F, wanted_left + wanted_right + ui.px(smallest_middle(view_state)) - width);
    const float left =
        std::max(0.0F, wanted_left - std::round((wanted_right > 0.0F ? 0.7F : 1.0F) * missing));
    const float right = std::max(0.0F, wanted_right - (missing - (wanted_left - left)));
    const float high = std::max(0.0F, height - ui.px(smallest_view + timeline_height + menu_height));
    const float lower = sizes.lower_shown ? std::min(grown(lower_size(view_state), height), high) : 0.0F;
    const float emergency = ui.px(emergency_width);
    const float middle_top = top + s;
    const float middle_bottom = bottom - s - lower;
    const float view_left = left > 0.0F ? left + s : 0.0F;
    const float view_right = right > 0.0F ? width - right - s : width;
    const float timeline_top = middle_bottom - ui.px(timeline_height);
    Layout result;
    result.menu = {0.0F, 0.0F, width - emergency, top};
    result.emergency = {width - emergency, 0.0F, emergency, top};
    result.outline = {0.0F, middle_top, left, middle_bottom - middle_top};
    result.view = {view_left, middle_top, view_right - view_left, timeline_top - s - middle_top};
    result.timeline = {view_left, timeline_top, view_right - view_left, middle_bottom - timeline_top};
    result.inspector = {width - right, middle_top, right, bottom - s - middle_top};
    result.lower = {0.0F, middle_bottom + s, view_right, lower > 0.0F ? lower - s : 0.0F};
    result.status = {0.0F, bottom, width, height - bottom};
    return result;
}

/// What is held down while the machine takes no jog, or while the stop key is pressed, moves nothing later.
bool Window::no_jog(const FrameState& now) {
    const bool stop_key = now.view_state.workspace == actions::Workspace::arm &&
                          now.view_state.manual.arm_keys && render::key_pressed(render::Key::slash);
    const bool jogging = now.connection.status.activity == drivers::Activity::jog;
    return stop_key || (now.connection.connected() && !jogging && !at_rest(now.connection).allowed);
}

void Window::draw(Ui& ui, float width, float height, bool focused) {
    const bool held = jog_may_be_held(app_.gamepad());
    app_.watch_jog(held, focused);
    const FrameState now = app_.look();
    const bool may_jog = jog_gate_.follow(held,
                                          focused,
                                          search_.is_open() || now.asks() || no_jog(now),
                                          now.view_state.workspace,
                                          std::chrono::steady_clock::now());
    if (search_.is_open() || now.view_state.dialogs.search) {
        ui.claim_keys();
    }
    const Layout place = layout(ui, now.view_state, width, height);
    draw_panes(ui, now, place);
    draw_splitters(ui, now, place, width, height);
    draw_over(ui, now, place.view);
    obey_shortcuts(ui, now);
    forget_machine_notices(now);
    app_.perform(ask_, may_jog && !search_.is_open());
    for (widgets::Notice& notice : std::exchange(app_.view_state().notices, {})) {
        toasts_.push(std::move(notice));
    }
}

/// Notices of a machine's fault end with the fault, with its link, and when a job begins.
void Window::forget_machine_notices(const FrameState& now) {
    const actions::ConnectionView& machine = now.connection;
    const MachineSeen seen{machine.connected(),
                           machine.connected() && machine.status.state == drivers::DriverState::alarm,
                           now.job.running};
    const MachineSeen before = std::exchange(machine_seen_, seen);
    if ((before.alarm && !seen.alarm) || (!before.connected && seen.connected) || (!before.job && seen.job)) {
        toasts_.forget_passing();
    }
}

void Window::draw_panes(Ui& ui, const FrameState& now, const Layout& place) {
    {
        const auto pane = ui.bare_pane("menu", place.menu);
        menu_bar_.draw(ui, now, ask_);
    }
    {
        const auto pane = ui.bare_pane("emergency", place.emergency);
        draw_emergency_stop(ui, now);
    }
    if (place.outline.w > 0.0F) {
        draw_left(ui, now, place.outline);
    }
    draw_middle(ui, now, place);
    if (place.inspector.w > 0.0F) {
        const auto pane = ui.pane("inspector", place.inspector, "Inspector", content_of(now.view_state));
        draw_inspector(ui, now);
    }
    if (place.lower.h > 0.0F) {
        const bool plots = now.view_state.workspace == Workspace::plot;
        const std::string tab =
            std::to_string(plots ? plot_.bench_tab() : static_cast<int>(now.view_state.lower_tab_now()));
        const auto pane = ui.pane("lower", place.lower, {}, content_of(now.view_state) + "/" + tab);
        if (now.view_state.workspace == Workspace::processor) {
            processor_.draw_lower(ui, now, ask_);
        } else if (now.view_state.workspace == Workspace::plot) {
            plot_.draw_bench(ui, now, ask_);
        } else {
            lower_.draw(ui, now, ask_);
        }
    }
    const auto pane = ui.bare_pane("status", place.status);
    status_bar(ui, now, ask_, view_.under_mouse());
}

/// What an alarm leaves of the drawing: it stands above that, where it moves no button.
Rect Window::below_alarm(Ui& ui, const FrameState& now, const Rect& view) {
    const Workspace shown = now.view_state.workspace;
    const std::string text = shown == Workspace::machine || shown == Workspace::arm ? alarm_text(now) : "";
    if (text.empty()) {
        return view;
    }
    const widgets::Notice notice{widgets::Severity::danger, text, {}};
    const float height = widgets::banner_height(ui, notice, view.w);
    const auto pane = ui.bare_pane("alarm", {view.x, view.y, view.w, height});
    (void)widgets::banner(ui, "message", notice);
    const float taken = height + ui.px(seam);
    return {view.x, view.y + taken, view.w, view.h - taken};
}

void Window::draw_middle(Ui& ui, const FrameState& now, const Layout& place) {
    const bool processor = now.view_state.workspace == Workspace::processor;
    {
        const Rect drawing = below_alarm(ui, now, place.view);
        const auto pane = ui.bare_pane("view", drawing);
        if (processor) {
            processor_diagram(ui, now, drawing);
        } else {
            view_.draw(ui, now, ask_, drawing);
        }
    }
    const auto pane = ui.pane("timeline", place.timeline);
    if (processor) {
        processor_.draw_steps(ui, now, ask_);
    } else if (now.view_state.workspace == Workspace::arm) {
        arm_.draw_motion(ui, now, ask_);
    } else {
        timeline_.draw(ui, now, ask_);
    }
}

/// Acts when the mouse goes down on it, whatever menu or dialog is open.
void Window::draw_emergency_stop(Ui& ui, const FrameState& now) {
    const actions::Action& stop = app_.catalogue().find("machine.emergency_stop");
    const widgets::Permission permission = stop.permission(now);
    ui.move_by(0.0F, ui.px(10.0F));
    bool asked = false;
    {
        const auto width = ui.width(ui.px(emergency_width - 12.0F));
        asked = ui.button("machine_emergency_stop",
                          "Emergency stop",
                          permission,
                          {stop.info().icon, widgets::Rank::danger, -1.0F, stop.info().tip});
    }
    ui.keep_clear("emergency/machine_emergency_stop");
    const Rect button = ui.place("emergency/machine_emergency_stop").value_or(Rect{});
    const ImGuiIO& io = ImGui::GetIO();
    const bool hit = io.MouseClicked[0] && button.contains({io.MousePos.x, io.MousePos.y});
    if (asked || (hit && permission.allowed)) {
        ask_.run("machine.emergency_stop");
    }
}

/// In the Program workspace the program itself, at the machine what moves it, else what the project is made
/// of.
void Window::draw_left(Ui& ui, const FrameState& now, const Rect& place) {
    if (now.view_state.workspace == Workspace::program) {
        const auto pane = ui.pane("program", place, "Program", content_of(now.view_state));
        listing_.draw(ui, now, ask_);
    } else if (now.view_state.workspace == Workspace::machine) {
        const auto pane = ui.pane("hand", place, "Manual control", content_of(now.view_state));
        machine_.draw_left(ui, now, ask_);
    } else if (now.view_state.workspace == Workspace::processor) {
        const auto pane = ui.pane("code", place, "Code", content_of(now.view_state));
        processor_.draw_code(ui, now, ask_);
    } else if (now.view_state.workspace == Workspace::arm) {
        const auto pane = ui.pane("hand", place, "Manual control", content_of(now.view_state));
        arm_jog_.draw(ui, now, ask_);
    } else if (now.view_state.workspace == Workspace::plot) {
        const auto pane = ui.pane("layers", place, "Plot & Picture", content_of(now.view_state));
        plot_.draw_layers(ui, now, ask_);
    } else {
        const auto pane = ui.pane("outline", place, "Project", content_of(now.view_state));
        outline_.draw(ui, now, ask_);
    }
}

void Window::draw_inspector(Ui& ui, const FrameState& now) {
    switch (now.view_state.workspace) {
    case Workspace::design:
        return design_.draw(ui, now, ask_);
    case Workspace::grid:
        return grid_.draw(ui, now, ask_);
    case Workspace::toolpath:
        return toolpath_.draw(ui, now, ask_);
    case Workspace::program:
        return program_.draw(ui, now, ask_);
    case Workspace::machine:
        return machine_.draw(ui, now, ask_);
    case Workspace::processor:
        return processor_.draw(ui, now, ask_);
    case Workspace::plot:
        return plot_.draw(ui, now, ask_);
    case Workspace::arm:
        return arm_.draw(ui, now, ask_);
    }
}

void Window::draw_splitters(Ui& ui, const FrameState& now, const Layout& place, float width, float height) {
    const auto scope = ui.scope("splitters");
    const actions::PaneSizes& sizes = now.view_state.panes;
    const float s = ui.px(seam);
    const auto drag = [&](std::string_view id,
                          const Rect& bar,
                          widgets::SizeOf side,
                          float actions::PaneSizes::*size,
                          float now_px,
                          float min,
                          float max) {
        if (const auto dragged =
                widgets::splitter(ui, id, {bar, side, now_px, ui.px(min), std::max(ui.px(min), max)})) {
            const float unit = ui.px(1.0F);
            const float times = growth(size, (side == widgets::SizeOf::below ? height : width) / unit);
            const float left_times = growth(left_size(now.view_state), width / unit);
            // A window that is too small for all sizes shows smaller ones; they hold from now on.
            ask_.show([size,
                       value = *dragged / unit / times,
                       left = place.outline.w / unit / left_times,
                       right = place.inspector.w / unit](actions::ViewState& view_state) {
                if (view_state.panes.outline_shown) {
                    view_state.panes.*left_size(view_state) = left;
                }
                if (view_state.panes.inspector_shown) {
                    view_state.panes.inspector = right;
                }
                view_state.panes.*size = value;
            });
        }
    };
    const float spare = width - ui.px(smallest_middle(now.view_state));
    if (sizes.outline_shown) {
        drag("outline",
             {place.outline.w, place.outline.y, s, place.outline.h},
             widgets::SizeOf::left,
             left_size(now.view_state),
             place.outline.w,
             140.0F,
             spare - place.inspector.w);
    }
    if (sizes.inspector_shown) {
        drag("inspector",
             {place.inspector.x - s, place.inspector.y, s, place.inspector.h},
             widgets::SizeOf::right,
             &actions::PaneSizes::inspector,
             place.inspector.w,
             240.0F,
             spare - place.outline.w);
    }
    if (sizes.lower_shown) {
        drag("lower",
             {0.0F, place.lower.y - s, place.lower.w, s},
             widgets::SizeOf::below,
             lower_size(now.view_state),
             place.lower.h + s,
             90.0F,
             height - ui.px(smallest_view + timeline_height + menu_height));
    }
}

void Window::draw_over(Ui& ui, const FrameState& now, const widgets::Rect& view) {
    if (now.view_state.dialogs.search) {
        search_.open();
        ask_.show([](actions::ViewState& view_state) { view_state.dialogs.search = false; });
    }
    if (now.asks()) { // what is asked comes first, and has the keys
        search_.close();
    }
    dialogs_.draw(ui, now, ask_);
    std::vector<widgets::SearchItem> items;
    std::vector<std::string> ids;
    for (const auto& action : app_.catalogue().all()) {
        const actions::ActionInfo& info = action->info();
        if (info.menu == actions::dialog_menu) {
            continue;
        }
        ids.emplace_back(info.id);
        items.push_back({info.id,
                         info.title,
                         info.menu,
                         info.shortcut,
                         action->permission(now),
                         actions::synonyms_of(info.id),
                         info.tip});
    }
    if (const auto chosen = search_.draw(ui, "search", items)) {
        ask_.run(ids[static_cast<std::size_t>(*chosen)]);
    }
    toasts_.draw(ui, "notices", view); // over the drawing, where they cover no button
}

void Window::obey_shortcuts(const Ui& ui, const FrameState& now) {
    for (const auto& action : app_.catalogue().all()) {
        const actions::ActionInfo& info = action->info();
        const bool kept_from =
            ui.keys_claimed() ? !stops_machine(info.id) : now.asks() && info.menu != "Machine";
        if (kept_from) {
            continue;
        }
        for (const std::string_view text : {info.shortcut, info.second_shortcut}) {
            if (!text.empty() && pressed(actions::shortcut(text), ui.was_typing()) &&
                action->permission(now).allowed) {
                ask_.run(std::string(info.id));
            }
        }
    }
}

std::optional<double> Window::next_change() const {
    const auto& view_state = app_.view_state();
    const bool runs = view_state.playback.playing || app_.processor().running() || app_.arm().moving();
    if (runs || app_.jogging()) {
        return 0.0;
    }
    const FrameState now = app_.look();
    const bool listens = view_state.manual.pad_armed && now.connection.connected() &&
                         view_state.workspace == Workspace::machine;
    if (!listens) {
        return std::nullopt;
    }
    return now.gamepad ? between_looks_at_pad : between_looks_for_pad; // GLFW tells of no event
}

} // namespace millwright::panels
