#include "ui/viewport/stock_section.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace millwright::viewport {

namespace {

using Corner = SectionedMesh::Corner;

/// Where the surface passes through the plane.
struct Segment {
    Vec3 from, to;
};

/// Cuts triangles at a plane, one after the other.
class Cutter {
public:
    Cutter(const simulation::CutMesh& mesh, const StockSection& section) : mesh_(mesh), section_(section) {}

    void add(const std::array<int, 3>& triangle) {
        std::array<double, 3> beyond{};
        for (std::size_t n = 0; n < 3; ++n) {
            beyond[n] = section_.beyond(point(triangle[n]));
        }
        std::array<Corner, 4> kept{};
        std::array<Vec3, 2> crossed;
        std::size_t corners = 0, crossings = 0;
        for (std::size_t n = 0; n < 3; ++n) {
            const std::size_t next = (n + 1) % 3;
            const bool is_kept = beyond[n] <= 0.0;
            if (is_kept) {
                kept[corners++] = {triangle[n], triangle[n], 0.0};
            }
            if (is_kept != (beyond[next] <= 0.0)) {
                kept[corners] = crossing(triangle[n], triangle[next]);
                crossed[std::min<std::size_t>(crossings++, 1)] = place(kept[corners++]);
            }
        }
        for (std::size_t n = 2; n < corners; ++n) {
            put({kept[0], kept[n - 1], kept[n]});
        }
        if (crossings == 2) {
            segments_.push_back({crossed[0], crossed[1]});
        }
    }

    [[nodiscard]] const std::vector<Segment>& segments() const { return segments_; }
    [[nodiscard]] SectionedMesh take() { return std::move(made_); }

private:
    [[nodiscard]] const Vec3& point(int n) const { return mesh_.points[static_cast<std::size_t>(n)]; }
    [[nodiscard]] Vec3 place(const Corner& corner) const {
        return point(corner.from) + corner.share * (point(corner.to) - point(corner.from));
    }
    /// To the last bit the same for both triangles that have the edge.
    [[nodiscard]] Corner crossing(int a, int b) const {
        const int from = std::min(a, b), to = std::max(a, b);
        const double start = section_.beyond(point(from)), end = section_.beyond(point(to));
        return {from, to, start / (start - end)};
    }
    void put(const std::array<Corner, 3>& corners) {
        std::array<int, 3> triangle{};
        for (std::size_t n = 0; n < 3; ++n) {
            triangle[n] = static_cast<int>(made_.corners.size());
            made_.corners.push_back(corners[n]);
        }
        made_.triangles.push_back(triangle);
    }

    const simulation::CutMesh& mesh_;
    const StockSection& section_;
    std::vector<Segment> segments_;
    SectionedMesh made_;
};

/// Of the two axes of the plane: strips lie along `along`, one behind the other along `across`.
struct PlaneAxes {
    int along = 0, across = 1;
};

/// Between the crossings of the middle line of each strip, in turn, lies material.
std::vector<std::array<Vec3, 3>>
filled(const std::vector<Segment>& segments, const StockSection& section, double strip) {
    const PlaneAxes axes{(section.axis + 1) % 3, (section.axis + 2) % 3};
    std::vector<std::array<Vec3, 3>> cap;
    if (segments.empty()) {
        return cap;
    }
    double low = segments.front().from[axes.across], high = low;
    for (const Segment& segment : segments) {
        low = std::min({low, segment.from[axes.across], segment.to[axes.across]});
        high = std::max({high, segment.from[axes.across], segment.to[axes.across]});
    }
    if (!(high > low)) {
        return cap;
    }
    const auto strips = static_cast<std::size_t>(std::max(std::ceil((high - low) / strip), 1.0));
    const double width = (high - low) / static_cast<double>(strips);
    std::vector<std::vector<double>> crossings(strips);
    for (const Segment& segment : segments) {
        const double a = segment.from[axes.across], b = segment.to[axes.across];
        const auto strip_at = [&](double at) { return (at - low) / width - 0.5; };
        const double first = std::ceil(std::min(strip_at(a), strip_at(b)));
        const double last = std::ceil(std::max(strip_at(a), strip_at(b))); // its own end does not count
        for (double n = std::max(first, 0.0); n < std::min(last, static_cast<double>(strips)); n += 1.0) {
            const double middle = low + (n + 0.5) * width;
            const double share = (middle - a) / (b - a);
            crossings[static_cast<std::size_t>(n)].push_back(
                segment.from[axes.along] + share * (segment.to[axes.along] - segment.from[axes.along]));
        }
    }
    const auto place = [&](double along, double across) {
        Vec3 at = Vec3::Constant(section.at);
        at[axes.along] = along;
        at[axes.across] = across;
        return at;
    };
    for (std::size_t n = 0; n < strips; ++n) {
        std::vector<double>& all = crossings[n];
        std::ranges::sort(all);
        const double from = low + static_cast<double>(n) * width;
        for (std::size_t k = 0; k + 1 < all.size(); k += 2) {
            std::array<Vec3, 4> corners{place(all[k], from),
                                        place(all[k + 1], from),
                                        place(all[k + 1], from + width),
                                        place(all[k], from + width)};
            if (section.keeps_above) { // it is looked at from below
                std::swap(corners[1], corners[3]);
            }
            cap.push_back({corners[0], corners[1], corners[2]});
            cap.push_back({corners[0], corners[2], corners[3]});
        }
    }
    return cap;
}

} // namespace

SectionedMesh section_of(const simulation::CutMesh& mesh, const StockSection& section, double strip) {
    expects(strip > 0.0, "strips have a width");
    Cutter cutter(mesh, section);
    for (const std::array<int, 3>& triangle : mesh.triangles) {
        cutter.add(triangle);
    }
    SectionedMesh made = cutter.take();
    made.cap = filled(cutter.segments(), section, strip);
    return made;
}

} // namespace millwright::viewport
