// One switch for each layer of the 3D view, in the workspace that is shown.
#include "ui/actions/layer_actions.h"

#include "ui/actions/internal/simple_action.h"
#include "ui/viewport/layer_switches.h"

namespace millwright::actions {

namespace {

class LayerAction final : public Action {
public:
    explicit LayerAction(const viewport::LayerSwitch& which)
        : which_(which), id_(layer_action(which)), info_{id_, "Layers", which.title, which.tip, "", ""} {}

    [[nodiscard]] const ActionInfo& info() const override { return info_; }
    [[nodiscard]] widgets::Permission permission(const FrameState&) const override { return {}; }
    [[nodiscard]] bool is_on(const FrameState& now) const override {
        return which_.is_on(now.view_state.layers_now());
    }
    void run(ActionContext& context) const override {
        viewport::Layers& layers = context.view_state.layers_now();
        layers = viewport::switched(layers, which_);
    }

private:
    const viewport::LayerSwitch& which_;
    std::string id_;
    ActionInfo info_;
};

} // namespace

std::string layer_action(const viewport::LayerSwitch& which) {
    return "view.layer_" + std::string(which.id);
}

void add_layer_actions(Actions& actions) {
    for (const viewport::LayerSwitch& which : viewport::layer_switches) {
        actions.push_back(std::make_unique<LayerAction>(which));
    }
    add(actions,
        {usual_layers_action,
         "Layers",
         "Default layers",
         "Shows the default layers of this workspace.",
         "",
         widgets::icons::reset},
        always,
        [](ActionContext& context) {
            context.view_state.layers_now() =
                new_view_state().layers[static_cast<std::size_t>(context.view_state.workspace)];
        });
}

} // namespace millwright::actions
