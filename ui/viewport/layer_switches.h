// The layers as a person switches them, in the order of a list: from what is made to what stands around it.
#pragma once

#include "ui/viewport/scene.h"

#include <array>
#include <string_view>

namespace millwright::viewport {

/// A flag of a group of layers.
template <auto group, auto member> bool& layer_flag(Layers& layers) {
    return layers.*group.*member;
}
template <auto member> bool& layer_flag(Layers& layers) {
    return layers.*member;
}

struct LayerSwitch {
    std::string_view id;    ///< "control_net"
    std::string_view title; ///< "Control net"
    std::string_view tip;   ///< a sentence
    bool& (*flag)(Layers&);
    enum class Of { part, arm, both } of = Of::part; ///< where there is something to switch

    [[nodiscard]] bool is_on(Layers layers) const { return flag(layers); }
};

inline constexpr std::array layer_switches{
    LayerSwitch{
        "surface", "Surface", "The designed surface.", layer_flag<&Layers::design, &DesignLayers::surface>},
    LayerSwitch{"surface_lines",
                "Surface lines",
                "Lines of constant u and v on the surface.",
                layer_flag<&Layers::design, &DesignLayers::lines>},
    LayerSwitch{"control_net",
                "Control net",
                "The control points and the control net.",
                layer_flag<&Layers::design, &DesignLayers::control_net>},
    LayerSwitch{"reference",
                "Reference mesh",
                "Triangles of the imported file, for comparison with the surface.",
                layer_flag<&Layers::design, &DesignLayers::reference>},
    LayerSwitch{
        "deviation",
        "Deviation",
        "The imported geometry to which the surface was fitted, coloured by its distance from the surface.",
        layer_flag<&Layers::colored, &ColoredLayers::deviation>},
    LayerSwitch{"produced",
                "Produced surface",
                "The surface that the true path produces, with straight lines between tracks. Only for a "
                "point tool and tracks with equal numbers of moves.",
                layer_flag<&Layers::design, &DesignLayers::produced>},
    LayerSwitch{"grid",
                "Grid",
                "The grid in use, or the grid being adapted.",
                layer_flag<&Layers::grid, &GridLayers::shown>},
    LayerSwitch{"start_grid",
                "Start grid",
                "The uniform grid from which the adaptation starts.",
                layer_flag<&Layers::grid, &GridLayers::start>},
    LayerSwitch{"toolpath",
                "Toolpath",
                "The programmed path of the tool tip.",
                layer_flag<&Layers::path, &PathLayers::intended>,
                LayerSwitch::Of::both},
    LayerSwitch{"tool_axes",
                "Tool axes",
                "The tool axis at each point of the path.",
                layer_flag<&Layers::path, &PathLayers::tool_axes>},
    LayerSwitch{"error_path",
                "True path",
                "The path that the machine actually follows, coloured by its error.",
                layer_flag<&Layers::path, &PathLayers::errors>},
    LayerSwitch{"error_surface",
                "Error map",
                "The surface, coloured by the local path error.",
                layer_flag<&Layers::colored, &ColoredLayers::errors>},
    LayerSwitch{"scallops",
                "Scallops",
                "The surface, coloured by the scallop height.",
                layer_flag<&Layers::colored, &ColoredLayers::scallops>},
    LayerSwitch{"weight",
                "Weight",
                "The surface, coloured by the weight of the elliptic grid: cells become small where the "
                "weight is large.",
                layer_flag<&Layers::colored, &ColoredLayers::weight>},
    LayerSwitch{"singular_points",
                "Singular points",
                "Points at which the rotary axes of the machine have no unique position.",
                layer_flag<&Layers::machine, &MachineLayers::singular_points>},
    LayerSwitch{"gouges",
                "Gouges",
                "Places where the cutter or the holder cuts into the part, and where the surface is too "
                "tight for the cutter.",
                layer_flag<&Layers::path, &PathLayers::gouges>},
    LayerSwitch{"set_up_map",
                "Set-up map",
                "Error or travel at other part positions on the table, after a search.",
                layer_flag<&Layers::machine, &MachineLayers::set_up_map>},
    LayerSwitch{"machine",
                "Machine",
                "The machine model at the current axis positions.",
                layer_flag<&Layers::machine, &MachineLayers::bodies>},
    LayerSwitch{"tool",
                "Tool",
                "The tool at the current playback position.",
                layer_flag<&Layers::machine, &MachineLayers::tool>},
    LayerSwitch{"trace",
                "Travelled path",
                "The true path up to the current playback position.",
                layer_flag<&Layers::path, &PathLayers::trace>,
                LayerSwitch::Of::both},
    LayerSwitch{"arm",
                "Arm",
                "The model of the robot arm.",
                layer_flag<&Layers::arm, &ArmLayers::body>,
                LayerSwitch::Of::arm},
    LayerSwitch{"arm_reach",
                "Reach",
                "The boundary of the workspace of the wrist.",
                layer_flag<&Layers::arm, &ArmLayers::reach>,
                LayerSwitch::Of::arm},
    LayerSwitch{"joint_limits",
                "Joint limits",
                "The range and the current position of each joint.",
                layer_flag<&Layers::arm, &ArmLayers::joint_limits>,
                LayerSwitch::Of::arm},
    LayerSwitch{"tool_frame",
                "Tool frame",
                "The coordinate axes at the tool tip of the arm.",
                layer_flag<&Layers::arm, &ArmLayers::tool_frame>,
                LayerSwitch::Of::arm},
    LayerSwitch{"floor",
                "Floor",
                "A ground grid below the scene.",
                layer_flag<&Layers::floor>,
                LayerSwitch::Of::both},
    LayerSwitch{
        "origin", "Origin", "The coordinate axes at the workpiece origin.", layer_flag<&Layers::origin>},
};

/// `layers` with that one shown if it was hidden, and the other way round. What colours the surface hides
/// what coloured it before.
[[nodiscard]] Layers switched(Layers layers, const LayerSwitch& which);

} // namespace millwright::viewport
