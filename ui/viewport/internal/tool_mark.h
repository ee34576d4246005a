// The mark of a tool on a path that says nothing of its cutter: as large as it is well seen beside the path.
#pragma once

#include "ui/viewport/internal/solids.h"

#include <optional>

namespace millwright::viewport {

class ToolMark {
public:
    /// Makes its buffers, once.
    void prepare();

    /// After prepare(). `tip` in the workpiece's frame, mm; `axis` from there towards the spindle, unit.
    void draw(const Canvas& canvas, const Vec3& tip, const Vec3& axis) const;

private:
    std::optional<SolidBuffers> solid_;
};

} // namespace millwright::viewport
