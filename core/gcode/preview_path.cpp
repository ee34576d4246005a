#include "core/gcode/preview_path.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace millwright::gcode {

namespace {

constexpr std::uint32_t points_per_block = 1024;
constexpr std::array<std::uint32_t, PathBlock::coarse_levels> points_per_level{129, 17, 2};

/// Of a point to the straight line between two others, at its ends to these.
float distance_from_chord(const PreviewPoint& p, const PreviewPoint& a, const PreviewPoint& b) {
    std::array<float, 3> along{}, off{};
    float length = 0.0F, dot = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
        along[k] = b.xyz()[k] - a.xyz()[k];
        off[k] = p.xyz()[k] - a.xyz()[k];
        length += along[k] * along[k];
        dot += along[k] * off[k];
    }
    const float t = length > 0.0F ? std::clamp(dot / length, 0.0F, 1.0F) : 0.0F;
    float sum = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
        const float d = off[k] - t * along[k];
        sum += d * d;
    }
    return std::sqrt(sum);
}

/// A stretch between two kept points, with the point farthest from the straight line between them.
struct Stretch {
    float error = 0.0F;
    std::uint32_t from = 0, farthest = 0, to = 0;

    friend bool operator<(const Stretch& a, const Stretch& b) { return a.error < b.error; }
};

Stretch stretch_of(const PreviewPoint* points, std::uint32_t from, std::uint32_t to) {
    Stretch found{0.0F, from, from, to};
    for (std::uint32_t n = from + 1; n < to; ++n) {
        const float error = distance_from_chord(points[n], points[from], points[to]);
        if (error > found.error) {
            found.error = error;
            found.farthest = n;
        }
    }
    return found;
}

/// Douglas and Peucker's way: the point that is farthest off is taken next. Fills the levels from coarse to
/// fine.
void make_levels(const std::vector<PreviewPoint>& points,
                 PathBlock& block,
                 std::vector<std::uint16_t>& indices) {
    const PreviewPoint* own = points.data() + block.first;
    const std::uint32_t last = block.count - 1;
    std::vector<std::uint32_t> kept{0, last};
    std::priority_queue<Stretch> open;
    open.push(stretch_of(own, 0, last));
    for (std::size_t level = PathBlock::coarse_levels; level-- > 0;) {
        while (kept.size() < points_per_level[level] && open.top().error > 0.0F) {
            const Stretch worst = open.top();
            open.pop();
            kept.push_back(worst.farthest);
            open.push(stretch_of(own, worst.from, worst.farthest));
            open.push(stretch_of(own, worst.farthest, worst.to));
        }
        std::vector<std::uint32_t> sorted = kept;
        std::sort(sorted.begin(), sorted.end());
        block.levels[level] = {static_cast<std::uint32_t>(indices.size()),
                               static_cast<std::uint32_t>(sorted.size()),
                               open.top().error};
        for (const std::uint32_t n : sorted) {
            indices.push_back(static_cast<std::uint16_t>(block.first + n));
        }
    }
}

double move_length(const PathChunk& chunk, std::uint32_t end) {
    return (chunk.points[end].position() - chunk.points[end - 1].position()).norm();
}

/// From the beginning of `block` to its point `end`.
double length_until(const PathChunk& chunk, const PathBlock& block, std::uint32_t end) {
    double sum = 0.0;
    for (std::uint32_t n = block.first + 1; n <= end; ++n) {
        sum += move_length(chunk, n);
    }
    return sum;
}

Vec3 mixed(const Vec3& a, const Vec3& b, double t) {
    return (1.0 - t) * a + t * b;
}

template <class Boxed> void take_in(Boxed& box, const PreviewPoint& point) {
    for (std::size_t k = 0; k < 3; ++k) {
        box.min[k] = std::min(box.min[k], point.xyz()[k]);
        box.max[k] = std::max(box.max[k], point.xyz()[k]);
    }
}

template <class Boxed> void make_empty(Boxed& box) {
    box.min.fill(std::numeric_limits<float>::max());
    box.max.fill(std::numeric_limits<float>::lowest());
}

} // namespace

PreviewPoint::PreviewPoint(const Vec3& position, Step step, PathKind kind)
    : x_(static_cast<float>(position.x())), y_(static_cast<float>(position.y())),
      z_(static_cast<float>(position.z())), packed_(step | (static_cast<std::uint32_t>(kind) << step_bits)) {
    expects(step <= step_mask, "a path has less than 2^30 steps");
}

std::size_t PathChunk::bytes() const {
    return sizeof(PathChunk) + points.capacity() * sizeof(PreviewPoint) +
           blocks.capacity() * sizeof(PathBlock) + indices.capacity() * sizeof(std::uint16_t);
}

void PathChunker::add(const PreviewPoint& point, double seconds) {
    if (points_.capacity() == 0) {
        points_.reserve(PathChunk::most_points);
        seconds_.reserve(PathChunk::most_points);
    }
    points_.push_back(point);
    seconds_.push_back(static_cast<float>(seconds));
}

std::shared_ptr<const PathChunk> PathChunker::take_full() {
    return points_.size() < PathChunk::most_points ? nullptr : take();
}

std::shared_ptr<const PathChunk> PathChunker::take_rest() {
    return points_.size() < 2 ? nullptr : take();
}

