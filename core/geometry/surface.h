// A design: one or more Bezier patches, each with its own parameter domain [0,1]^2, or faces of a CAD model.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/bspline_surface.h"

#include <vector>

namespace millwright::geometry {

/// A patch of a surface, by its place in it.
enum class PatchId : int {};

class Surface {
public:
    /// Throws Error if there is no patch.
    explicit Surface(std::vector<BezierPatch> patches);
    /// Without patches.
    explicit Surface(BsplineSurface face);
    /// The same of several faces. Throws Error if there is none.
    explicit Surface(std::vector<BsplineSurface> faces);

    [[nodiscard]] int patch_count() const { return static_cast<int>(patches_.size()); }
    /// Throws Defect if there is no such patch.
    [[nodiscard]] const BezierPatch& patch(PatchId id) const;
    [[nodiscard]] const std::vector<BezierPatch>& patches() const { return patches_; }
    [[nodiscard]] const std::vector<BsplineSurface>& faces() const { return faces_; }
    /// The patch, or the face, numbered from 0. Throws Defect if there is none such.
    [[nodiscard]] const ParametricSurface& part(PatchId id) const;
    /// The patches, or the faces.
    [[nodiscard]] std::vector<const ParametricSurface*> parts() const;
    [[nodiscard]] Box3 control_box() const;
    /// The same by patches alone: those of the faces' spans.
    [[nodiscard]] Surface in_patches() const;

    /// The same surface with one patch replaced.
    [[nodiscard]] Surface with_patch(PatchId id, BezierPatch patch) const;

    friend bool operator==(const Surface&, const Surface&) = default;

private:
    std::vector<BezierPatch> patches_;
    std::vector<BsplineSurface> faces_;
};

} // namespace millwright::geometry
