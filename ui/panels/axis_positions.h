// Where every axis stands: on the timeline, or where the machine is.
#pragma once

#include "core/kinematics/machine_model.h"
#include "ui/panels/panel.h"
#include "ui/widgets/readout.h"

#include <span>
#include <string>

namespace millwright::panels {

/// The axes of the shown machine, near-limit colours, the tip and the tool axis on the part. Says why where
/// nothing is known.
void axis_positions(Ui& ui, const FrameState& now);

/// Of an axis at `position`, mm or rad. Near means within a twentieth of the travel of its end; the ends are
/// of the travel, since many a machine is homed there.
[[nodiscard]] widgets::AxisState travel_limit_state(const kinematics::MachineAxis& axis, double position);

/// Why the digits of some axes have the colour of a warning or of danger.
struct TravelWords {
    std::string text;
    widgets::Tone tone = widgets::Tone::muted;
};
[[nodiscard]] TravelWords travel_words(std::span<const widgets::AxisReading> axes);

} // namespace millwright::panels
