#include "core/toolpath/constant_scallop.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/toolpath/contact_shape.h"
#include "core/toolpath/internal/contact_point.h"
#include "core/toolpath/lean.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace millwright::toolpath {

namespace {

/// A track as a function: the parameter across it at equal steps of the parameter along it, each 0 to 1.
using Across = std::vector<double>;

/// Place on the domain: along the tracks and across them.
struct Place {
    double along = 0.0;
    double across = 0.0;
};

double step_of(const Across& track) {
    return 1.0 / static_cast<double>(std::ssize(track) - 1);
}

double at(const Across& track, double along) {
    const double place = std::clamp(along, 0.0, 1.0) / step_of(track);
    const auto n = std::min(static_cast<std::size_t>(place), track.size() - 2);
    return mix(track[n], track[n + 1], place - static_cast<double>(n));
}

class Stepper {
public:
    Stepper(const Covering& of, double height) : of_(of), height_(height) {}

    [[nodiscard]] Vec2 uv(const Place& place) const {
        return of_.direction == grid::TrackDirection::along_v ? Vec2(place.across, place.along)
                                                              : Vec2(place.along, place.across);
    }

    /// The next track; `forward`: the tool goes with the parameter on `track`.
    [[nodiscard]] Across next(const Across& track, bool forward) const {
        std::vector<Place> places;
        for (std::size_t n = 0; n < track.size(); ++n) {
            places.push_back(stepped(track, n, forward));
        }
        std::ranges::sort(places, {}, &Place::along);
        Across found(track.size());
        for (std::size_t n = 0; n < track.size(); ++n) {
            const double along = static_cast<double>(n) * step_of(track);
            found[n] = std::clamp(between(places, along), track[n], 1.0);
        }
        return found;
    }

private:
    [[nodiscard]] Place stepped(const Across& track, std::size_t n, bool forward) const {
        const double step = step_of(track);
        const Place from{static_cast<double>(n) * step, track[n]};
        const std::size_t before = n == 0 ? 0 : n - 1;
        const std::size_t after = std::min(n + 1, track.size() - 1);
        const double slope = (track[after] - track[before]) / (step * static_cast<double>(after - before));
        const Vec2 here = uv(from);
        const geometry::SurfaceDerivatives d = of_.patch.derivatives(here.x(), here.y());
        const bool along_v = of_.direction == grid::TrackDirection::along_v;
        const Vec3& s_along = along_v ? d.dv : d.du;
        const Vec3& s_across = along_v ? d.du : d.dv;
        const Vec3 feed = (s_along + slope * s_across) * (forward ? 1.0 : -1.0);
        const PathPoint point = contact_point(of_.patch, here, of_.flipped);
        Vec3 way = point.normal.cross(feed);
        if (!(way.squaredNorm() > 0.0)) {
            throw Error(
                fmt::format("the track has no direction at u = {:.6g}, v = {:.6g}", here.x(), here.y()));
        }
        way.normalize();
        way = way.dot(s_across) < 0.0 ? Vec3(-way) : way;
        const double gap = gap_at(d, point, feed.normalized(), from.along, way);
        return moved(from, s_along, s_across, way, gap, point.contact);
    }

    /// The distance across the tracks that leaves the height, between one that is worth a track and half of
    /// the cutter.
    [[nodiscard]] double gap_at(const geometry::SurfaceDerivatives& d,
                                const PathPoint& point,
                                const Vec3& feed,
                                double along,
                                const Vec3& way) const {
        const Profile& cutter = *of_.tool.cutter;
        const Vec3 axis = of_.machine.rotary_axes().empty()
                              ? of_.machine.description().tool_axis
                              : leaning_axis(of_.tool.lean, point.normal, feed, along);
        const ContactShape shape = contact_shape(cutter, point.normal, axis);
        const double gap = step_over(
            effective_radius(shape, point.normal, feed), convex_curvature(d, point.normal, way), height_);
        return std::clamp(gap, std::min(2.0 * height_, cutter.shape().radius), cutter.shape().radius);
    }

    /// So far along the surface that the chord is `gap`.
    [[nodiscard]] Place moved(const Place& from,
                              const Vec3& s_along,
                              const Vec3& s_across,
                              const Vec3& way,
                              double gap,
                              const Vec3& contact) const {
        Eigen::Matrix2d metric;
        metric << s_along.squaredNorm(), s_along.dot(s_across), s_along.dot(s_across), s_across.squaredNorm();
        const Vec2 direction = metric.fullPivLu().solve(Vec2(way.dot(s_along), way.dot(s_across)));
        double length = gap;
        const auto to = [&] {
            return Place{from.along + length * direction.x(), from.across + length * direction.y()};
        };
        constexpr int corrections = 3;
        for (int n = 0; n < corrections; ++n) {
            const Vec2 there = uv(to()).cwiseMax(0.0).cwiseMin(1.0);
            const bool inside = (there - uv(to())).cwiseAbs().maxCoeff() <= 0.0;
            const double chord = (of_.patch.position(there.x(), there.y()) - contact).norm();
            if (!inside || !(chord > 0.0)) {
                break; // over the border the first order is all there is
            }
            length *= gap / chord;
        }
        return to();
    }

