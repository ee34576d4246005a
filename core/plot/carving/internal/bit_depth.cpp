#include "core/plot/carving/internal/bit_depth.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::plot::internal {
namespace {

/// Where a value that is straight between its ends passes `levels`, and both ends: 0 to 1, ascending.
std::vector<double> shares_at(double from, double to, std::initializer_list<double> levels) {
    std::vector<double> shares{0.0, 1.0};
    for (const double level : levels) {
        if ((from < level && level < to) || (to < level && level < from)) {
            shares.push_back((level - from) / (to - from));
        }
    }
    std::ranges::sort(shares);
    return shares;
}

void end_line(CutLine& line, std::vector<CutLine>& lines) {
    if (line.size() > 1) {
        lines.push_back(std::move(line));
    }
    line.clear();
}

} // namespace

BitDepth::BitDepth(const ToolTip& tip, double largest, double tolerance)
    : tip_(tip), largest_(std::min(largest, rise(tip, radius(tip)))), widest_(mouth_radius(tip, largest_)),
      tolerance_(tolerance) {}

double BitDepth::depth(double clearance) const {
    return clearance < widest_ ? rise(tip_, clearance) : largest_;
}

/// A round end is not as straight as the clearance: places are added where the depth, or the width that is
/// cut at the top, would be another.
void BitDepth::add_between(const Vec3& from, const Vec3& to, int halvings, CutLine& line) const {
    const Vec3 middle = 0.5 * (from + to);
    const double straight = 0.5 * (depth(from.z()) + depth(to.z()));
    const double off =
        std::max(std::abs(depth(middle.z()) - straight), mouth_radius(tip_, straight) - middle.z());
    if (tip_.end_radius > 0.0 && middle.z() < widest_ && halvings > 0 && off > 0.5 * tolerance_) {
        add_between(from, middle, halvings - 1, line);
        add_between(middle, to, halvings - 1, line);
        return;
    }
    line.emplace_back(to.x(), to.y(), -depth(to.z()));
}

std::vector<CutLine> BitDepth::cuts_along(const std::vector<Vec3>& way, bool on_floor) const {
    std::vector<CutLine> lines;
    const auto place = [&](const Vec3& at) { return Vec3(at.x(), at.y(), -depth(at.z())); };
    const auto cuts = [&](double clearance) {
        return clearance > narrowest() && (clearance <= widest_ || on_floor);
    };
    if (way.size() == 1) {
        if (cuts(way.front().z())) {
            lines.push_back({place(way.front())});
        }
        return lines;
    }
    CutLine line;
    for (std::size_t n = 1; n < way.size(); ++n) {
        const Vec3& from = way[n - 1];
        const Vec3& to = way[n];
        const std::vector<double> shares = shares_at(from.z(), to.z(), {narrowest(), widest_});
        for (std::size_t k = 1; k < shares.size(); ++k) {
            const Vec3 a = from + shares[k - 1] * (to - from);
            const Vec3 b = from + shares[k] * (to - from);
            if (!cuts(0.5 * (a.z() + b.z()))) {
                end_line(line, lines);
                continue;
            }
            if (line.empty()) {
                line.push_back(place(a));
            }
            constexpr int most_halvings = 20;
            add_between(a, b, most_halvings, line);
        }
    }
    end_line(line, lines);
    return lines;
}

std::vector<CutLine> pass_of(const CutLine& line, double above, double below) {
    const auto lifted = [&](const Vec3& at) { return Vec3(at.x(), at.y(), std::max(at.z(), -below)); };
    std::vector<CutLine> lines;
    if (line.size() == 1) {
        if (-line.front().z() > above) {
            lines.push_back({lifted(line.front())});
        }
        return lines;
    }
    CutLine now;
    for (std::size_t n = 1; n < line.size(); ++n) {
        const Vec3& from = line[n - 1];
        const Vec3& to = line[n];
        const std::vector<double> shares = shares_at(from.z(), to.z(), {-above, -below});
        for (std::size_t k = 1; k < shares.size(); ++k) {
            const Vec3 a = from + shares[k - 1] * (to - from);
            const Vec3 b = from + shares[k] * (to - from);
            if (!(-0.5 * (a.z() + b.z()) > above)) {
                end_line(now, lines);
                continue;
            }
            if (now.empty()) {
                now.push_back(lifted(a));
            }
            now.push_back(lifted(b));
        }
    }
    end_line(now, lines);
    return lines;
}

} // namespace millwright::plot::internal
