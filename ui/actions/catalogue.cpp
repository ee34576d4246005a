#include "ui/actions/internal/simple_action.h"

namespace millwright::actions {

Catalogue::Catalogue() {
    add_file_actions(actions_);
    add_import_actions(actions_);
    add_quit_action(actions_);
    add_edit_actions(actions_);
    add_view_actions(actions_);
    add_layer_actions(actions_);
    add_grid_actions(actions_);
    add_set_up_actions(actions_);
    add_stock_actions(actions_);
    add_playback_actions(actions_);
    add_machine_actions(actions_);
    add_queue_actions(actions_);
    add_controller_actions(actions_);
    add_processor_actions(actions_);
    add_arm_actions(actions_);
    add_arm_teach_actions(actions_);
    add_plot_actions(actions_);
    add_help_actions(actions_);
    add_dialog_actions(actions_);
}

} // namespace millwright::actions
