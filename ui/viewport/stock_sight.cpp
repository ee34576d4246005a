#include "ui/viewport/stock_sight.h"

#include "core/base/text.h"
#include "ui/render/convert.h"
#include "ui/viewport/internal/ray_triangle.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::viewport {

namespace {

constexpr glm::vec3 gouged{0.84F, 0.19F, 0.16F}, within{0.38F, 0.68F, 0.36F};
constexpr glm::vec3 little_excess{0.62F, 0.77F, 0.94F}, much_excess{0.16F, 0.38F, 0.78F};
constexpr glm::vec3 uncut{0.59F, 0.61F, 0.65F}, cut_beside{0.76F, 0.66F, 0.50F};
constexpr glm::vec3 in_section{0.42F, 0.36F, 0.33F};
constexpr double least_tolerance = 1e-6; // so that a legend has a range all the same

} // namespace

double stock_range(double tolerance) {
    constexpr double tolerances = 10.0;
    return tolerances * std::max(tolerance, least_tolerance);
}

glm::vec3 stock_color(double height, double tolerance) {
    if (height < -tolerance) {
        return gouged;
    }
    if (height <= tolerance) {
        return within;
    }
    const double range = stock_range(tolerance) - tolerance;
    return glm::mix(
        little_excess, much_excess, static_cast<float>(std::clamp((height - tolerance) / range, 0.0, 1.0)));
}

glm::vec3 stock_color(bool is_cut) {
    return is_cut ? cut_beside : uncut;
}

glm::vec3 stock_color(const plan::StockPicture& picture, std::size_t point, double tolerance) {
    const auto& height = picture.heights[point];
    const bool is_cut = picture.mesh.moves[point] != simulation::stock_surface;
    const bool is_compared = height && (is_cut || *height <= tolerance);
    return is_compared ? stock_color(*height, tolerance) : stock_color(is_cut);
}

glm::vec3 section_color() {
    return in_section;
}

std::optional<StockHit> pick_stock(const plan::StockPicture& picture,
                                   const render::Ray& ray,
                                   const Frame& s_T_w,
                                   const std::optional<StockSection>& section) {
    const Frame w_T_s = s_T_w.inverse();
    const Vec3 origin = w_T_s * render::to_core(ray.origin);
    const Vec3 direction = w_T_s.linear() * render::to_core(ray.direction);
    const auto at = [](const auto& of, int k) { return of[static_cast<std::size_t>(k)]; };
    const double before = section ? section->beyond(origin) : 0.0;
    const double slope = section ? section->beyond(origin + direction) - before : 0.0;
    const bool enters = before > 0.0 && slope < 0.0; // from the side that is taken away
    const double plane = enters ? -before / slope : 0.0;
    bool is_inside = false; // of the material, in the plane
    StockHit nearest{.distance = std::numeric_limits<double>::infinity()};
    for (const auto& [a, b, c] : picture.mesh.triangles) {
        const auto met = meet_triangle(origin,
                                       direction,
                                       at(picture.mesh.points, a),
                                       at(picture.mesh.points, b),
                                       at(picture.mesh.points, c));
        if (!met) {
            continue;
        }
        is_inside ^= enters && met->x() > plane;
        const Vec3 place = origin + met->x() * direction;
        if ((section && section->beyond(place) > 0.0) || met->x() >= nearest.distance) {
            continue;
        }
        const auto &ha = at(picture.heights, a), &hb = at(picture.heights, b), &hc = at(picture.heights, c);
        nearest.position = place;
        nearest.distance = met->x();
        nearest.height.reset();
        if (ha && hb && hc) {
            nearest.height = (1.0 - met->y() - met->z()) * *ha + met->y() * *hb + met->z() * *hc;
        }
    }
    if (enters && is_inside) {
        return StockHit{.position = origin + plane * direction, .distance = plane};
    }
    return std::isfinite(nearest.distance) ? std::optional(nearest) : std::nullopt;
}

std::string height_text(double height, double tolerance) {
    const std::string length = fixed(std::abs(height), 3) + " mm";
    if (height < -tolerance) {
        return "gouge " + length;
    }
    return height > tolerance ? "excess " + length
                              : "within tolerance: " + std::string(height < 0.0 ? "-" : "+") + length;
}

} // namespace millwright::viewport
