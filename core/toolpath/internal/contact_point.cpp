#include "core/toolpath/internal/contact_point.h"

#include "core/base/error.h"

#include <fmt/format.h>

namespace millwright::toolpath {

PathPoint contact_point(const geometry::ParametricSurface& patch, const Vec2& uv, bool flipped) {
    const auto [position, normal] = patch.point(uv.x(), uv.y());
    if (!normal) {
        throw Error(
            fmt::format("the surface has no normal at u = {:.6g}, v = {:.6g}: its control points coincide "
                        "or its tangents are parallel there",
                        uv.x(),
                        uv.y()));
    }
    PathPoint point;
    point.contact = position;
    point.normal = flipped ? Vec3(-*normal) : *normal;
    point.pose = {point.contact, point.normal};
    point.origin.uv = uv;
    return point;
}

Vec2 place_with_normal(const geometry::ParametricSurface& patch,
                       const geometry::OutlineTree* outline,
                       const Vec2& uv) {
    if (outline == nullptr || patch.unit_normal(uv.x(), uv.y()) || outline->contains(uv)) {
        return uv;
    }
    constexpr double least = 1e-6, most = 1e-2; // of the patch's side
    for (double off = least; off <= most; off *= 10.0) {
        for (const Vec2& way : {Vec2(1, 1), Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)}) {
            const Vec2 beside = (uv + off * way).cwiseMax(0.0).cwiseMin(1.0);
            if (patch.unit_normal(beside.x(), beside.y())) {
                return beside;
            }
        }
    }
    return uv;
}

} // namespace millwright::toolpath
