#include "core/plot/picture/internal/tip_surface.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::plot::internal {
namespace {

constexpr float nothing = -std::numeric_limits<float>::infinity();

float rounded_up(double value) {
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) < value
               ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
               : nearest;
}

/// A straight line above f over an interval, by its values at both ends.
struct Line {
    double left = -std::numeric_limits<double>::infinity();
    double right = left;
};

/// Over [left, right] along x, of a pixel at 0 of height 0 that lies `dy` beside the way.
Line line_above(const ToolTip& tip, double left, double right, double dy) {
    const double nearest = std::hypot(std::clamp(0.0, left, right), dy);
    const double most = -rise(tip, nearest);
    if (!std::isfinite(most)) {
        return {};
    }
    const double middle = (left + right) / 2.0;
    const double distance = std::hypot(middle, dy);
    if (!(distance > 0.0) || !(distance < radius(tip))) {
        return {most, most};
    }
    const double f = -rise(tip, distance);
    const double climb = -rise_slope(tip, distance) * middle / distance * (right - left) / 2.0;
    const Line tangent{f - climb, f + climb};
    // Steep at the rim of a ball: there the tangent leaves f farther than a level line does.
    const bool close = std::max(tangent.left, tangent.right) - most <= (most - f) / 2.0;
    return close ? tangent : Line{most, most};
}

// Of a pixel, in rows: one that the tool's rim just touches belongs to it.
constexpr double touch = 1e-9;

// Columns at a time: what is read and written then stays in the first cache.
constexpr Eigen::Index tile = 2048;

/// to[j] = max(to[j], from[j + shift] + bound) where there is such a pixel.
void raise(
    std::span<const float> from, int shift, float bound, Eigen::Index begin, Eigen::Index end, float* to) {
    const auto width = static_cast<Eigen::Index>(from.size());
    begin = std::max<Eigen::Index>(begin, -shift);
    end = std::min<Eigen::Index>(end, width - shift);
    if (begin < end) {
        const Eigen::Map<const Eigen::ArrayXf> pixels(from.data() + begin + shift, end - begin);
        Eigen::Map<Eigen::ArrayXf> bounds(to + begin, end - begin);
        bounds = bounds.max(pixels + bound);
    }
}

/// Raises nodes until the way between neighbours at `part` is not below `bounds`; the lower one first, and
/// none above its bound unless it is there already.
void raise_between(const std::vector<float>& bounds, float part, std::vector<float>& nodes) {
    for (std::size_t j = 0; j + 1 < nodes.size(); ++j) {
        const float bound = bounds[j];
        const bool falls = nodes[j] > nodes[j + 1];
        float& low = falls ? nodes[j + 1] : nodes[j];
        float& high = falls ? nodes[j] : nodes[j + 1];
        const float weight = falls ? part : 1.0F - part; // of the lower one
        if (weight * low + (1.0F - weight) * high < bound) {
            high = std::max(high, bound);
            low = std::max(low, (bound - (1.0F - weight) * high) / weight);
        }
    }
}

/// Parts of the way between columns: where pixels are large beside the tool, straight lines leave more.
int parts_for(const ToolTip& tip, double pitch) {
    constexpr double fine = 8.0; // pixels a radius
    const bool straight = tip.kind == TipKind::point || tip.kind == TipKind::flat;
    return straight || radius(tip) > fine * pitch ? 2 : 4;
}

} // namespace

TipSurface::TipSurface(const HeightField& field, const ToolTip& tip)
    : field_(field), tip_(tip), parts_(parts_for(tip, field.pitch)) {
    const auto [low, high] = std::ranges::minmax(field.z);
    lowest_ = low;
    highest_ = high;
}

