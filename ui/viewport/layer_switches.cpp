#include "ui/viewport/layer_switches.h"

namespace millwright::viewport {

Layers switched(Layers layers, const LayerSwitch& which) {
    const bool on = !(layers.*which.shown);
    if (on && (which.shown == &Layers::error_surface || which.shown == &Layers::weight ||
               which.shown == &Layers::scallops || which.shown == &Layers::deviation ||
               which.shown == &Layers::produced)) { // nearly in one place: they would hide half of each other
        layers.error_surface = layers.weight = layers.scallops = layers.deviation = layers.produced = false;
    }
    layers.*which.shown = on;
    return layers;
}

} // namespace millwright::viewport