    /// The parameter across at `along` between neighbours of the places, which are sorted; straight on before
    /// the first and after the last.
    static double between(const std::vector<Place>& places, double along) {
        const auto straight = [along](const Place& a, const Place& b) {
            const double span = b.along - a.along;
            return span > 0.0 ? mix(a.across, b.across, (along - a.along) / span)
                              : std::min(a.across, b.across);
        };
        const auto after = std::ranges::lower_bound(places, along, {}, &Place::along) - places.begin();
        const auto n = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after, 1, std::ssize(places) - 1));
        return straight(places[n - 1], places[n]);
    }

    const Covering& of_;
    double height_;
};

/// Stretches of a track, of its parameter along.
using Stretch = std::pair<double, double>;

/// Where the surface is not yet done by the track before; a step more at each end, so that none is missed.
std::vector<Stretch> to_do(const Across& before) {
    std::vector<Stretch> found;
    const double step = step_of(before);
    for (std::size_t n = 0; n < before.size(); ++n) {
        if (before[n] < 1.0) {
            const double along = static_cast<double>(n) * step;
            const Stretch around{std::max(0.0, along - step), std::min(1.0, along + step)};
            if (!found.empty() && found.back().second >= around.first) {
                found.back().second = around.second;
            } else {
                found.push_back(around);
            }
        }
    }
    return found;
}

bool done(const Across& track) {
    return std::ranges::all_of(track, [](double across) { return across >= 1.0; });
}

/// What is written down of the tracks.
class Writer {
public:
    Writer(const Covering& of, const Stepper& stepper) : of_(of), stepper_(stepper) {
        path_.direction = of.direction;
    }

    void add(const Across& track, std::vector<Stretch> stretches, bool forward) {
        if (!forward) {
            std::ranges::reverse(stretches);
        }
        for (const auto& [from, to] : stretches) {
            add_stretch(track, forward ? from : to, forward ? to : from);
        }
        ++track_;
        points_ = 0;
    }
    [[nodiscard]] Toolpath take() { return std::move(path_); }

private:
    void add_stretch(const Across& track, double from, double to) {
        const int most = of_.grid.nodes_per_track(of_.direction) - 1;
        const int moves = std::max(1, static_cast<int>(std::ceil(most * std::abs(to - from) - 1e-9)));
        for (int k = 0; k <= moves; ++k) {
            const double along = mix(from, to, static_cast<double>(k) / moves);
            PathPoint point = contact_point(of_.patch, stepper_.uv({along, at(track, along)}), of_.flipped);
            point.origin.i = track_;
            point.origin.j = points_++;
            point.reached_by = k > 0                  ? MoveKind::track
                               : path_.points.empty() ? MoveKind::start
                                                      : MoveKind::cross;
            path_.points.push_back(point);
        }
    }

    const Covering& of_;
    const Stepper& stepper_;
    Toolpath path_;
    int track_ = 0;
    int points_ = 0; ///< of the track
};

} // namespace

ConstantScallop::ConstantScallop(double height) : height_(height) {
    expects(height > 0.0 && std::isfinite(height), "a scallop has a height");
}

Toolpath ConstantScallop::contacts(const Covering& of, const Progress& progress) const {
    if (!of.tool.cutter) {
        throw Error(
            "a point leaves no scallop, so that nothing says how far tracks of constant scallop are apart",
            {},
            "choose a cutter for the tool, or another way to place the points");
    }
    const int moves = of.grid.nodes_per_track(of.direction) - 1;
    const auto places = static_cast<std::size_t>(std::clamp(4 * moves, 100, 1000) + 1);
    const Stepper stepper(of, height_);
    Writer writer(of, stepper);
    Across track(places, 0.0);
    writer.add(track, {{0.0, 1.0}}, true);
    for (int n = 1; !done(track); ++n) {
        progress.check();
        progress.report(*std::ranges::min_element(track));
        if (n >= most_tracks) {
            throw Error(
                fmt::format("a scallop of {:.6g} mm would take more than {} tracks", height_, most_tracks),
                {},
                "allow a higher one, or take a larger cutter");
        }
        const bool forward = n % 2 == 0;
        const std::vector<Stretch> stretches = to_do(track);
        track = stepper.next(track, !forward);
        writer.add(track, stretches, forward);
    }
    progress.report(1.0);
    return writer.take();
}

} // namespace millwright::toolpath
