#include "core/simulation/swept_cutter.h"

#include "core/base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace millwright::simulation {

namespace {

/// Turns that are convex nearly enough in two parts, rad (0.6 degrees).
constexpr double fine_turn = 0.0105;
constexpr int most_parts = 6 * 4;

bool is_unit(const Vec3& direction) {
    constexpr double rounding = 1e-6;
    return std::abs(direction.squaredNorm() - 1.0) < rounding;
}

} // namespace

/// Ends in a common form: `value` is to become as small as possible, -leave for the far end.
struct SweptCutter::Instant {
    double f = 0.0;
    std::array<double, 2> value = {}; ///< enter, -leave
    std::array<double, 2> rate = {};  ///< of these, per f
    /// Whether the value rises so fast from here that no bend of the motion brings it down again: towards
    /// f = 1, and towards f = 0.
    std::array<bool, 2> settles_forward = {}, settles_backward = {};
};

/// A line whose ends need a search, with the instants at f = 0 and 1.
struct SweptCutter::Search {
    const std::optional<Instant>& first;
    const std::optional<Instant>& last;
    const Vec3& at;
    int k;
    const std::array<double, 2>& enough; ///< values that need not be lower
};

/// Between `left`, whose value falls, and `right`, whose value rises or where the line misses.
struct SweptCutter::Bracket {
    Instant left;
    double right_f = 1.0;
    std::optional<Instant> right;
    bool mirrored = false; ///< f runs backwards: left and right are exchanged
};

SweptCutter::SweptCutter(const BodyRay& body, const geometry::ToolPose& from, const geometry::ToolPose& to)
    : body_(body), motion_{.tip = from.tip,
                           .way = to.tip - from.tip,
                           .middle = from.axis,
                           .across = Vec3::Zero()} {
    expects(is_unit(from.axis) && is_unit(to.axis), "a tool axis is a unit vector");
    motion_.turn = angle_between(from.axis, to.axis);
    expects(motion_.turn <= largest_turn * (1.0 + 1e-9),
            "a step of a cutter turns by no more than the largest turn");
    motion_.middle = (from.axis + to.axis).normalized();
    const Vec3 change = to.axis - from.axis;
    constexpr double no_turn = 1e-12;
    motion_.across = Vec3::Zero();
    if (motion_.turn > no_turn) {
        motion_.across = (change - change.dot(motion_.middle) * motion_.middle).normalized();
    } else {
        motion_.turn = 0.0;
    }
    motion_.moves = motion_.turn > 0.0 || motion_.way.squaredNorm() > 0.0;
    // Of points of the body: what turning adds to their acceleration, and to that of the place of contact.
    const double far =
        std::max(std::abs(body.shape().top), std::abs(body.shape().bottom)) + body.shape().radius;
    motion_.bend = motion_.turn * (motion_.turn * far + 2.0 * motion_.way.norm());
}

MovingPose SweptCutter::moving(double f) const {
    // Series of sine and cosine: exact to 2e-13 for half of the largest turn.
    const double x = (f - 0.5) * motion_.turn;
    const double x2 = x * x;
    const double cosine = 1.0 - 0.5 * x2 * (1.0 - x2 / 12.0);
    const double sine = x * (1.0 - x2 / 6.0 * (1.0 - x2 / 20.0));
    return {motion_.tip + f * motion_.way,
            cosine * motion_.middle + sine * motion_.across,
            motion_.way,
            motion_.turn * (cosine * motion_.across - sine * motion_.middle)};
}

geometry::ToolPose SweptCutter::pose(double f) const {
    const MovingPose at = moving(f);
    return {at.tip, at.axis};
}

double SweptCutter::half_motion() const {
    const toolpath::ProfileShape& shape = body_.shape();
    const double far = std::max(std::abs(shape.top), std::abs(shape.bottom)) + shape.radius;
    return 0.5 * (motion_.way.norm() + motion_.turn * far);
}

