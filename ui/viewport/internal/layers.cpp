#include "ui/viewport/internal/layers.h"

namespace millwright::viewport {

std::vector<std::unique_ptr<Layer>> make_layers() {
    std::vector<std::unique_ptr<Layer>> layers;
    for (const auto make :
         {make_machine_layer,  make_arm_layer,         make_fixture_layer,    make_reference_layer,
          make_surface_layer,  make_stock_layer,       make_plot_layer,       make_weight_layer,
          make_scallop_layer,  make_set_up_layer,      make_origin_layer,     make_grid_layer,
          make_toolpath_layer, make_error_layer,       make_produced_layer,   make_singular_layer,
          make_gouge_layer,    make_control_net_layer, make_simulation_layer, make_program_layer,
          make_floor_layer,    make_arm_marks_layer}) {
        layers.push_back(make());
    }
    return layers;
}

} // namespace millwright::viewport
