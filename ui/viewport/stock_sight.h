// What is left of a stock in a picture: its colours by comparison with the part, and the place under the
// mouse. Lengths mm, colours sRGB.
#pragma once

#include "ui/render/view.h"
#include "ui/viewport/scene.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace millwright::viewport {

/// Gouged beyond the tolerance red, within it green, beyond it blue: pale just above it, strong at
/// stock_range().
[[nodiscard]] glm::vec3 stock_color(double height, double tolerance);
/// Of material in the plane of a section.
[[nodiscard]] glm::vec3 section_color();
/// Of the stock's own surface where it is in excess or beside the part, and of a cut beside the part.
[[nodiscard]] glm::vec3 stock_color(bool is_cut);
/// Of a point of the mesh.
[[nodiscard]] glm::vec3 stock_color(const plan::StockPicture& picture, std::size_t point, double tolerance);

/// Largest height of the legend, both ways: ten tolerances.
[[nodiscard]] double stock_range(double tolerance);

/// A place of what is left on a line of sight.
struct StockHit {
    Vec3 position = Vec3::Zero();   ///< workpiece
    std::optional<double> height{}; ///< over the part; nothing beside it
    double distance = 0.0;          ///< from the ray's origin
};

/// The first meeting of the ray (scene) with the mesh. The height is blended between its corners.
/// Of material in the plane of a section there is none.
[[nodiscard]] std::optional<StockHit> pick_stock(const plan::StockPicture& picture,
                                                 const render::Ray& ray,
                                                 const Frame& s_T_w,
                                                 const std::optional<StockSection>& section = {});

/// "excess 0.120 mm", "gouge 0.030 mm"; "within tolerance: +0.012 mm".
[[nodiscard]] std::string height_text(double height, double tolerance);

} // namespace millwright::viewport
