// The thesis's own result files and angle formulas, for comparison with the original.
// Source: Parasilmongkol 1997, listing (Surface.dat, Toolpath.dat) and ch. 3.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/kinematics/machine_model.h"
#include "core/kinematics/rotary_tilt.h"
#include "core/toolpath/toolpath.h"

#include <string>
#include <vector>

namespace millwright::toolpath {

/// The 30 degree oblique view of the listing: x_s = 10 + R (X + Y cos 30), y_s = 400 - R (Z + Y sin 30), with
/// pi = 22/7. R fits the means of the points into 250 x 200 pixels.
class ObliqueView {
public:
    /// Throws Error where that is no positive number: the means lie in the wrong half.
    explicit ObliqueView(const std::vector<Vec3>& points);
    [[nodiscard]] double scale() const { return R_; }
    /// Pixels, truncated toward zero as in the listing.
    [[nodiscard]] Eigen::Vector2i pixel(const Vec3& point) const;

private:
    double R_ = 1.0;
};

/// Which points of the surface the listing takes, and how its zigzag follows them: along v is the listing's
/// own (Tool Path 2 of the window), along u Tool Path 1.
struct ListingGrid {
    int nu = 20, nv = 20; ///< points each way, 2 or more
    grid::TrackDirection direction = grid::TrackDirection::along_v;
    bool flipped = false; ///< the tool is on the side against S_u x S_v
};

/// The listing's samples: u = i/nu, v = j/nv in single precision, so that u = 1 is never reached. [nu x nv]
[[nodiscard]] std::vector<Vec3> listing_samples(const geometry::ParametricSurface& patch,
                                                const ListingGrid& grid);

/// Throws Error as the view. Surface.dat: "x1 y1 x2 y2" per line; first the lines of constant i, then of
/// constant j.
[[nodiscard]] std::string surface_dat(const geometry::ParametricSurface& patch, const ListingGrid& grid);

/// How faithful the listing's mid-points are computed.
enum class ListingFaults {
    corrected, ///< listing angles, floating absolute value, correct forward equations
    all,       ///< early parenthesis and integer absolute value too
};

/// Mid-points of the actual trajectory, one per zigzag move (nu * nv - 1), by the listing's rules. Throws
/// Error where the surface has no normal.
[[nodiscard]] std::vector<Vec3> listing_mid_points(const geometry::ParametricSurface& patch,
                                                   const kinematics::RotaryTilt& machine,
                                                   const ListingGrid& grid,
                                                   ListingFaults faults);

/// The same on any machine: the angles of sequence() (sequencing.h). Throws Error as that.
[[nodiscard]] std::vector<Vec3> machine_mid_points(const geometry::ParametricSurface& patch,
                                                   const kinematics::MachineModel& machine,
                                                   const ListingGrid& grid);

/// Throws Error as the view. Toolpath.dat: mid-point line "x y " and end-point line " x y" per move.
/// `middles`: mid-points of the moves over `grid`.
[[nodiscard]] std::string toolpath_dat(const geometry::ParametricSurface& patch,
                                       const std::vector<Vec3>& middles,
                                       const ListingGrid& grid);

} // namespace millwright::toolpath
