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
    LayerSwitch{"surface", "Surface", "What is designed.", &Layers::surface},
    LayerSwitch{"surface_lines",
                "Surface lines",
                "Lines of constant u and v on the surface.",
                &Layers::surface_lines},
    LayerSwitch{"control_net", "Control net", "The control points and their net.", &Layers::control_net},
    LayerSwitch{"reference",
                "Reference mesh",
                "Triangles of an imported file beside the surface.",
                &Layers::reference},
    LayerSwitch{"deviation",
                "Deviation",
                "What the surface was fitted to, coloured by its distance from the surface.",
                &Layers::deviation},
    LayerSwitch{
        "produced",
        "Produced surface",
        "The surface that the true path makes, with straight lines from track to track. For a tool that is "
        "a point, on tracks with equally many moves.",
        &Layers::produced},
    LayerSwitch{"grid", "Grid", "The grid that is used, or is being adapted.", &Layers::grid},
    LayerSwitch{
        "start_grid", "Start grid", "The uniform grid that the adaptation begins with.", &Layers::start_grid},
    LayerSwitch{"toolpath",
                "Toolpath",
                "The path of the tool tip as intended.",
                &Layers::toolpath,
                LayerSwitch::Of::both},
    LayerSwitch{
        "tool_axes", "Tool axes", "The direction of the tool at each point of the path.", &Layers::tool_axes},
    LayerSwitch{"error_path",
                "True path",
                "The path that the machine really takes, coloured by its error.",
                &Layers::error_path},
    LayerSwitch{"error_surface",
                "Error map",
                "The surface, coloured by the errors around each place.",
                &Layers::error_surface},
    LayerSwitch{"scallops",
                "Scallops",
                "The surface, coloured by the height of what the cutter leaves on it.",
                &Layers::scallops},
    LayerSwitch{
        "weight",
        "Weight",
        "The surface, coloured by the weight of the elliptic grid: cells become small where it is large.",
        &Layers::weight},
    LayerSwitch{"singular_points",
                "Singular points",
                "Where the machine's rotary axes have no unique position.",
                &Layers::singular_points},
    LayerSwitch{"gouges",
                "Gouges",
                "Where cutter or holder come too deep into the part, and where the cutter does not fit.",
                &Layers::gouges},
    LayerSwitch{"set_up_map",
                "Set-up map",
                "What other places of the part on the table cost, once they were searched.",
                &Layers::set_up_map},
    LayerSwitch{"machine", "Machine", "The bodies of the machine, where its axes are.", &Layers::machine},
    LayerSwitch{"tool", "Tool", "The tool where the motion stands.", &Layers::tool},
    LayerSwitch{"trace",
                "Travelled path",
                "The true path up to where the motion stands.",
                &Layers::trace,
                LayerSwitch::Of::both},
    LayerSwitch{"arm", "Arm", "The bodies of the robot arm.", &Layers::arm, LayerSwitch::Of::arm},
    LayerSwitch{"arm_reach",
                "Reach",
                "The border of where the wrist can be.",
                &Layers::arm_reach,
                LayerSwitch::Of::arm},
    LayerSwitch{"joint_limits",
                "Joint limits",
                "The range of each joint, and where it stands.",
                &Layers::joint_limits,
                LayerSwitch::Of::arm},
    LayerSwitch{"tool_frame",
                "Tool frame",
                "The axes at the tip of the arm's tool.",
                &Layers::tool_frame,
                LayerSwitch::Of::arm},
    LayerSwitch{"floor", "Floor", "A ground grid below everything.", &Layers::floor, LayerSwitch::Of::both},
    LayerSwitch{"origin", "Origin", "Axes at the origin of the workpiece.", &Layers::origin},
};

/// `layers` with that one shown if it was hidden, and the other way round. What colours the surface hides
/// what coloured it before.
[[nodiscard]] Layers switched(Layers layers, const LayerSwitch& which);

} // namespace millwright::viewport