std::shared_ptr<const PathChunk> PathChunker::take() {
    auto chunk = std::make_shared<PathChunk>();
    chunk->first = before_;
    chunk->points = points_;
    chunk->start_time = start_time_;
    make_empty(*chunk);
    const auto count = static_cast<std::uint32_t>(points_.size());
    double time = start_time_;
    for (std::uint32_t first = 0; first + 1 < count; first += points_per_block - 1) {
        PathBlock block;
        block.first = first;
        block.count = std::min(points_per_block, count - first);
        make_empty(block);
        for (std::uint32_t n = first; n < first + block.count; ++n) {
            take_in(block, points_[n]);
            take_in(*chunk, points_[n]);
        }
        block.start_time = time;
        for (std::uint32_t n = first + 1; n < first + block.count; ++n) {
            time += static_cast<double>(seconds_[n]);
        }
        make_levels(points_, block, chunk->indices);
        chunk->blocks.push_back(block);
    }
    chunk->indices.shrink_to_fit();
    chunk->blocks.shrink_to_fit();
    before_ += static_cast<std::int64_t>(points_.size()) - 1;
    points_.front() = points_.back();
    points_.resize(1);
    seconds_.assign(1, 0.0F);
    chunk->end_time = start_time_ = time;
    return chunk;
}

std::int64_t PreviewPath::point_count() const {
    return chunks.empty() ? 0 : chunks.back()->first + std::ssize(chunks.back()->points);
}

Box3 PreviewPath::bounds() const {
    Box3 box;
    for (const auto& chunk : chunks) {
        box.extend(Vec3(Eigen::Vector3f(chunk->min.data()).cast<double>()));
        box.extend(Vec3(Eigen::Vector3f(chunk->max.data()).cast<double>()));
    }
    return box;
}

const PathChunk& PreviewPath::chunk_of(std::int64_t n) const {
    expects(n >= 0 && n < point_count(), "a point of the path");
    const auto after = std::upper_bound(
        chunks.begin(), chunks.end(), n, [](std::int64_t k, const auto& chunk) { return k < chunk->first; });
    return **(after - 1);
}

const PreviewPoint& PreviewPath::point(std::int64_t n) const {
    const PathChunk& chunk = chunk_of(n);
    return chunk.points[static_cast<std::size_t>(n - chunk.first)];
}

Vec3 PreviewPath::position(const PathPlace& place) const {
    const Vec3 end = point(place.point).position();
    return place.point == 0 ? end : mixed(point(place.point - 1).position(), end, place.fraction);
}

PathPlace PreviewPath::place_at(double seconds) const {
    expects(!chunks.empty(), "a path that leads somewhere");
    const auto later =
        std::upper_bound(chunks.begin(), chunks.end(), seconds, [](double t, const auto& chunk) {
            return t < chunk->start_time;
        });
    const PathChunk& chunk = later == chunks.begin() ? *chunks.front() : **(later - 1);
    const auto after = std::upper_bound(
        chunk.blocks.begin(), chunk.blocks.end(), seconds, [](double t, const PathBlock& block) {
            return t < block.start_time;
        });
    const PathBlock& block = after == chunk.blocks.begin() ? chunk.blocks.front() : *(after - 1);
    const double end = after == chunk.blocks.end() ? chunk.end_time : after->start_time;
    const double share = end > block.start_time
                             ? std::clamp((seconds - block.start_time) / (end - block.start_time), 0.0, 1.0)
                             : 1.0;
    double left = share * length_until(chunk, block, block.first + block.count - 1);
    std::uint32_t n = block.first + 1;
    double piece = move_length(chunk, n);
    while (n + 1 < block.first + block.count && left > piece) {
        left -= piece;
        piece = move_length(chunk, ++n);
    }
    return {chunk.first + n, piece > 0.0 ? std::clamp(left / piece, 0.0, 1.0) : 1.0};
}

double PreviewPath::time_of(const PathPlace& place) const {
    const PathChunk& chunk = chunk_of(std::max<std::int64_t>(place.point - 1, 0));
    const auto n = static_cast<std::uint32_t>(place.point - chunk.first);
    const std::size_t b =
        std::min<std::size_t>(n > 0 ? (n - 1) / (points_per_block - 1) : 0, chunk.blocks.size() - 1);
    const PathBlock& block = chunk.blocks[b];
    const double end = b + 1 < chunk.blocks.size() ? chunk.blocks[b + 1].start_time : chunk.end_time;
    const double whole = length_until(chunk, block, block.first + block.count - 1);
    if (!(whole > 0.0) || n == 0) {
        return block.start_time;
    }
    const double done = length_until(chunk, block, n - 1) + place.fraction * move_length(chunk, n);
    return block.start_time + (end - block.start_time) * done / whole;
}

std::int64_t PreviewPath::first_point_from(Step step) const {
    const auto chunk = std::partition_point(
        chunks.begin(), chunks.end(), [&](const auto& c) { return c->points.back().step() < step; });
    if (chunk == chunks.end()) {
        return point_count();
    }
    const auto& points = (*chunk)->points;
    const auto point = std::partition_point(
        points.begin(), points.end(), [&](const PreviewPoint& p) { return p.step() < step; });
    return (*chunk)->first + (point - points.begin());
}

std::pair<std::int64_t, std::int64_t> PreviewPath::points_of(Step step) const {
    return {first_point_from(step), first_point_from(step + 1)};
}

std::size_t PreviewPath::bytes() const {
    std::size_t sum = 0;
    for (const auto& chunk : chunks) {
        sum += chunk->bytes();
    }
    return sum;
}

} // namespace millwright::gcode
