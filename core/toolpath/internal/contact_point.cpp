#include "core/toolpath/internal/contact_point.h"

#include "core/base/error.h"

#include <fmt/format.h>

namespace millwright::toolpath {

PathPoint contact_point(const geometry::BezierPatch& patch, const Vec2& uv, bool flipped) {
    const geometry::SurfaceDerivatives at = patch.derivatives(uv.x(), uv.y());
    const auto normal = patch.unit_normal(at);
    if (!normal) {
        throw Error(
            fmt::format("the surface has no normal at u = {:.6g}, v = {:.6g}: its control points coincide "
                        "or its tangents are parallel there",
                        uv.x(),
                        uv.y()));
    }
    PathPoint point;
    point.contact = at.position;
    point.normal = flipped ? Vec3(-*normal) : *normal;
    point.pose = {point.contact, point.normal};
    point.origin.uv = uv;
    return point;
}

} // namespace millwright::toolpath
