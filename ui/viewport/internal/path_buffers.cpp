#include "ui/viewport/internal/path_buffers.h"

#include "ui/viewport/path_lod.h"

#include <algorithm>

namespace millwright::viewport {

namespace {

using gcode::PathChunk;

constexpr int chunks_per_update = 2; // about 2 ms each without a graphics card
// What takes a processor of 2 GHz about 25 and 100 ms without a graphics card.
constexpr double points_while_moving = 25'000.0;
constexpr double points_at_rest = 100'000.0;
// Of ten thousand passes from afar most cover each other: drawing them all takes longer than their points.
constexpr double same_while_moving_px = 1.0;

render::PathBuffer chunk_buffer(const PathChunk& chunk) {
    const glm::vec3 min(chunk.min[0], chunk.min[1], chunk.min[2]);
    const glm::vec3 max(chunk.max[0], chunk.max[1], chunk.max[2]);
    std::vector<render::PathVertex> vertices;
    vertices.reserve(chunk.points.size());
    for (const gcode::PreviewPoint& point : chunk.points) {
        vertices.push_back(
            render::path_vertex(point.xyz(), static_cast<std::uint16_t>(point.kind()), min, max));
    }
    return {vertices, min, max};
}

} // namespace

bool PathBuffers::follow(const std::vector<std::shared_ptr<const PathChunk>>& chunks) {
    const auto [ours, theirs] = std::mismatch(shown_.begin(), shown_.end(), chunks.begin(), chunks.end());
    const auto kept = static_cast<std::size_t>(ours - shown_.begin());
    shown_.resize(kept);
    buffers_.resize(kept);
    for (auto next = theirs; next != chunks.end(); ++next) {
        if (next - theirs == chunks_per_update) {
            return false;
        }
        shown_.push_back(*next);
        buffers_.push_back(chunk_buffer(**next));
    }
    return true;
}

void PathBuffers::clear() {
    buffers_.clear();
    shown_.clear();
}

void PathBuffers::draw(const Scene& scene,
                       const Canvas& canvas,
                       render::PathStyle style,
                       bool rough,
                       std::int64_t done,
                       double share) const {
    const double points = share * (rough ? points_while_moving : points_at_rest);
    const auto chosen = visible_pieces(shown_,
                                       path_view(canvas.view, scene),
                                       static_cast<std::size_t>(points),
                                       rough ? same_while_moving_px : 0.0);
    for (std::size_t k = 0; k < shown_.size(); ++k) {
        style.done =
            static_cast<int>(std::clamp<std::int64_t>(done - shown_[k]->first, -1, PathChunk::most_points));
        canvas.painter.path(buffers_[k], chosen[k], style, canvas.view);
    }
}

} // namespace millwright::viewport