Box3 SweptCutter::bounds() const {
    const toolpath::ProfileShape& shape = body_.shape();
    Box3 box;
    for (const double f : {0.0, 1.0}) {
        const MovingPose at = moving(f);
        const Vec3 reach = shape.radius * (Vec3::Ones() - at.axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
        for (const double z : {shape.bottom, shape.top}) {
            const Vec3 middle = at.tip + z * at.axis;
            box.extend(Vec3(middle - reach));
            box.extend(Vec3(middle + reach));
        }
    }
    // Between its ends the axis bulges by no more than turn^2 / 8 of the length.
    const double bulge = 0.125 * motion_.turn * motion_.turn * (std::abs(shape.top) + shape.radius);
    return {Vec3(box.min().array() - bulge), Vec3(box.max().array() + bulge)};
}

/// Ends that are below `enough` have no rate: they need not be lower.
std::optional<SweptCutter::Instant>
SweptCutter::instant(double f, const Vec3& at, int k, const std::array<double, 2>& enough) const {
    const MovingPose pose = moving(f);
    const auto crossing = body_.crossing(pose.tip, pose.axis, at, k);
    if (!crossing) {
        return std::nullopt;
    }
    Instant found{.f = f, .value = {crossing->enter, -crossing->leave}};
    for (std::size_t end = 0; end < 2; ++end) {
        if (found.value[end] <= enough[end]) {
            found.settles_forward[end] = found.settles_backward[end] = true;
            continue;
        }
        Vec3 place = at;
        place[k] = end == 0 ? crossing->enter : crossing->leave;
        const auto part = end == 0 ? crossing->enter_part : crossing->leave_part;
        const EndRate of = body_.rate_of(pose, place, part, k);
        found.rate[end] = end == 0 ? of.rate : -of.rate;
        // The second derivative of the value is not below -bend / slope.
        const double bound = 0.5 * motion_.bend;
        found.settles_forward[end] = found.rate[end] * of.slope >= bound;
        found.settles_backward[end] = -found.rate[end] * of.slope >= bound;
    }
    return found;
}

/// Of a line that misses the body at both ends of the step: tries where it passes the axis, and where it is
/// nearest to the ways of the tip and of the corner's middle.
std::optional<SweptCutter::Instant> SweptCutter::any_hit(const Search& search) const {
    const Vec3& at = search.at;
    const int k = search.k;
    const Vec3 along = Vec3::Unit(k);
    const auto side = [&](double f) {
        const MovingPose pose = moving(f);
        return (at - pose.tip).dot(along.cross(pose.axis));
    };
    const auto nearest = [&](double height) {
        const MovingPose first = moving(0.0), last = moving(1.0);
        Vec3 from = at - first.tip - height * first.axis;
        Vec3 way = last.tip + height * last.axis - first.tip - height * first.axis;
        from[k] = 0.0;
        way[k] = 0.0;
        const double square = way.squaredNorm();
        return square > 0.0 ? from.dot(way) / square : 0.5;
    };
    const double at_start = side(0.0), at_end = side(1.0);
    const double passes = (at_start < 0.0) != (at_end < 0.0) ? at_start / (at_start - at_end) : -1.0;
    const toolpath::ProfileShape& shape = body_.shape();
    std::array<double, 12> tried = {
        passes, nearest(shape.bottom + shape.corner), nearest(shape.bottom), nearest(shape.top)};
    for (std::size_t n = 4; n < tried.size(); ++n) { // a line past a rim is none of these
        tried[n] = static_cast<double>(n - 3) / static_cast<double>(tried.size() - 3);
    }
    for (const double f : tried) {
        if (f > 0.0 && f < 1.0) {
            if (auto found = instant(f, at, k, search.enough)) {
                return found;
            }
        }
    }
    return std::nullopt;
}

std::optional<Interval> SweptCutter::swept(const Vec3& at, int k, const Interval& material) const {
    const std::array<double, 2> enough{material.from, -material.to};
    const std::optional<Instant> first = instant(0.0, at, k, enough);
    if (!motion_.moves) {
        return first ? std::optional(Interval{first->value[0], -first->value[1]}) : std::nullopt;
    }
    if (first && first->settles_forward[0] && first->settles_forward[1]) {
        return Interval{first->value[0], -first->value[1]};
    }
    const std::optional<Instant> last = instant(1.0, at, k, enough);
    std::array<double, 2> found{};
    std::array<bool, 2> done{};
    for (std::size_t end = 0; end < 2; ++end) {
        if (first && first->settles_forward[end]) {
            found[end] = first->value[end];
            done[end] = true;
        } else if (last && last->settles_backward[end]) {
            found[end] = last->value[end];
            done[end] = true;
        }
    }
    if (done[0] && done[1]) {
        return Interval{found[0], -found[1]};
    }
    return searched({first, last, at, k, enough});
}

std::optional<Interval> SweptCutter::searched(const Search& search) const {
    const auto& [first, last, at, k, enough] = search;
    // What turns is convex only nearly, and in each part more nearly; least so along a line that the axis
    // becomes parallel to.
    constexpr double nearly_parallel = 0.999; // cosine of 2.6 degrees
    const int turns = static_cast<int>(std::ceil(motion_.turn / fine_turn));
    const int parts = std::max(1, std::abs(motion_.middle[k]) < nearly_parallel ? 2 * turns : 6 * turns);
    std::array<std::optional<Instant>, most_parts + 1> tried{first};
    const auto used = std::span(tried).first(static_cast<std::size_t>(parts) + 1);
    for (std::size_t n = 1; n + 1 < used.size(); ++n) {
        used[n] = instant(static_cast<double>(n) / parts, at, k, enough);
    }
    used.back() = last;
    if (std::ranges::any_of(used, [](const auto& one) { return one.has_value(); })) {
        return Interval{least_of(used, search, 0), -least_of(used, search, 1)};
    }
    const std::optional<Instant> between = any_hit(search);
    if (!between) {
        return std::nullopt;
    }
    const auto least = [&](std::size_t end) {
        const bool falls = between->rate[end] < 0.0;
        return lowest({*between, falls ? 1.0 : 0.0, std::nullopt, !falls}, search, end);
    };
    return Interval{least(0), -least(1)};
}

/// The least value of one end over the whole step: `tried` are evenly spaced, and one at least is a hit.
double SweptCutter::least_of(std::span<const std::optional<Instant>> tried,
                             const Search& search,
                             std::size_t end) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& one : tried) {
        least = one ? std::min(least, one->value[end]) : least;
    }
    for (std::size_t n = 1; n < tried.size(); ++n) {
        const auto& left = tried[n - 1];
        const auto& right = tried[n];
        const double step = 1.0 / static_cast<double>(tried.size() - 1);
        const bool falls = left && left->rate[end] < 0.0;
        const bool rises = right && right->rate[end] > 0.0;
        if (falls && (rises || !right)) {
            const double f = static_cast<double>(n) * step;
            least = std::min(least, lowest({*left, f, right, false}, search, end));
        } else if (rises && !left) {
            const double f = static_cast<double>(n - 1) * step;
            least = std::min(least, lowest({*right, f, std::nullopt, true}, search, end));
        }
    }
    return least;
}

