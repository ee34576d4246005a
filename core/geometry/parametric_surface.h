// A surface S(u,v) over [0,1]^2 as grids and tool paths see it: where it is, how it goes on from there and
// which way it faces. pieces() says what it is made of.
#pragma once

#include "core/geometry/vectors.h"

#include <memory>
#include <optional>
#include <vector>

namespace millwright::geometry {

class BezierPatch;
struct SurfacePiece;

/// mm per unit of the parameters.
struct SurfaceDerivatives {
    Vec3 position = Vec3::Zero();
    Vec3 du = Vec3::Zero();
    Vec3 dv = Vec3::Zero();
    Vec3 duu = Vec3::Zero();
    Vec3 duv = Vec3::Zero();
    Vec3 dvv = Vec3::Zero();
};

struct SurfacePoint {
    Vec3 position = Vec3::Zero();
    std::optional<Vec3> normal; ///< unit; nothing where the tangents vanish or are parallel
};

/// Immutable; may be asked from several threads.
class ParametricSurface {
public:
    virtual ~ParametricSurface() = default;

    [[nodiscard]] virtual Vec3 position(double u, double v) const = 0;
    [[nodiscard]] virtual SurfaceDerivatives derivatives(double u, double v) const = 0;
    /// The same bits as derivatives(u, v).position and unit_normal(u, v), without what is not asked for.
    [[nodiscard]] virtual SurfacePoint point(double u, double v) const = 0;

    /// Holds the whole surface; not the smallest box that does.
    [[nodiscard]] virtual const Box3& control_box() const = 0;
    /// Where S_u or S_v is not longer than this there is no normal, mm.
    [[nodiscard]] virtual double smallest_tangent() const = 0;
    /// Bezier patches that together are the same surface, exactly; those of several faces may be more of them
    /// than the surface covers.
    [[nodiscard]] virtual std::vector<SurfacePiece> pieces() const = 0;
    /// The same surface for someone who outlives this one.
    [[nodiscard]] virtual std::shared_ptr<const ParametricSurface> shared() const = 0;

    /// (S_u x S_v) / |S_u x S_v|; nothing where the tangents vanish or are parallel.
    [[nodiscard]] std::optional<Vec3> unit_normal(double u, double v) const { return point(u, v).normal; }
    /// The same from derivatives already at hand.
    [[nodiscard]] std::optional<Vec3> unit_normal(const SurfaceDerivatives& at) const;

protected:
    ParametricSurface() = default;
    ParametricSurface(const ParametricSurface&) = default;
    ParametricSurface(ParametricSurface&&) = default;
    ParametricSurface& operator=(const ParametricSurface&) = default;
    ParametricSurface& operator=(ParametricSurface&&) = default;
};

} // namespace millwright::geometry
