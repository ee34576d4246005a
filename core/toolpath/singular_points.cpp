#include "core/toolpath/singular_points.h"

#include "core/kinematics/inverse.h"

#include <algorithm>
#include <optional>

namespace millwright::toolpath {

namespace {

/// The part of N = S_u x S_v across the pole, with its derivatives: zero where the normal lies along the
/// pole.
struct NormalAcross {
    Vec2 value;
    Eigen::Matrix2d derivative;
    double normal_length;
};

NormalAcross
across(const geometry::ParametricSurface& patch, const Vec2& uv, const Vec3& e1, const Vec3& e2) {
    const auto s = patch.derivatives(uv.x(), uv.y());
    const Vec3 N = s.du.cross(s.dv);
    const Vec3 N_u = s.duu.cross(s.dv) + s.du.cross(s.duv);
    const Vec3 N_v = s.duv.cross(s.dv) + s.du.cross(s.dvv);
    NormalAcross result{{N.dot(e1), N.dot(e2)}, Eigen::Matrix2d::Zero(), N.norm()};
    result.derivative << N_u.dot(e1), N_v.dot(e1), N_u.dot(e2), N_v.dot(e2);
    return result;
}

/// Newton inside the square from `uv`; nothing if it does not arrive.
std::optional<Vec2>
descend_to_pole(const geometry::ParametricSurface& patch, Vec2 uv, const Vec3& e1, const Vec3& e2) {
    constexpr int most_steps = 40;
    constexpr double on_pole = 1e-10; // rad between normal and pole
    constexpr double longest_step = 0.1;
    for (int n = 0; n < most_steps; ++n) {
        const NormalAcross at = across(patch, uv, e1, e2);
        if (!(at.normal_length > 0.0)) {
            return std::nullopt;
        }
        if (at.value.norm() < on_pole * at.normal_length) {
            return uv;
        }
        const double det = at.derivative.determinant();
        if (!(std::abs(det) > 1e-14 * at.derivative.squaredNorm())) {
            return std::nullopt;
        }
        Vec2 step = -(at.derivative.inverse() * at.value);
        step *= std::min(1.0, longest_step / step.norm());
        uv = (uv + step).cwiseMax(0.0).cwiseMin(1.0);
    }
    return std::nullopt;
}

} // namespace

std::vector<SingularPoint> singular_points(const geometry::ParametricSurface& patch,
                                           const kinematics::MachineModel& machine) {
    std::vector<SingularPoint> found;
    if (machine.rotary_axes().size() != 2) {
        return found;
    }
    const Vec3 pole = kinematics::pole_direction(machine);
    const Vec3 e1 = pole.unitOrthogonal();
    const Vec3 e2 = pole.cross(e1);
    constexpr int raster = 24;
    constexpr double same = 1e-6; // of the parameters
    for (int i = 0; i < raster; ++i) {
        for (int j = 0; j < raster; ++j) {
            const auto uv = descend_to_pole(patch, {(i + 0.5) / raster, (j + 0.5) / raster}, e1, e2);
            const auto known = [&](const SingularPoint& p) { return (p.uv - *uv).norm() < same; };
            if (uv && std::none_of(found.begin(), found.end(), known)) {
                found.push_back({*uv, patch.position(uv->x(), uv->y())});
            }
        }
    }
    std::sort(found.begin(), found.end(), [](const SingularPoint& a, const SingularPoint& b) {
        return std::abs(a.uv.x() - b.uv.x()) > same ? a.uv.x() < b.uv.x() : a.uv.y() < b.uv.y();
    });
    return found;
}

} // namespace millwright::toolpath
