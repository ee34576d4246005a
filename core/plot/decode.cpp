#include "core/plot/decode.h"

#include "core/base/error.h"
#include "core/plot/internal/speed_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::plot {

namespace {

void check_decode_settings(const DecodeSettings& settings) {
    const auto positive = [](double value, const char* what) {
        if (!(value > 0.0) || !std::isfinite(value)) {
            throw Error(fmt::format("the {} is {}, but must be above 0", what, value));
        }
    };
    positive(settings.velocity, "velocity");
    positive(settings.period, "period");
    positive(settings.travel_velocity.value_or(1.0), "velocity with the pen up");
    positive(settings.plunge_velocity.value_or(1.0), "velocity up and down");
    positive(settings.velocity * settings.period, "step per period");
    positive(settings.acceleration.value_or(1.0), "acceleration");
    positive(settings.jerk.value_or(1.0), "jerk");
    if (settings.acceleration && settings.mode != DecodeMode::path) {
        throw Error("an acceleration limit is only possible along whole paths");
    }
    if (settings.jerk && !settings.acceleration) {
        throw Error("a jerk limit needs an acceleration limit, too");
    }
    if (!std::isfinite(settings.pen_up_z) || !std::isfinite(settings.pen_down_z)) {
        throw Error("the pen height is not a number");
    }
}

/// By how much the last bits of two places may make the way between them too long: 4 mm at 0.4 mm are 10
/// steps, wherever they lie.
double noise(const Vec3& from, const Vec3& to) {
    constexpr double bits = 4.0;
    return bits * std::numeric_limits<double>::epsilon() *
           std::max(from.lpNorm<Eigen::Infinity>(), to.lpNorm<Eigen::Infinity>());
}

/// Eq. 3-3 with a whole number of samples; `slack` is that of q.
double sample_count(double q, double slack, SampleRounding rounding) {
    switch (rounding) {
    case SampleRounding::down:
        return std::max(1.0, std::floor(q + slack));
    case SampleRounding::nearest:
        return std::max(1.0, std::round(q));
    case SampleRounding::up:
    case SampleRounding::exact:
        return std::max(1.0, std::ceil(q - slack));
    }
    return 1.0;
}

class Decoder {
public:
    Decoder(const DecodeSettings& settings, const std::optional<double>& fastest, const Vec3& start)
        : settings_(settings), fastest_(fastest) {
        put(start);
    }

    void travel(const Vec2& to) {
        lift_to(settings_.pen_up_z);
        line(at(to), settings_.travel_velocity.value_or(settings_.velocity));
    }

    void stroke(const Stroke& stroke) {
        travel(stroke.points.front());
        lift_to(settings_.pen_down_z);
        std::vector<Vec3> way;
        way.reserve(stroke.points.size());
        for (const Vec2& p : stroke.points) {
            way.emplace_back(p.x(), p.y(), settings_.pen_down_z);
        }
        cut(way);
    }

    /// Along a way that begins where the last point is, and whose second point is that of the path which
    /// comes next.
    void cut(const std::vector<Vec3>& way) {
        if (settings_.mode == DecodeMode::path) {
            if (settings_.acceleration && way.size() > 1) {
                limited_path(way);
            } else {
                whole_path(way);
            }
            return;
        }
        for (std::size_t n = 1; n < way.size(); ++n) {
            segment(way[n], settings_.velocity, settings_.rounding);
            ++leads_to_;
        }
    }

    /// As a path says, at its own heights; first up or down to that of its first point.
    void follow(const CutPath& path) {
        path_points_.emplace(points_.size(), leads_to_);
        if (!path.empty()) {
            lift_to(path.front().at.z());
        }
        for (std::size_t n = 0; n < path.size(); ++n) {
            leads_to_ = static_cast<int>(n);
            switch (path[n].move) {
            case CutMove::rapid:
                line(path[n].at, settings_.travel_velocity.value_or(settings_.velocity));
                break;
            case CutMove::plunge:
            case CutMove::retract:
                line(path[n].at, settings_.plunge_velocity.value_or(settings_.velocity));
                break;
            case CutMove::cut: {
                std::vector<Vec3> way{points_.back(), path[n].at};
                while (n + 1 < path.size() && path[n + 1].move == CutMove::cut) {
                    way.push_back(path[++n].at);
                }
                cut(way);
                break;
            }
            case CutMove::tool_change:
                break;
            }
        }
    }