/// The least value between the ends of `bracket`. In turn the secant of the rates (exact where the value is a
/// parabola), the meeting of the tangents (exact at an edge of the body) and the middle are tried.
double SweptCutter::lowest(Bracket bracket, const Search& search, std::size_t end) const {
    constexpr int most_steps = 48;
    // Along a line that grazes the shank of a turning tool the value is not quite convex.
    const int least_steps = motion_.turn > 0.0 ? 2 : 0;
    // Everything along s = |f - left.f| >= 0: the rate by s is negative at the left.
    const double way = bracket.mirrored ? -1.0 : 1.0;
    double least = bracket.left.value[end];
    if (bracket.right) {
        least = std::min(least, bracket.right->value[end]);
    }
    for (int n = 0; n < most_steps; ++n) {
        const double width = std::abs(bracket.right_f - bracket.left.f);
        const double falls = way * bracket.left.rate[end];
        double s = 0.5 * width;
        if (bracket.right && std::isfinite(falls) && std::isfinite(bracket.right->rate[end])) {
            const double rises = way * bracket.right->rate[end];
            const double rise = bracket.right->value[end] - bracket.left.value[end];
            const double meet = std::clamp((rise - rises * width) / (falls - rises), 0.0, width);
            if (n >= least_steps && least - (bracket.left.value[end] + falls * meet) < sweep_tolerance) {
                return least;
            }
            s = n % 3 == 0 ? width * falls / (falls - rises) : n % 3 == 1 ? meet : s;
        } else if (-falls * width < sweep_tolerance) {
            return least;
        }
        if (!(s > 0.0 && s < width)) {
            s = 0.5 * width;
        }
        const double f = bracket.left.f + way * s;
        const std::optional<Instant> next = instant(f, search.at, search.k, search.enough);
        if (next) {
            least = std::min(least, next->value[end]);
        }
        if (next && way * next->rate[end] < 0.0) {
            bracket.left = *next;
        } else {
            bracket.right = next;
            bracket.right_f = f;
        }
    }
    return least;
}

} // namespace millwright::simulation
