#include "core/geometry/mesh.h"

#include "core/base/error.h"
#include "core/geometry/trimmed_square.h"

#include <utility>

namespace millwright::geometry {

namespace {

/// The normal a little inside the patch, where an edge has collapsed to a point.
Vec3 normal_or_nearby(const ParametricSurface& patch, double u, double v, const SurfaceDerivatives& at) {
    if (const auto normal = patch.unit_normal(at)) {
        return *normal;
    }
    constexpr double towards_middle = 1e-3;
    const auto nearby = patch.unit_normal(u + towards_middle * (0.5 - u), v + towards_middle * (0.5 - v));
    return nearby.value_or(Vec3::UnitZ());
}

void add_point(Mesh& mesh, const ParametricSurface& patch, double u, double v) {
    const SurfaceDerivatives at = patch.derivatives(u, v);
    mesh.positions.push_back(at.position);
    mesh.normals.push_back(normal_or_nearby(patch, u, v, at));
    mesh.parameters.emplace_back(u, v);
}

} // namespace

Mesh tessellate(const ParametricSurface& patch, int nu, int nv) {
    expects(nu >= 1 && nv >= 1, "a mesh has cells");
    Mesh mesh;
    for (int i = 0; i <= nu; ++i) {
        for (int j = 0; j <= nv; ++j) {
            add_point(mesh, patch, static_cast<double>(i) / nu, static_cast<double>(j) / nv);
        }
    }
    for (int i = 0; i < nu; ++i) {
        for (int j = 0; j < nv; ++j) {
            const int a = i * (nv + 1) + j;
            const int b = a + nv + 1;
            mesh.triangles.push_back({a, b, b + 1});
            mesh.triangles.push_back({a, b + 1, a + 1});
        }
    }
    return mesh;
}

TrimmedMesh tessellate(const ParametricSurface& patch, const Trim& trim, int nu, int nv) {
    TrimmedSquare square = trimmed_square(trim, nu, nv);
    TrimmedMesh trimmed{.mesh = {}, .outside = std::move(square.outside)};
    for (const Vec2& uv : square.places) {
        add_point(trimmed.mesh, patch, uv.x(), uv.y());
    }
    trimmed.mesh.triangles = std::move(square.inside);
    return trimmed;
}

} // namespace millwright::geometry