    void raise() { lift_to(settings_.pen_up_z); }

    /// Straight up or down.
    void lift_to(double z) {
        const Vec3 here = points_.back();
        line({here.x(), here.y(), z}, settings_.plunge_velocity.value_or(settings_.velocity));
    }

    std::vector<Vec3> take() { return std::move(points_); }
    std::vector<int> take_path_points() { return std::move(*path_points_); }

private:
    [[nodiscard]] Vec3 at(const Vec2& p) const { return {p.x(), p.y(), points_.back().z()}; }

    void put(const Vec3& point) {
        points_.push_back(point);
        if (path_points_) {
            path_points_->push_back(leads_to_);
        }
    }

    void line(const Vec3& to, double velocity) {
        if (settings_.acceleration) {
            limited_line(to, velocity);
        } else {
            // These are the machine's own speeds: rounding never makes them faster.
            const bool exact = settings_.rounding == SampleRounding::exact;
            segment(to, velocity, exact ? SampleRounding::exact : SampleRounding::up);
        }
    }

    [[nodiscard]] internal::SpeedLimits limits(double velocity) const {
        return {.velocity = velocity,
                .acceleration = *settings_.acceleration,
                .jerk = settings_.jerk,
                .period = settings_.period};
    }

    /// Up to the kth period. What the last bits of a long way would make faster than the velocity waits for
    /// the next one.
    [[nodiscard]] double
    next_way(const internal::SpeedProfile& profile, double k, double before, double velocity) const {
        return std::min(profile.way(k * settings_.period), before + velocity * settings_.period);
    }

    void limited_line(const Vec3& to, double velocity) {
        const Vec3 from = points_.back();
        const double distance = (to - from).norm();
        if (!(distance > 0.0)) {
            return;
        }
        const internal::SpeedProfile profile({Vec3::Zero(), Vec3(distance, 0.0, 0.0)}, limits(velocity));
        reserve(profile.duration() / settings_.period);
        double way = 0.0;
        for (double k = 1.0; k * settings_.period < profile.duration(); k += 1.0) {
            way = next_way(profile, k, way, velocity);
            put(from + std::min(1.0, way / distance) * (to - from));
        }
        put(to);
    }

    /// Eqs 3-3 to 3-7. The points are computed from the start and not added up, so that nothing drifts.
    void segment(const Vec3& to, double velocity, SampleRounding rounding) {
        const Vec3 from = points_.back();
        const double distance = (to - from).norm();
        if (!(distance > 0.0)) {
            return;
        }
        const double q = distance / (velocity * settings_.period);
        const double count = step_count(distance, velocity, rounding, noise(from, to));
        reserve(count);
        const double step = rounding == SampleRounding::exact ? 1.0 / q : 1.0 / count;
        for (double n = 1.0; n < count; n += 1.0) {
            put(from + (n * step) * (to - from));
        }
        put(to);
    }

    /// As the rounding says, and more where those steps would be faster than the fastest.
    [[nodiscard]] double
    step_count(double distance, double velocity, SampleRounding rounding, double unsure) const {
        const auto count = [&](double speed, SampleRounding how) {
            const double step = speed * settings_.period;
            return sample_count(distance / step, unsure / step, how);
        };
        const double wanted = count(velocity, rounding);
        return fastest_ ? std::max(wanted, count(*fastest_, SampleRounding::up)) : wanted;
    }

    /// Points at whole multiples of the step along the way.
    void whole_path(const std::vector<Vec3>& way) {
        const double step = settings_.velocity * settings_.period;
        reserve(length_of(way) / step);
        double passed = 0.0; // length of the way up to the segment
        double k = 1.0;      // the next multiple
        for (std::size_t n = 1; n < way.size(); ++n) {
            const Vec3& a = way[n - 1];
            const Vec3& b = way[n];
            const double distance = (b - a).norm();
            for (; k * step < passed + distance; k += 1.0) {
                put(a + (k * step - passed) / distance * (b - a));
            }
            passed += distance;
            leads_to_ += n + 1 < way.size() ? 1 : 0;
        }
        const Vec3& end = way.back();
        if ((points_.back() - end).norm() > noise(points_.back(), end)) {
            put(end);
        } else {
            points_.back() = end;
        }
    }

