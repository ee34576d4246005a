#include "ui/viewport/picking.h"

#include "ui/render/convert.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/ray_triangle.h"

#include <Eigen/Geometry>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace millwright::viewport {

namespace {

constexpr int cells_per_side = 48;
constexpr std::size_t triangles_per_row = 2 * cells_per_side;
constexpr int path_steps = 8;
constexpr double loop_to_error = 1.5; // an actual path may lie so many of its errors beside its move

template <typename Use> void for_each_point(const geometry::Surface& surface, const Use& use) {
    for (int p = 0; p < surface.patch_count(); ++p) {
        const geometry::ControlNet& net = surface.patches()[static_cast<std::size_t>(p)].net();
        for (int i = 0; i < net.rows; ++i) {
            for (int j = 0; j < net.columns; ++j) {
                use(ControlPointId{geometry::PatchId{p}, i, j}, net.point(i, j));
            }
        }
    }
}

struct OnSegment {
    double distance = 0.0; ///< px
    double t = 0.0;
};

OnSegment nearest_on(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& pixel) {
    const glm::dvec2 ab = b - a;
    const double squared = glm::dot(ab, ab);
    const double t = squared > 0.0 ? std::clamp(glm::dot(pixel - a, ab) / squared, 0.0, 1.0) : 0.0;
    return {.distance = glm::length(a + t * ab - pixel), .t = t};
}

/// Looks for the path's place nearest to one pixel.
class PathSearch {
public:
    PathSearch(const Scene& scene,
               const render::View& view,
               const glm::dvec2& pixel,
               double within_px,
               double farthest_mm)
        : scene_(scene), view_(view), s_T_w_(scene_from_workpiece(scene)), pixel_(pixel), nearest_(within_px),
          farthest_(farthest_mm), eye_(render::ray(view, pixel)) {}

    void look_at(int move) {
        const auto& points = scene_.shown->toolpath.points;
        const auto from = static_cast<std::size_t>(move);
        if (points[from + 1].reached_by != toolpath::MoveKind::track || far_away(move)) {
            return;
        }
        if (scene_.layers.path.errors) {
            look_along(move, actual_tips(*scene_.cutting_setup, *scene_.shown, move, path_steps));
        } else {
            look_along(move,
                       on_surface(scene_.cutting_setup->patch,
                                  points[from].origin.uv,
                                  points[from + 1].origin.uv,
                                  path_steps));
        }
    }

    [[nodiscard]] const std::optional<PathHit>& found() const { return found_; }

private:
    [[nodiscard]] std::optional<glm::dvec2> on_screen(const Vec3& p_w) const {
        const auto seen = render::project(view_, render::to_glm(s_T_w_ * p_w));
        return seen ? std::optional(seen->pixel) : std::nullopt;
    }

    /// Neither the surface over the move nor the actual path comes near the pixel.
    [[nodiscard]] bool far_away(int move) const {
        const auto& points = scene_.shown->toolpath.points;
        const auto from = static_cast<std::size_t>(move);
        const auto a = on_screen(points[from].pose.tip);
        const auto b = on_screen(points[from + 1].pose.tip);
        if (!a || !b) {
            return true;
        }
        const double error = scene_.layers.path.errors ? scene_.shown->field.moves[from].param : 0.0;
        const double pixel = render::pixel_length(view_, render::to_glm(s_T_w_ * points[from].pose.tip));
        const double beside = 0.5 * glm::length(*b - *a) + loop_to_error * error / pixel;
        return nearest_on(*a, *b, pixel_).distance > nearest_ + beside;
    }

    void look_along(int move, const std::vector<Vec3>& points) {
        const auto steps = static_cast<double>(points.size() - 1);
        for (std::size_t k = 0; k + 1 < points.size(); ++k) {
            const auto a = on_screen(points[k]);
            const auto b = on_screen(points[k + 1]);
            if (!a || !b) {
                continue;
            }
            const OnSegment here = nearest_on(*a, *b, pixel_);
            const Vec3 place = (1.0 - here.t) * points[k] + here.t * points[k + 1];
            if (here.distance <= nearest_ && sight_of(place) <= farthest_) {
                nearest_ = here.distance;
                found_ = PathHit{.move = move, .fraction = (static_cast<double>(k) + here.t) / steps};
            }
        }
    }

