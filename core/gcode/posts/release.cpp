#include "core/gcode/posts/release.h"

#include "core/gcode/posts/arc_fit.h"
#include "core/gcode/posts/read_back.h"

#include <utility>

namespace millwright::gcode {

ReleasedText release(const Program& program,
                     const kinematics::MachineModel& machine,
                     const PostFormat& format,
                     const ReleaseSettings& settings) {
    PreparedProgram ready = prepare(program, machine, format, settings.tip_tolerance);
    if (settings.arc_tolerance > 0.0) {
        ready.wording.arcs = fit_arcs(ready.program, ready.wording, format, settings.arc_tolerance);
    }
    Listing listing = write_text(ready.program, ready.wording, format, settings.text);
    check_read_back(listing, ready.program, ready.wording, format, settings.arc_tolerance, settings.file);
    return {std::move(ready.program),
            std::move(listing),
            ready.tip_deviation,
            static_cast<int>(ready.wording.arcs.size())};
}

} // namespace millwright::gcode
