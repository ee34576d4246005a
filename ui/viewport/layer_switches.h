// The layers as a person switches them, in the order of a list: from what is made to what stands around it.
#pragma once

#include "ui/viewport/scene.h"

#include <array>
#include <string_view>

namespace millwright::viewport {

struct LayerSwitch {
    std::string_view id;    ///< "control_net"
    std::string_view title; ///< "Control net"
    std::string_view tip;   ///< a sentence
    bool Layers::*shown;
    enum class Of { part, arm, both } of = Of::part; ///< where there is something to switch
};

inline constexpr std::array layer_switches{
    LayerSwitch{"surface", "Surface", "The designed surface.", &Layers::surface},
    LayerSwitch{"surface_lines",
                "Surface lines",
                "Lines of constant u and v on the surface.",
                &Layers::surface_lines},
    LayerSwitch{
        "control_net", "Control net", "The control points and the control net.", &Layers::control_net},
    LayerSwitch{"reference",
                "Reference mesh",
                "Triangles of the imported file, for comparison with the surface.",
                &Layers::reference},
    LayerSwitch{
        "deviation",
        "Deviation",
        "The imported geometry to which the surface was fitted, coloured by its distance from the surface.",
        &Layers::deviation},
    LayerSwitch{"produced",
                "Produced surface",
                "The surface that the true path produces, with straight lines between tracks. Only for a "
                "point tool and tracks with equal numbers of moves.",
                &Layers::produced},
    LayerSwitch{"grid", "Grid", "The grid in use, or the grid being adapted.", &Layers::grid},
    LayerSwitch{"start_grid",
                "Start grid",
                "The uniform grid from which the adaptation starts.",
                &Layers::start_grid},
    LayerSwitch{"toolpath",
                "Toolpath",
                "The programmed path of the tool tip.",
                &Layers::toolpath,
                LayerSwitch::Of::both},
    LayerSwitch{"tool_axes", "Tool axes", "The tool axis at each point of the path.", &Layers::tool_axes},
    LayerSwitch{"error_path",
                "True path",
                "The path that the machine actually follows, coloured by its error.",
                &Layers::error_path},
    LayerSwitch{"error_surface",
                "Error map",
                "The surface, coloured by the local path error.",
                &Layers::error_surface},
    LayerSwitch{"scallops", "Scallops", "The surface, coloured by the scallop height.", &Layers::scallops},
    LayerSwitch{"weight",
                "Weight",
                "The surface, coloured by the weight of the elliptic grid: cells become small where the "
                "weight is large.",
                &Layers::weight},
    LayerSwitch{"singular_points",
                "Singular points",
                "Points at which the rotary axes of the machine have no unique position.",
                &Layers::singular_points},
    LayerSwitch{"gouges",
                "Gouges",
                "Places where the cutter or the holder cuts into the part, and where the surface is too "
                "tight for the cutter.",
                &Layers::gouges},
    LayerSwitch{"set_up_map",
                "Set-up map",
                "Error or travel at other part positions on the table, after a search.",
                &Layers::set_up_map},
    LayerSwitch{"machine", "Machine", "The machine model at the current axis positions.", &Layers::machine},
    LayerSwitch{"tool", "Tool", "The tool at the current playback position.", &Layers::tool},
    LayerSwitch{"trace",
                "Travelled path",
                "The true path up to the current playback position.",
                &Layers::trace,
                LayerSwitch::Of::both},
    LayerSwitch{"arm", "Arm", "The model of the robot arm.", &Layers::arm, LayerSwitch::Of::arm},
    LayerSwitch{"arm_reach",
                "Reach",
                "The boundary of the workspace of the wrist.",
                &Layers::arm_reach,
                LayerSwitch::Of::arm},
    LayerSwitch{"joint_limits",
                "Joint limits",
                "The range and the current position of each joint.",
                &Layers::joint_limits,
                LayerSwitch::Of::arm},
    LayerSwitch{"tool_frame",
                "Tool frame",
                "The coordinate axes at the tool tip of the arm.",
                &Layers::tool_frame,
                LayerSwitch::Of::arm},
    LayerSwitch{"floor", "Floor", "A ground grid below the scene.", &Layers::floor, LayerSwitch::Of::both},
    LayerSwitch{"origin", "Origin", "The coordinate axes at the workpiece origin.", &Layers::origin},
};

/// `layers` with that one shown if it was hidden, and the other way round. What colours the surface hides
/// what coloured it before.
[[nodiscard]] Layers switched(Layers layers, const LayerSwitch& which);

} // namespace millwright::viewport
