#include "ui/viewport/program_picking.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace millwright::viewport {

namespace {

using gcode::PathBlock;
using gcode::PathChunk;

constexpr double as_near_px = 0.5;

class PathPick {
public:
    PathPick(const render::View& view, const glm::dvec2& pixel, double within_px)
        : view_(view), clip_from_scene_(view.projection * view.view), pixel_(pixel), within_(within_px) {}

    /// Whether anything in the box may lie near enough.
    [[nodiscard]] bool may_hit(const PathBlock& block) const {
        glm::dvec2 low(std::numeric_limits<double>::max());
        glm::dvec2 high(std::numeric_limits<double>::lowest());
        for (unsigned corner = 0; corner < 8; ++corner) {
            const glm::dvec4 clip =
                clip_from_scene_ *
                glm::dvec4(side(block, corner, 0), side(block, corner, 1), side(block, corner, 2), 1.0);
            if (clip.w <= 0.0) {
                return true; // around the eye: no telling
            }
            low = glm::min(low, pixel_of(clip));
            high = glm::max(high, pixel_of(clip));
        }
        return pixel_.x >= low.x - within_ && pixel_.x <= high.x + within_ && pixel_.y >= low.y - within_ &&
               pixel_.y <= high.y + within_;
    }

    void look_at(const PathChunk& chunk, const PathBlock& block) {
        glm::dvec4 before = clip_of(chunk.points[block.first]);
        for (std::uint32_t n = block.first + 1; n < block.first + block.count; ++n) {
            const glm::dvec4 here = clip_of(chunk.points[n]);
            if (before.w > 0.0 && here.w > 0.0 && chunk.points[n].kind() != gcode::PathKind::start) {
                look_at(before, here, chunk.first + n);
            }
            before = here;
        }
    }

    [[nodiscard]] std::optional<gcode::PathPlace> found() const { return found_; }

private:
    static double side(const PathBlock& block, unsigned corner, unsigned axis) {
        return static_cast<double>((corner >> axis & 1U) != 0 ? block.max[axis] : block.min[axis]);
    }

    [[nodiscard]] glm::dvec4 clip_of(const gcode::PreviewPoint& point) const {
        const float* p = point.xyz();
        return clip_from_scene_ * glm::dvec4(p[0], p[1], p[2], 1.0);
    }

    [[nodiscard]] glm::dvec2 pixel_of(const glm::dvec4& clip) const {
        return {0.5 * (1.0 + clip.x / clip.w) * view_.size.width,
                0.5 * (1.0 - clip.y / clip.w) * view_.size.height};
    }

    void look_at(const glm::dvec4& from, const glm::dvec4& to, std::int64_t point) {
        const glm::dvec2 a = pixel_of(from);
        const glm::dvec2 along = pixel_of(to) - a;
        const double length = glm::dot(along, along);
        const double t = length > 0.0 ? std::clamp(glm::dot(pixel_ - a, along) / length, 0.0, 1.0) : 1.0;
        const double away = glm::distance(pixel_, a + t * along);
        const double depth = glm::mix(from.z / from.w, to.z / to.w, t);
        const bool nearer = away < away_ - as_near_px || (away < away_ + as_near_px && depth < depth_);
        if (away <= within_ && (!found_ || nearer)) {
            away_ = away;
            depth_ = depth;
            found_ = gcode::PathPlace{point, fraction_at(from, to, t)};
        }
    }

    /// The middle of a piece on the screen is not the middle of the piece.
    static double fraction_at(const glm::dvec4& from, const glm::dvec4& to, double t) {
        return t * from.w / (t * from.w + (1.0 - t) * to.w);
    }

    const render::View& view_;
    glm::dmat4 clip_from_scene_;
    glm::dvec2 pixel_;
    double within_;
    double away_ = 0.0, depth_ = 0.0;
    std::optional<gcode::PathPlace> found_;
};

} // namespace

std::optional<gcode::PathPlace> pick_path(const gcode::PreviewPath& path,
                                          const render::View& view,
                                          const glm::dvec2& pixel,
                                          double within_px,
                                          std::size_t most_points) {
    PathPick pick(view, pixel, within_px);
    std::size_t points = 0;
    for (const auto& chunk : path.chunks) {
        for (const PathBlock& block : chunk->blocks) {
            if (!pick.may_hit(block)) {
                continue;
            }
            points += block.count;
            if (points > most_points) {
                return std::nullopt;
            }
            pick.look_at(*chunk, block);
        }
    }
    return pick.found();
}

} // namespace millwright::viewport
