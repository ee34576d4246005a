// Views and their pixels.
#pragma once

#include "ui/render/camera.h"
#include "ui/render/convert.h"

namespace millwright::test {

inline constexpr render::PixelSize view_size = {640, 480};
inline constexpr double exact_mm = 1e-9; ///< a way through the view's matrices and their inverse

inline glm::dvec2 pixel_of(const render::View& view, const Vec3& p) {
    return render::project(view, render::to_glm(p)).value().pixel;
}

} // namespace millwright::test