std::vector<TipSurface::Bound> TipSurface::bounds(double dy) const {
    const double pitch = field_.pitch;
    const double part = pitch / parts_;
    const int reach = static_cast<int>(std::ceil(radius(tip_) / pitch)) + 1;
    std::vector<Bound> found;
    for (int shift = -reach; shift <= reach; ++shift) {
        for (int place = 0; place < parts_; ++place) {
            const double at = -shift * pitch + place * part; // seen from the pixel
            const Line before = line_above(tip_, at - part, at, dy);
            const Line behind = line_above(tip_, at, at + part, dy);
            const float height = rounded_up(std::max(before.right, behind.left));
            // What cannot reach above the lowest pixel even from the highest one bounds nothing.
            if (height + highest_ > lowest_) {
                found.push_back({shift, place, height});
            }
        }
    }
    return found;
}

void TipSurface::raise_to_field(double y, std::vector<float>& nodes) const {
    const double row = std::clamp(field_.rows - 1 - y / field_.pitch, 0.0, field_.rows - 1.0);
    const int above = static_cast<int>(row);
    const auto part = static_cast<float>(row - above);
    const auto upper = field_.row(above);
    const auto lower = field_.row(std::min(above + 1, field_.rows - 1));
    for (std::size_t j = 0; j < nodes.size(); ++j) {
        nodes[j] = std::max(nodes[j], upper[j] + part * (lower[j] - upper[j]));
    }
}

std::vector<float> TipSurface::row(double y) const {
    const auto width = static_cast<std::size_t>(field_.columns);
    std::vector<float> nodes(width, nothing);
    raise_to_field(y, nodes);
    if (tip_.kind == TipKind::point) {
        return nodes;
    }
    std::vector<std::vector<float>> places(static_cast<std::size_t>(parts_),
                                           std::vector<float>(width, lowest_));
    places[0].swap(nodes);
    const double reach = radius(tip_) / field_.pitch;
    const double middle_row = field_.rows - 1 - y / field_.pitch;
    const int first = std::max(0, static_cast<int>(std::ceil(middle_row - reach - touch)));
    const int last = std::min(field_.rows - 1, static_cast<int>(std::floor(middle_row + reach + touch)));
    for (int i = first; i <= last; ++i) {
        const std::vector<Bound> kernel = bounds(field_.y_of_row(i) - y);
        for (Eigen::Index begin = 0; begin < field_.columns; begin += tile) {
            const Eigen::Index end = std::min<Eigen::Index>(begin + tile, field_.columns);
            for (const Bound& bound : kernel) {
                float* to = places[static_cast<std::size_t>(bound.place)].data();
                raise(field_.row(i), bound.shift, bound.height, begin, end, to);
            }
        }
    }
    nodes.swap(places[0]);
    raise_between(places[static_cast<std::size_t>(parts_ / 2)], 0.5F, nodes);
    for (int place = 1; place < parts_; ++place) {
        raise_between(places[static_cast<std::size_t>(place)],
                      static_cast<float>(place) / static_cast<float>(parts_),
                      nodes);
    }
    return nodes;
}

double TipSurface::highest_between(int column, double y_from, double y_to) const {
    const double low = std::min(y_from, y_to);
    const double high = std::max(y_from, y_to);
    const double r = radius(tip_);
    const double pitch = field_.pitch;
    const int reach = static_cast<int>(r / pitch + touch);
    // A point goes straight from row to row: only rows in between count.
    const double rim = r > 0.0 ? touch : -touch;
    const int top = std::max(0, static_cast<int>(std::ceil(field_.rows - 1 - (high + r) / pitch - rim)));
    const int bottom =
        std::min(field_.rows - 1, static_cast<int>(std::floor(field_.rows - 1 - (low - r) / pitch + rim)));
    auto found = static_cast<double>(lowest_);
    for (int i = top; i <= bottom; ++i) {
        const double y = field_.y_of_row(i);
        const double dy = y - std::clamp(y, low, high);
        const auto pixels = field_.row(i);
        for (int j = std::max(0, column - reach); j <= std::min(field_.columns - 1, column + reach); ++j) {
            const double up = rise(tip_, std::hypot((j - column) * pitch, dy));
            found = std::max(found, static_cast<double>(pixels[static_cast<std::size_t>(j)]) - up);
        }
    }
    return found;
}

} // namespace millwright::plot::internal
