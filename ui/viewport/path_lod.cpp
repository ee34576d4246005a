#include "ui/viewport/path_lod.h"

#include "ui/render/path_drawer.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <queue>
#include <set>

namespace millwright::viewport {

namespace {

using gcode::PathBlock;
using gcode::PathChunk;

constexpr double unseen_px = 0.4; // a line that is off by less looks the same
constexpr int exact = -1;         // in place of a level

struct Candidate {
    double error_px = 0.0; ///< of the level it has now
    std::uint32_t chunk = 0;
    std::uint32_t block = 0;
    int level = 0;

    friend bool operator<(const Candidate& a, const Candidate& b) { return a.error_px < b.error_px; }
};

/// The six planes of what a view sees; a point is inside of each where dot(plane, (p, 1)) >= 0.
std::array<glm::dvec4, 6> planes_of(const render::View& view) {
    const glm::dmat4 rows = glm::transpose(view.projection * view.view);
    std::array<glm::dvec4, 6> planes{rows[3] + rows[0],
                                     rows[3] - rows[0],
                                     rows[3] + rows[1],
                                     rows[3] - rows[1],
                                     rows[3] + rows[2],
                                     rows[3] - rows[2]};
    for (glm::dvec4& plane : planes) {
        plane /= glm::length(glm::dvec3(plane));
    }
    return planes;
}

struct Ball {
    glm::dvec3 middle{};
    double radius = 0.0;
};

Ball ball_around(const PathBlock& block) {
    const glm::dvec3 min(block.min[0], block.min[1], block.min[2]);
    const glm::dvec3 max(block.max[0], block.max[1], block.max[2]);
    return {0.5 * (min + max), 0.5 * glm::length(max - min)};
}

/// False only if all of the block's box is on the outer side of one of the planes.
bool in_sight(const PathBlock& block, const std::array<glm::dvec4, 6>& planes) {
    const std::array<std::array<float, 3>, 2> corners{block.min, block.max};
    return std::ranges::all_of(planes, [&](const glm::dvec4& plane) {
        glm::dvec4 innermost(0.0, 0.0, 0.0, 1.0); // the corner furthest along the plane's normal
        for (int axis = 0; axis < 3; ++axis) {
            innermost[axis] = corners[plane[axis] > 0.0 ? 1 : 0][static_cast<std::size_t>(axis)];
        }
        return glm::dot(plane, innermost) >= 0.0;
    });
}

/// Where it is largest: at the point of the ball that is nearest to the eye.
double error_px(const PathBlock& block, int level, const Ball& ball, const render::View& view) {
    const glm::dvec3 nearest = ball.middle - ball.radius * render::looking_along(view);
    const double pixel = std::max(render::pixel_length(view, nearest), 1e-9); // mm; behind the eye: exact
    return level == exact ? 0.0
                          : static_cast<double>(block.levels[static_cast<std::size_t>(level)].error) / pixel;
}

std::size_t points_of(const PathBlock& block, int level) {
    return level == exact ? block.count : block.levels[static_cast<std::size_t>(level)].count;
}

void append_indices(std::vector<std::uint16_t>& indices,
                    const PathChunk& chunk,
                    const PathBlock& block,
                    int level) {
    if (!indices.empty()) {
        indices.push_back(render::path_restart);
    }
    if (level == exact) {
        for (std::uint32_t n = block.first; n < block.first + block.count; ++n) {
            indices.push_back(static_cast<std::uint16_t>(n));
        }
        return;
    }
    const PathBlock::Level& chosen = block.levels[static_cast<std::size_t>(level)];
    const auto first = chunk.indices.begin() + chosen.first;
    indices.insert(indices.end(), first, first + chosen.count);
}

/// Where on the screen a stretch that is drawn as one line begins and ends, in squares; and its kind.
using Squares = std::array<std::int64_t, 5>;

std::optional<Squares>
squares_of(const PathChunk& chunk, const PathBlock& block, const render::View& view, double square_px) {
    constexpr int coarsest = static_cast<int>(PathBlock::coarse_levels) - 1;
    if (points_of(block, coarsest) != 2) {
        return std::nullopt;
    }
    const auto point = [&](std::uint32_t n) -> const gcode::PreviewPoint& {
        return chunk.points[block.first + n];
    };
    const auto seen = [&](std::uint32_t n) {
        const float* at = point(n).xyz();
        return render::project(view, {at[0], at[1], at[2]});
    };
    const auto from = seen(0);
    const auto to = seen(block.count - 1);
    if (!from || !to) {
        return std::nullopt;
    }
    const auto square = [&](double pixel) { return std::llround(pixel / square_px); };
    return Squares{square(from->pixel.x),
                   square(from->pixel.y),
                   square(to->pixel.x),
                   square(to->pixel.y),
                   static_cast<std::int64_t>(point(block.count - 1).kind())};
}

/// Of lines that look the same the first stays. `chosen` is in the order of the path.
void drop_covered(std::vector<Candidate>& chosen,
                  std::span<const std::shared_ptr<const PathChunk>> chunks,
                  const render::View& view,
                  double square_px) {
    constexpr int coarsest = static_cast<int>(PathBlock::coarse_levels) - 1;
    std::set<Squares> taken;
    std::erase_if(chosen, [&](const Candidate& one) {
        if (one.level != coarsest) {
            return false;
        }
        const PathChunk& chunk = *chunks[one.chunk];
        const auto squares = squares_of(chunk, chunk.blocks[one.block], view, square_px);
        return squares && !taken.insert(*squares).second;
    });
}

} // namespace

std::vector<std::vector<std::uint16_t>>
visible_pieces(std::span<const std::shared_ptr<const PathChunk>> chunks,
               const render::View& view,
               std::size_t most_points,
               double same_px) {
    const auto planes = planes_of(view);
    constexpr int coarsest = static_cast<int>(PathBlock::coarse_levels) - 1;
    std::priority_queue<Candidate> open;
    std::vector<Candidate> settled;
    std::size_t points = 0;
    for (std::uint32_t c = 0; c < chunks.size(); ++c) {
        for (std::uint32_t b = 0; b < chunks[c]->blocks.size(); ++b) {
            const PathBlock& block = chunks[c]->blocks[b];
            if (in_sight(block, planes)) {
                open.push({error_px(block, coarsest, ball_around(block), view), c, b, coarsest});
                points += points_of(block, coarsest);
            }
        }
    }
    while (!open.empty() && open.top().error_px > unseen_px) {
        Candidate worst = open.top();
        const PathBlock& block = chunks[worst.chunk]->blocks[worst.block];
        const std::size_t finer = points_of(block, worst.level - 1) - points_of(block, worst.level);
        open.pop();
        if (points + finer > most_points) {
            settled.push_back(worst);
            continue;
        }
        points += finer;
        --worst.level;
        worst.error_px = error_px(block, worst.level, ball_around(block), view);
        open.push(worst);
    }
    for (; !open.empty(); open.pop()) {
        settled.push_back(open.top());
    }
    std::ranges::sort(settled, [](const Candidate& a, const Candidate& b) {
        return a.chunk != b.chunk ? a.chunk < b.chunk : a.block < b.block;
    });
    if (same_px > 0.0) {
        drop_covered(settled, chunks, view, same_px);
    }
    std::vector<std::vector<std::uint16_t>> indices(chunks.size());
    for (const Candidate& chosen : settled) {
        const PathChunk& chunk = *chunks[chosen.chunk];
        append_indices(indices[chosen.chunk], chunk, chunk.blocks[chosen.block], chosen.level);
    }
    return indices;
}

} // namespace millwright::viewport