    /// Along the line of sight, mm.
    [[nodiscard]] double sight_of(const Vec3& p_w) const {
        return glm::dot(render::to_glm(s_T_w_ * p_w) - eye_.origin, eye_.direction);
    }

    const Scene& scene_;
    const render::View& view_;
    Frame s_T_w_;
    glm::dvec2 pixel_;
    double nearest_;
    double farthest_;
    render::Ray eye_;
    std::optional<PathHit> found_;
};

std::vector<Eigen::AlignedBox3d> boxes_of_rows(const geometry::Mesh& mesh) {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        if (n % triangles_per_row == 0) {
            boxes.emplace_back();
        }
        for (const int corner : mesh.triangles[n]) {
            boxes.back().extend(mesh.positions[static_cast<std::size_t>(corner)]);
        }
    }
    return boxes;
}

/// Whether the ray may meet what lies in the box; by the slabs between its opposite sides.
bool meets(const Vec3& origin, const Vec3& direction, const Eigen::AlignedBox3d& box) {
    constexpr double rounding = 1e-9;
    const double margin = rounding * (1.0 + box.diagonal().norm() + (box.center() - origin).norm());
    double enters = 0.0;
    double leaves = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const double below = box.min()[k] - margin - origin[k];
        const double above = box.max()[k] + margin - origin[k];
        if (std::abs(direction[k]) > 0.0) {
            const auto [first, last] = std::minmax({below / direction[k], above / direction[k]});
            enters = std::max(enters, first);
            leaves = std::min(leaves, last);
        } else if (below > 0.0 || above < 0.0) {
            return false;
        }
    }
    return enters <= leaves;
}

} // namespace

std::optional<ControlPointId> pick_control_point(const geometry::Surface& surface,
                                                 const Frame& s_T_w,
                                                 const render::View& view,
                                                 const glm::dvec2& pixel,
                                                 double within_px) {
    constexpr double same_place_px = 0.5;
    std::optional<ControlPointId> found;
    double best = within_px;
    double best_depth = std::numeric_limits<double>::infinity();
    for_each_point(surface, [&](const ControlPointId& id, const Vec3& point) {
        const auto seen = render::project(view, render::to_glm(s_T_w * point));
        if (!seen) {
            return;
        }
        const double distance = glm::length(seen->pixel - pixel);
        const bool better =
            distance < best - same_place_px || (distance <= best + same_place_px && seen->depth < best_depth);
        if (distance <= within_px && better) {
            found = id;
            best = distance;
            best_depth = seen->depth;
        }
    });
    return found;
}

std::vector<ControlPointId> control_points_in(const geometry::Surface& surface,
                                              const Frame& s_T_w,
                                              const render::View& view,
                                              const glm::dvec2& corner,
                                              const glm::dvec2& opposite) {
    const glm::dvec2 low = glm::min(corner, opposite);
    const glm::dvec2 high = glm::max(corner, opposite);
    std::vector<ControlPointId> found;
    for_each_point(surface, [&](const ControlPointId& id, const Vec3& point) {
        const auto seen = render::project(view, render::to_glm(s_T_w * point));
        if (seen && glm::all(glm::lessThanEqual(low, seen->pixel)) &&
            glm::all(glm::lessThanEqual(seen->pixel, high))) {
            found.push_back(id);
        }
    });
    return found;
}

void SurfacePicker::follow(const std::shared_ptr<const geometry::Surface>& surface) {
    if (surface == surface_) {
        return;
    }
    surface_ = surface;
    parts_.clear();
    if (surface) {
        for (const geometry::ParametricSurface* part : surface->parts()) {
            geometry::Mesh mesh = geometry::tessellate(*part, cells_per_side, cells_per_side);
            std::vector<Eigen::AlignedBox3d> boxes = boxes_of_rows(mesh);
            parts_.push_back({.mesh = std::move(mesh), .boxes = std::move(boxes)});
        }
    }
}

