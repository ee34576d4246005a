// What is cut of a picture: the relief, and the frame that takes it out of its plate. Lengths mm.
#pragma once

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/height_field.h"
#include "core/plot/picture/relief.h"

#include <optional>

namespace millwright::plot {

struct ReliefPlan {
    ReliefSettings relief = {};       ///< step_over not given: usual_step_over()
    std::optional<double> plate = {}; ///< the picture is cut out of a plate so thick; not given: it stays
    bool through = false;             ///< relief and frame may be deeper than that plate
    double frame_margin = 1.0;
    Tabs tabs = {.count = 4}; ///< that hold the frame
};

/// Rows of a tool with a width leave ridges: a tenth of it apart, a ball's are a 400th of it high. A pixel
/// where the tool has no width.
[[nodiscard]] double usual_step_over(const ToolTip& tip, double pitch);

/// Relief and frame; passes of the frame are no deeper than those of the roughing, else than half of the
/// tool, as the table of materials has it. The frame ends at the underside of the plate; where cuts may go
/// through, so much deeper that the tip has its whole width there. Throws Error as relief(), and for the
/// frame of a tool without a width; Cancelled.
[[nodiscard]] CutPath
relief_path(const HeightField& field, const ReliefPlan& plan, const Progress& progress = Progress());

/// What a person should know of a frame whose tip is narrower at its end than higher up: the flange that
/// stays around the part, or how far the frame goes below the plate. Nothing where there is nothing to say.
[[nodiscard]] std::optional<Diagnostic> frame_notice(const ReliefPlan& plan);

} // namespace millwright::plot
