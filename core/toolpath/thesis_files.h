// The thesis's own result files and angle formulas, for comparison with the original.
// Source: Parasilmongkol 1997, listing (Surface.dat, Toolpath.dat) and ch. 3.
#pragma once

#include "core/geometry/bezier_patch.h"
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

/// The listing's samples: u = i/n, v = j/n in single precision, so that u = 1 is never reached. [n x n]
[[nodiscard]] std::vector<Vec3> listing_samples(const geometry::BezierPatch& patch, int n);

/// Throws Error as the view. Surface.dat: "x1 y1 x2 y2" a line; first the lines of constant i, then of
/// constant j.
[[nodiscard]] std::string surface_dat(const geometry::BezierPatch& patch, int n);

/// How faithful the listing's mid-points are computed.
enum class ListingFaults {
    corrected, ///< listing angles, floating absolute value, correct forward equations
    all,       ///< early parenthesis and integer absolute value too
};

/// Mid-points of the actual trajectory, one a zigzag move (n*n - 1), by the listing's rules.
[[nodiscard]] std::vector<Vec3> listing_mid_points(const geometry::BezierPatch& patch,
                                                   const kinematics::RotaryTilt& machine,
                                                   int n,
                                                   ListingFaults faults);

/// Throws Error as the view. Toolpath.dat: mid-point line "x y " and end-point line " x y" a move.
[[nodiscard]] std::string toolpath_dat(const geometry::BezierPatch& patch,
                                       const kinematics::RotaryTilt& machine,
                                       int n,
                                       ListingFaults faults);

} // namespace millwright::toolpath