std::optional<SurfaceHit> SurfacePicker::hit(const render::Ray& ray, const Frame& s_T_w) const {
    const Frame w_T_s = s_T_w.inverse();
    const Vec3 origin = w_T_s * render::to_core(ray.origin);
    const Vec3 direction = w_T_s.linear() * render::to_core(ray.direction);
    std::optional<SurfaceHit> nearest;
    const auto look_at = [&](std::size_t part, const std::array<int, 3>& triangle) {
        const geometry::Mesh& mesh = parts_[part].mesh;
        const auto [a, b, c] = triangle;
        const auto at = [](const auto& of, int k) { return of[static_cast<std::size_t>(k)]; };
        const auto met = meet_triangle(
            origin, direction, at(mesh.positions, a), at(mesh.positions, b), at(mesh.positions, c));
        if (met && (!nearest || met->x() < nearest->distance)) {
            const Vec2 uv = (1.0 - met->y() - met->z()) * at(mesh.parameters, a) +
                            met->y() * at(mesh.parameters, b) + met->z() * at(mesh.parameters, c);
            const geometry::PatchId patch{static_cast<int>(part)};
            nearest = SurfaceHit{.position = surface_->part(patch).position(uv.x(), uv.y()),
                                 .patch = patch,
                                 .uv = uv,
                                 .distance = met->x()};
        }
    };
    for (std::size_t part = 0; part < parts_.size(); ++part) {
        const auto& [mesh, boxes] = parts_[part];
        for (std::size_t row = 0; row < boxes.size(); ++row) {
            if (!meets(origin, direction, boxes[row])) {
                continue;
            }
            const std::size_t end = std::min(mesh.triangles.size(), (row + 1) * triangles_per_row);
            for (std::size_t n = row * triangles_per_row; n < end; ++n) {
                look_at(part, mesh.triangles[n]);
            }
        }
    }
    return nearest;
}

std::optional<int> pick_face(const plan::ReferenceMesh& reference,
                             const render::Ray& ray,
                             const Frame& s_T_w,
                             double farthest_mm) {
    const Frame w_T_s = s_T_w.inverse();
    const Vec3 origin = w_T_s * Vec3(ray.origin.x, ray.origin.y, ray.origin.z);
    const Vec3 direction = w_T_s.linear() * Vec3(ray.direction.x, ray.direction.y, ray.direction.z);
    const auto& points = reference.rest.points;
    std::optional<int> found;
    double nearest = farthest_mm;
    for (std::size_t n = 0; n < reference.faces.size(); ++n) {
        const auto& [a, b, c] = reference.rest.triangles[n];
        const auto met = meet_triangle(origin,
                                       direction,
                                       points[static_cast<std::size_t>(a)],
                                       points[static_cast<std::size_t>(b)],
                                       points[static_cast<std::size_t>(c)]);
        if (met && met->x() <= nearest) {
            nearest = met->x();
            found = reference.faces[n];
        }
    }
    return found;
}

std::optional<PathHit> pick_move(const Scene& scene,
                                 const render::View& view,
                                 const glm::dvec2& pixel,
                                 double within_px,
                                 std::optional<double> sight_mm,
                                 double hidden_mm) {
    if (!scene.shown || !scene.cutting_setup || !(scene.layers.path.intended || scene.layers.path.errors)) {
        return std::nullopt;
    }
    const double farthest = sight_mm ? *sight_mm + hidden_mm : std::numeric_limits<double>::infinity();
    PathSearch search(scene, view, pixel, within_px, farthest);
    const int moves = static_cast<int>(scene.shown->toolpath.points.size()) - 1;
    for (int move = 0; move < moves; ++move) {
        search.look_at(move);
    }
    return search.found();
}

} // namespace millwright::viewport
