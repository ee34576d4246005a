// A design: one or more Bezier patches, each with its own parameter domain [0,1]^2.
#pragma once

#include "core/geometry/bezier_patch.h"

#include <vector>

namespace millwright::geometry {

/// A patch of a surface, by its place in it.
enum class PatchId : int {};

class Surface {
public:
    /// Throws Error if there is no patch.
    explicit Surface(std::vector<BezierPatch> patches);

    [[nodiscard]] int patch_count() const { return static_cast<int>(patches_.size()); }
    /// Throws Defect if there is no such patch.
    [[nodiscard]] const BezierPatch& patch(PatchId id) const;
    [[nodiscard]] const std::vector<BezierPatch>& patches() const { return patches_; }
    [[nodiscard]] Box3 control_box() const;

    /// The same surface with one patch replaced.
    [[nodiscard]] Surface with_patch(PatchId id, BezierPatch patch) const;

    friend bool operator==(const Surface&, const Surface&) = default;

private:
    std::vector<BezierPatch> patches_;
};

} // namespace millwright::geometry
