#include "core/motion/internal/axis_way.h"

#include <algorithm>
#include <cmath>

namespace millwright::motion::internal {

namespace {

double position_at(const Path& path, int block, int axis, double offset) {
    return path.at(block, offset).position[axis];
}

/// Bisection to the last bit: where `rises` in [begin, end] passes from false to true.
template <class Passed> double place_of(double begin, double end, Passed passed) {
    for (;;) {
        const double middle = 0.5 * (begin + end);
        if (!(middle > begin && middle < end)) {
            return middle;
        }
        (passed(middle) ? end : begin) = middle;
    }
}

/// Cuts a rounding where the axis stands still for a moment.
void add_rounding(const Path& path, int block, int axis, const Part& part, std::vector<Part>& parts) {
    const double in = path.at(block, part.begin).first[axis];
    const double out = path.at(block, part.end).first[axis];
    if (in * out < 0.0) {
        const double turn = place_of(part.begin, part.end, [&](double offset) {
            return path.at(block, offset).first[axis] * in < 0.0;
        });
        parts.push_back({part.begin, turn});
        parts.push_back({turn, part.end});
    } else {
        parts.push_back(part);
    }
}

} // namespace

std::vector<Part> monotone_parts(const Path& path, int block, int axis, const Part& whole) {
    const Segment& segment = path.segments[static_cast<std::size_t>(block)];
    std::vector<Part> parts;
    const auto inside = [&](double begin, double end) {
        return Part{std::max(begin, whole.begin), std::min(end, whole.end)};
    };
    const double straight_end = segment.length - segment.rounding_end;
    if (const Part in = inside(0.0, segment.rounding_start); in.begin < in.end) {
        add_rounding(path, block, axis, in, parts);
    }
    if (const Part straight = inside(segment.rounding_start, straight_end); straight.begin < straight.end) {
        parts.push_back(straight);
    }
    if (const Part out = inside(straight_end, segment.length);
        out.begin < out.end && segment.rounding_end > 0.0) {
        add_rounding(path, block, axis, out, parts);
    }
    return parts;
}

double offset_of(const Path& path, int block, int axis, const Part& part, double position) {
    const Segment& segment = path.segments[static_cast<std::size_t>(block)];
    const double from = position_at(path, block, axis, part.begin);
    const double to = position_at(path, block, axis, part.end);
    if (!(part.begin < segment.rounding_start) && !(part.end > segment.length - segment.rounding_end)) {
        const double share = std::clamp((position - from) / (to - from), 0.0, 1.0);
        return std::lerp(part.begin, part.end, share);
    }
    const double sense = to > from ? 1.0 : -1.0;
    return place_of(part.begin, part.end, [&](double offset) {
        return sense * (position_at(path, block, axis, offset) - position) > 0.0;
    });
}

} // namespace millwright::motion::internal
