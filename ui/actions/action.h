// Everything a user can do, as objects: menu, key, palette, button, script and test all run the same one.
#pragma once

#include "core/project/history.h"
#include "ui/actions/drag.h"
#include "ui/widgets/permission.h"
#include "ui/workspaces/frame_state.h"
#include "ui/workspaces/hold_to_run_jog.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::actions {

class AppController;

struct ActionInfo {
    std::string_view id;       ///< "grid.adapt"; never changes once released: scripts use it
    std::string_view menu;     ///< "File", "Edit" ...; also the detail shown in the palette
    std::string_view title;    ///< "Adapt the grid"
    std::string_view tip;      ///< a sentence
    std::string_view shortcut; ///< "Ctrl+S" as people read it; empty for none
    std::string_view icon;
    std::string_view second_shortcut = {}; ///< does the same
};

/// The menu of actions that only answer a dialog: in no menu and not in the palette.
inline constexpr std::string_view dialog_menu = "Dialog";

/// What an action works with. Made by AppController.
struct ActionContext {
    project::History& history;
    ViewState& view_state;
    Document& document;
    plan::Pipeline& pipeline;
    JobRunner& jobs;
    const FrameState& now;
    AppController& app; ///< for whole files
};

class Action {
public:
    Action() = default;
    Action(const Action&) = delete;
    Action& operator=(const Action&) = delete;
    virtual ~Action() = default;
    [[nodiscard]] virtual const ActionInfo& info() const = 0;
    /// Yes, or the sentence why not.
    [[nodiscard]] virtual widgets::Permission permission(const FrameState& now) const = 0;
    /// Whether it is a switch that is on: ticked in the menu.
    [[nodiscard]] virtual bool is_on(const FrameState&) const { return false; }
    /// Throws Error with what went wrong; the runner tells the person and leaves everything as it was.
    virtual void run(ActionContext& context) const = 0;
};

/// All actions without arguments, in menu order. Ids are unique.
class Catalogue {
public:
    Catalogue();
    [[nodiscard]] const std::vector<std::unique_ptr<Action>>& all() const { return actions_; }
    /// Throws Defect if there is no such action.
    [[nodiscard]] const Action& find(std::string_view id) const;
    [[nodiscard]] const Action* find_or_null(std::string_view id) const;

private:
    std::vector<std::unique_ptr<Action>> actions_;
};

/// What panels asked for in one frame, performed after it in order.
class ActionQueue {
public:
    /// A catalogue action.
    void run(std::string id);
    /// A change of the project, named for undo ("Move a control point"). Steps with the same non-empty
    /// `merge_key` become one until end_step().
    void edit(std::string title, std::function<void(project::Project&)> change, std::string merge_key = {});
    void end_step();
    /// One frame of a drag.
    void drag(viewport::DragStage stage, Dragged what);
    /// A change of what is looked at.
    void show(std::function<void(ViewState&)> change);
    /// Opens a chosen file, after asking what becomes of unsaved changes; saves to one.
    void open_file(std::filesystem::path file);
    void save_file(std::filesystem::path file);
    /// What is done with another file that was chosen.
    void files(std::function<void(AppController&)> what) { requests_.push_back(std::move(what)); }

    /// What is to be done with the processor.
    void processor(std::function<void(ProcessorWorkspace&)> what);
    /// ... with the arm.
    void arm(std::function<void(ArmWorkspace&)> what);
    /// ... and with the plot.
    void plot(std::function<void(PlotWorkspace&)> what);
    /// What the connected machine is to do, at once.
    void tell(std::function<void(drivers::Driver&)> what);
    /// A change of the job queue.
    void queue(std::function<void(jobs::JobQueue&)> change);
    /// Reads the program of a queued job again.
    void open_queued(jobs::QueuedJobId id);
    /// At once, of the running job or of what the machine does next.
    void set_overrides(const drivers::Overrides& wanted);
    /// Wanted in this frame alone: the machine moves while every frame says so.
    void jog(JogWish wish) { jog_ = std::move(wish); }
    [[nodiscard]] std::optional<JogWish> take_jog() { return std::exchange(jog_, std::nullopt); }

    using Request = std::function<void(AppController&)>;
    [[nodiscard]] std::vector<Request> take();

private:
    std::vector<Request> requests_;
    std::optional<JogWish> jog_;
};

} // namespace millwright::actions
