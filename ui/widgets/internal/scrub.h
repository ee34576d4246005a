// A number changed by dragging its label sideways: shown while the mouse moves, committed when it is let go.
#pragma once

#include "ui/widgets/internal/draw.h"

#include <optional>
#include <string>

namespace millwright::widgets {

struct ScrubView {
    std::string path; ///< of the field
    Rect label;
    double value = 0.0;
    double step = 1.0; ///< a few pixels of the mouse; Shift a tenth, Ctrl ten of them
    FieldInfo info;
    Permission permission;
};

struct Scrubbed {
    std::optional<double> shown;     ///< while the label is dragged
    std::optional<double> committed; ///< the mouse was let go; Esc before that leaves the value as it was
};

/// The label's path is the field's with `.label` behind it.
[[nodiscard]] Scrubbed scrub(Ui& ui, const ScrubView& view);

} // namespace millwright::widgets
