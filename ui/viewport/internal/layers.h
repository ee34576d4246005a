// The layers of the 3D view, one file each. Each needs a current context.
#pragma once

#include "ui/viewport/internal/layer.h"

#include <memory>
#include <vector>

namespace millwright::viewport {

[[nodiscard]] std::unique_ptr<Layer> make_floor_layer();
[[nodiscard]] std::unique_ptr<Layer> make_origin_layer();
[[nodiscard]] std::unique_ptr<Layer> make_machine_layer();
[[nodiscard]] std::unique_ptr<Layer> make_fixture_layer();
[[nodiscard]] std::unique_ptr<Layer> make_surface_layer();
[[nodiscard]] std::unique_ptr<Layer> make_reference_layer();
[[nodiscard]] std::unique_ptr<Layer> make_grid_layer();
[[nodiscard]] std::unique_ptr<Layer> make_toolpath_layer();
[[nodiscard]] std::unique_ptr<Layer> make_error_layer();
[[nodiscard]] std::unique_ptr<Layer> make_produced_layer();
[[nodiscard]] std::unique_ptr<Layer> make_weight_layer();
[[nodiscard]] std::unique_ptr<Layer> make_scallop_layer();
[[nodiscard]] std::unique_ptr<Layer> make_singular_layer();
[[nodiscard]] std::unique_ptr<Layer> make_gouge_layer();
[[nodiscard]] std::unique_ptr<Layer> make_set_up_layer();
[[nodiscard]] std::unique_ptr<Layer> make_stock_layer();
[[nodiscard]] std::unique_ptr<Layer> make_control_net_layer();
[[nodiscard]] std::unique_ptr<Layer> make_simulation_layer();
[[nodiscard]] std::unique_ptr<Layer> make_program_layer();
[[nodiscard]] std::unique_ptr<Layer> make_plot_layer();
[[nodiscard]] std::unique_ptr<Layer> make_arm_layer();
[[nodiscard]] std::unique_ptr<Layer> make_arm_marks_layer();

/// All of them in the order in which they are drawn: solid things first.
[[nodiscard]] std::vector<std::unique_ptr<Layer>> make_layers();

} // namespace millwright::viewport
