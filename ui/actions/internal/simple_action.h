// An action that is a row of a table: what it says of itself, when it is allowed, what it does.
#pragma once

#include "ui/actions/action.h"
#include "ui/widgets/icons.h"

#include <utility>

namespace millwright::actions {

class SimpleAction final : public Action {
public:
    using Allowed = widgets::Permission (*)(const FrameState&);
    using Does = void (*)(ActionContext&);
    using IsOn = bool (*)(const FrameState&);

    /// `on` is null for what is no switch.
    SimpleAction(const ActionInfo& info, Allowed allowed, Does does, IsOn on)
        : info_(info), allowed_(allowed), does_(does), is_on_(on) {}

    [[nodiscard]] const ActionInfo& info() const override { return info_; }
    [[nodiscard]] widgets::Permission permission(const FrameState& now) const override {
        return allowed_(now);
    }
    [[nodiscard]] bool is_on(const FrameState& now) const override { return is_on_ && is_on_(now); }
    void run(ActionContext& context) const override { does_(context); }

private:
    ActionInfo info_;
    Allowed allowed_;
    Does does_;
    IsOn is_on_;
};

using Actions = std::vector<std::unique_ptr<Action>>;

inline widgets::Permission always(const FrameState&) {
    return {};
}

inline void add(Actions& actions,
                const ActionInfo& info,
                SimpleAction::Allowed allowed,
                SimpleAction::Does does,
                SimpleAction::IsOn on = nullptr) {
    actions.push_back(std::make_unique<SimpleAction>(info, allowed, does, on));
}

void add_file_actions(Actions& actions);
void add_import_actions(Actions& actions);
void add_quit_action(Actions& actions);
void add_edit_actions(Actions& actions);
void add_view_actions(Actions& actions);
void add_layer_actions(Actions& actions);
void add_grid_actions(Actions& actions);
void add_set_up_actions(Actions& actions);
void add_stock_actions(Actions& actions);
void add_playback_actions(Actions& actions);
void add_machine_actions(Actions& actions);
void add_queue_actions(Actions& actions);
void add_controller_actions(Actions& actions);
void add_processor_actions(Actions& actions);
void add_plot_actions(Actions& actions);
void add_arm_actions(Actions& actions);
void add_arm_teach_actions(Actions& actions);
void add_help_actions(Actions& actions);
void add_dialog_actions(Actions& actions);

} // namespace millwright::actions
