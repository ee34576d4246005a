// What of the scene lies under a pixel. Pixels as in ui/render/view.h. `s_T_w`: workpiece to scene.
#pragma once

#include "core/geometry/mesh.h"
#include "ui/render/view.h"
#include "ui/viewport/scene.h"

#include <Eigen/Geometry>

#include <memory>
#include <optional>
#include <vector>

namespace millwright::viewport {

/// The handle nearest to `pixel` and not further than `within_px`; of two on the same place the nearer one.
[[nodiscard]] std::optional<ControlPointId> pick_control_point(const geometry::Surface& surface,
                                                               const Frame& s_T_w,
                                                               const render::View& view,
                                                               const glm::dvec2& pixel,
                                                               double within_px);

/// The handles inside the rectangle with these corners, ascending.
[[nodiscard]] std::vector<ControlPointId> control_points_in(const geometry::Surface& surface,
                                                            const Frame& s_T_w,
                                                            const render::View& view,
                                                            const glm::dvec2& corner,
                                                            const glm::dvec2& opposite);

/// A place of the surface on a line of sight.
struct SurfaceHit {
    Vec3 position = Vec3::Zero(); ///< workpiece
    geometry::PatchId patch{0};
    Vec2 uv = Vec2::Zero();
    double distance = 0.0; ///< from the ray's origin, mm
};

/// Finds where lines of sight meet a surface.
class SurfacePicker {
public:
    /// Triangulates it, unless it is the one of the last call. Null: nothing is ever met.
    void follow(const std::shared_ptr<const geometry::Surface>& surface);

    /// The first meeting of the ray (scene) with the surface. The triangles stand for it: `position` lies on
    /// the surface, within a triangle's sag of the ray.
    [[nodiscard]] std::optional<SurfaceHit> hit(const render::Ray& ray, const Frame& s_T_w) const;

private:
    struct Part {
        geometry::Mesh mesh;
        std::vector<Eigen::AlignedBox3d> boxes; ///< of the triangles of each row of cells
    };

    std::shared_ptr<const geometry::Surface> surface_;
    std::vector<Part> parts_; ///< one per patch
};

/// The face of the reference that the ray (scene) meets first, no further than `farthest_mm` from the ray's
/// origin; nothing where it has no faces.
[[nodiscard]] std::optional<int> pick_face(const plan::ReferenceMesh& reference,
                                           const render::Ray& ray,
                                           const Frame& s_T_w,
                                           double farthest_mm);

/// A place of the path.
struct PathHit {
    int move = 0;
    double fraction = 0.0;
};

/// The move of the shown path (as intended, and as it really is where errors are shown) nearest to `pixel`
/// and not further than `within_px`. What lies more than `hidden_mm` behind `sight_mm` of the line of sight
/// does not count.
[[nodiscard]] std::optional<PathHit> pick_move(const Scene& scene,
                                               const render::View& view,
                                               const glm::dvec2& pixel,
                                               double within_px,
                                               std::optional<double> sight_mm,
                                               double hidden_mm);

} // namespace millwright::viewport
