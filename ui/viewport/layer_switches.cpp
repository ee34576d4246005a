#include "ui/viewport/layer_switches.h"

#include <algorithm>
#include <array>

namespace millwright::viewport {

Layers switched(Layers layers, const LayerSwitch& which) {
    bool& flag = which.flag(layers);
    const bool on = !flag;
    // Nearly in one place: they would hide half of each other.
    const std::array covering{&layers.colored.deviation,
                              &layers.colored.errors,
                              &layers.colored.scallops,
                              &layers.colored.weight,
                              &layers.design.produced};
    if (on && std::ranges::find(covering, &flag) != covering.end()) {
        for (bool* each : covering) {
            *each = false;
        }
    }
    flag = on;
    return layers;
}

} // namespace millwright::viewport