    /// Points at whole multiples of the period, within the limits of acceleration and jerk.
    void limited_path(const std::vector<Vec3>& points) {
        const internal::SpeedProfile profile(points, limits(settings_.velocity));
        reserve(profile.duration() / settings_.period);
        double passed = 0.0; // length of the way up to the segment
        std::size_t n = 1;
        double way = 0.0;
        for (double k = 1.0; k * settings_.period < profile.duration(); k += 1.0) {
            way = next_way(profile, k, way, settings_.velocity);
            double distance = (points[n] - points[n - 1]).norm();
            while (passed + distance < way && n + 1 < points.size()) {
                passed += distance;
                ++n;
                ++leads_to_;
                distance = (points[n] - points[n - 1]).norm();
            }
            const double t = distance > 0.0 ? std::min(1.0, (way - passed) / distance) : 1.0;
            put(points[n - 1] + t * (points[n] - points[n - 1]));
        }
        leads_to_ += static_cast<int>(points.size() - 1 - n);
        put(points.back());
    }

    static double length_of(const std::vector<Vec3>& way) {
        double sum = 0.0;
        for (std::size_t n = 1; n < way.size(); ++n) {
            sum += (way[n] - way[n - 1]).norm();
        }
        return sum;
    }

    void reserve(double count) const {
        if (!(static_cast<double>(points_.size()) + count <= static_cast<double>(settings_.most_points))) {
            throw Error(
                fmt::format("more than {} points are needed: the velocity times the period is too small",
                            settings_.most_points));
        }
    }

    const DecodeSettings& settings_;
    std::optional<double> fastest_;
    std::vector<Vec3> points_;
    int leads_to_ = -1;                           ///< the point of the path that the next points lead to
    std::optional<std::vector<int>> path_points_; ///< of each point; not needed for strokes
};

void check_decode_settings(double fastest, const DecodeSettings& settings) {
    const double most = std::max(
        {settings.velocity, settings.travel_velocity.value_or(0.0), settings.plunge_velocity.value_or(0.0)});
    if (!(fastest >= most && std::isfinite(fastest))) {
        throw Error(fmt::format("the velocity of {} mm/s exceeds the maximum, {} mm/s", most, fastest));
    }
}

std::vector<Vec3> decoded(const Strokes& strokes,
                          const DecodeSettings& settings,
                          const std::optional<double>& fastest,
                          const Vec2& start) {
    Decoder decoder(settings, fastest, {start.x(), start.y(), settings.pen_up_z});
    for (const Stroke& stroke : strokes) {
        decoder.stroke(stroke);
    }
    decoder.raise();
    if (settings.end) {
        decoder.travel(*settings.end);
    }
    return decoder.take();
}

} // namespace

std::vector<Vec3> decode(const Strokes& strokes, const DecodeSettings& settings, const Vec2& start) {
    check_decode_settings(settings);
    return decoded(strokes, settings, std::nullopt, start);
}

std::vector<Vec3>
decode_within(double fastest, const Strokes& strokes, const DecodeSettings& settings, const Vec2& start) {
    check_decode_settings(settings);
    check_decode_settings(fastest, settings);
    return decoded(strokes, settings, fastest, start);
}

DecodedPath decode_path(const CutPath& path,
                        const DecodeSettings& settings,
                        const std::optional<double>& fastest,
                        const std::optional<Vec3>& start) {
    check_decode_settings(settings);
    if (fastest) {
        check_decode_settings(*fastest, settings);
    }
    const double above = path.empty() ? 0.0 : path.front().at.z();
    Decoder decoder(settings, fastest, start.value_or(Vec3(0.0, 0.0, above)));
    decoder.follow(path);
    return {decoder.take(), decoder.take_path_points()};
}

} // namespace millwright::plot
