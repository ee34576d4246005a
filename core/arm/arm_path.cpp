#include "core/arm/arm_path.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace millwright::arm {

namespace {

constexpr double shortest_step = 1e-4;  // mm: nearer than any arm resolves
constexpr double shortest_share = 1e-7; // of a way on which the tool turns on the spot
constexpr double border = 0.5;          // mm: how exactly it is reported where trouble begins

/// A place on a way, and the joints there.
struct ArmPlace {
    double share = 0.0;
    ArmHold hold;

    [[nodiscard]] bool is_held() const { return hold.trouble == ArmTrouble::none; }
};

class Follower {
public:
    Follower(const ArmModel& arm,
             const std::vector<ArmWay>& ways,
             const ArmPathSettings& settings,
             const Progress& progress)
        : arm_(arm), ways_(ways), settings_(settings), progress_(progress),
          length_(std::max(stretched_length(arm), 1.0)) {
        expects(settings.tip_tolerance > 0.0 && settings.axis_tolerance > 0.0 && settings.longest_step > 0.0,
                "tolerances and steps are positive");
    }

    [[nodiscard]] ArmPath from(JointPositions start) {
        joints_ = std::move(start);
        path_ = {};
        for (std::size_t n = 0; n < ways_.size(); ++n) {
            progress_.report(static_cast<double>(n) / static_cast<double>(ways_.size()));
            follow(static_cast<int>(n));
        }
        return std::move(path_);
    }

private:
    void follow(int number) {
        const ArmWay& way = ways_[static_cast<std::size_t>(number)];
        expects(way.at && std::isfinite(way.length) && way.length >= 0.0, "a way has a finite length");
        way_ = number;
        ArmPlace here = place(way, 0.0, joints_);
        // A tool that turns on the spot has steps too: of the angle by which it turns.
        const Frame first = way.at(0.0), last = way.at(1.0);
        const double turn = angle_between(first.linear().col(2), last.linear().col(2));
        const double steps = std::ceil(std::max(way.length / settings_.longest_step, turn / 0.1));
        add(here, come_from(here));
        const int count = std::max(1, static_cast<int>(std::min(steps, 1e9)));
        for (int k = 1; k <= count; ++k) {
            progress_.check();
            go(way, here, k == count ? 1.0 : static_cast<double>(k) / count);
        }
    }

    /// The first point of a way is where the last one ended: if the joints are others there, they jump.
    [[nodiscard]] ArmHold come_from(const ArmPlace& here) const {
        const bool moved = !path_.points.empty() && path_.points.back().trouble == ArmTrouble::none;
        return moved && here.is_held() ? jump_free(here, joints_, 0.0) : here.hold;
    }

    /// To `share` of the way, in as many steps as it needs.
    void go(const ArmWay& way, ArmPlace& here, double share) {
        ArmPlace there = place(way, share, here.hold.joints);
        const double step = (share - here.share) * way.length;
        const double middle = 0.5 * (here.share + share);
        if (here.is_held() != there.is_held() && step > border) {
            go(way, here, middle);
            return go(way, here, share);
        }
        ArmHold held = there.hold;
        if (here.is_held() && there.is_held() && !near_enough(way, here, there, middle)) {
            if (step > shortest_step || (way.length < shortest_step && share - here.share > shortest_share)) {
                go(way, here, middle);
                return go(way, here, share);
            }
            held = jump_free(there, here.hold.joints, step);
        }
        here = std::move(there);
        add(here, held);
    }

    /// Half way between the joints the tool is where it should be.
    [[nodiscard]] bool
    near_enough(const ArmWay& way, const ArmPlace& here, const ArmPlace& there, double middle) const {
        const ArmPlace wanted = place(way, middle, here.hold.joints);
        if (wanted.hold.trouble != ArmTrouble::none) {
            return false;
        }
        const Frame is = base_T_tool(arm_, 0.5 * (here.hold.joints + there.hold.joints));
        const Frame should = base_T_tool(arm_, wanted.hold.joints);
        return (is.translation() - should.translation()).norm() <= settings_.tip_tolerance &&
               turn_between(is.linear(), should.linear()) <= settings_.axis_tolerance;
    }

    /// Of the tool axis; of the whole direction where the roll is asked for, too.
    [[nodiscard]] double turn_between(const Mat3& is, const Mat3& should) const {
        return settings_.aim.demand == ArmDemand::frame
                   ? Eigen::AngleAxisd(Mat3(is.transpose() * should)).angle()
                   : angle_between(is.col(2), should.col(2));
    }

    [[nodiscard]] ArmPlace place(const ArmWay& way, double share, const JointPositions& previous) const {
        return {share, hold_tool(arm_, way.at(share), settings_.aim, previous)};
    }

    /// The hold itself, or why it cannot be reached from `before`, which is `distance` mm away.
    [[nodiscard]] ArmHold
    jump_free(const ArmPlace& there, const JointPositions& before, double distance) const {
        constexpr double same = 1e-6; // rad; rounding at the ends of ways
        if (joint_step(arm_, there.hold.joints, before) <= std::max(same, settings_.axis_tolerance)) {
            return there.hold;
        }
        int most = 0;
        const JointPositions step = (there.hold.joints - before).cwiseAbs();
        step.maxCoeff(&most);
        const ArmJoint& joint = arm_.joint(most);
        const bool turns = joint.kind == JointKind::revolute;
        ArmHold jumped = there.hold;
        jumped.trouble = ArmTrouble::jump;
        jumped.off.joint = {most, step[most]};
        jumped.why = fmt::format("joint {} would have to move {:.1f} {} within {:.4f} mm of the path",
                                 joint.name,
                                 turns ? to_degrees(step[most]) : step[most],
                                 turns ? "deg" : "mm",
                                 distance);
        return jumped;
    }

    void add(const ArmPlace& here, const ArmHold& hold) {
        if (path_.points.size() >= settings_.most_points) {
            const int line = ways_[static_cast<std::size_t>(way_)].line;
            throw Error(fmt::format("line {}: more than {} arm positions are needed; use a larger tolerance",
                                    line,
                                    settings_.most_points));
        }
        joints_ = here.hold.joints;
        const bool fine = hold.trouble == ArmTrouble::none;
        const double measure = fine ? manipulability(arm_jacobian(arm_, joints_), length_) : 0.0;
        path_.points.push_back({way_, here.share, joints_, hold.trouble, hold.tilt, measure});
        if (!fine) {
            find(hold);
        }
    }

    void find(const ArmHold& hold) {
        const std::size_t point = path_.points.size() - 1;
        const bool goes_on = !path_.findings.empty() && path_.findings.back().last + 1 == point &&
                             path_.findings.back().trouble == hold.trouble;
        if (goes_on) {
            path_.findings.back().last = point;
        } else {
            path_.findings.push_back({point, point, hold.trouble, hold.why, {}});
        }
        path_.findings.back().off.push_back(hold.off);
    }

    const ArmModel& arm_;
    const std::vector<ArmWay>& ways_;
    const ArmPathSettings& settings_;
    const Progress& progress_;
    double length_; ///< mm
    int way_ = 0;
    JointPositions joints_;
    ArmPath path_;
};

/// What makes one path worse than another.
struct Quality {
    double lost = 0.0; ///< mm of the way
    std::size_t findings = 0;
    double least = 0.0; ///< manipulability

    [[nodiscard]] bool better_than(const Quality& other) const {
        return std::pair(lost, findings) != std::pair(other.lost, other.findings)
                   ? std::pair(lost, findings) < std::pair(other.lost, other.findings)
                   : least > other.least;
    }
};

Quality quality_of(const ArmPath& path, const std::vector<ArmWay>& ways) {
    Quality quality{0.0, path.findings.size(), std::numeric_limits<double>::infinity()};
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        if (path.points[n].trouble != ArmTrouble::none) {
            quality.lost += length_to(path, ways, n);
        } else {
            quality.least = std::min(quality.least, path.points[n].manipulability);
        }
    }
    return quality;
}

/// Where the path can be entered: the ways to hold the tool at the first place that the arm reaches.
std::vector<JointPositions> starts_of(const ArmModel& arm,
                                      const std::vector<ArmWay>& ways,
                                      const JointPositions& rest,
                                      const ArmAim& aim) {
    for (const ArmWay& way : ways) {
        for (const double share : {0.0, 1.0}) {
            std::vector<JointPositions> starts = all_holds(arm, way.at(share), aim, rest);
            if (!starts.empty()) {
                return starts;
            }
        }
    }
    return {rest};
}

} // namespace

double length_to(const ArmPath& path, const std::vector<ArmWay>& ways, std::size_t point) {
    const ArmPathPoint& here = path.points[point];
    const bool first = point == 0 || path.points[point - 1].way != here.way;
    return first ? 0.0
                 : (here.share - path.points[point - 1].share) *
                       ways[static_cast<std::size_t>(here.way)].length;
}

ArmPath follow_path(const ArmModel& arm,
                    const std::vector<ArmWay>& ways,
                    const JointPositions& start,
                    const ArmPathSettings& settings,
                    const Progress& progress) {
    expects(start.size() == arm.joint_count() && start.allFinite(), "a position for every joint");
    return Follower(arm, ways, settings, progress).from(start);
}

ArmPath follow_path_well(const ArmModel& arm,
                         const std::vector<ArmWay>& ways,
                         const JointPositions& rest,
                         const ArmPathSettings& settings,
                         const Progress& progress) {
    constexpr std::size_t most_starts = 8;
    std::vector<JointPositions> starts = starts_of(arm, ways, rest, settings.aim);
    starts.resize(std::min(starts.size(), most_starts));
    ArmPath best;
    Quality least_bad;
    for (std::size_t n = 0; n < starts.size(); ++n) {
        const auto count = static_cast<double>(starts.size());
        const Progress part =
            progress.part(static_cast<double>(n) / count, static_cast<double>(n + 1) / count);
        ArmPath path = follow_path(arm, ways, starts[n], settings, part);
        const Quality quality = quality_of(path, ways);
        if (n == 0 || quality.better_than(least_bad)) {
            best = std::move(path);
            least_bad = quality;
        }
    }
    return best;
}

namespace {

int line_of(const ArmPath& path, const std::vector<ArmWay>& ways, std::size_t point) {
    return ways[static_cast<std::size_t>(path.points[point].way)].line;
}

/// `along`: of each point of the path, from its beginning.
ArmHole hole_of(const ArmPath& path,
                const std::vector<ArmWay>& ways,
                const std::vector<double>& along,
                const ArmFinding& finding) {
    ArmHole hole{0.0, finding.trouble, finding.why, {}};
    for (std::size_t n = finding.first; n <= finding.last; ++n) {
        const ArmPathPoint& at = path.points[n];
        hole.length += length_to(path, ways, n);
        hole.points.push_back({n + 1,
                               line_of(path, ways, n),
                               along[n],
                               ways[static_cast<std::size_t>(at.way)].at(at.share).translation(),
                               finding.off[n - finding.first]});
    }
    return hole;
}

} // namespace

ArmReach reach_of(const ArmPath& path, const std::vector<ArmWay>& ways) {
    ArmReach reach;
    for (const ArmWay& way : ways) {
        reach.programmed_time += way.duration;
    }
    std::vector<double> along;
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        const ArmPathPoint& point = path.points[n];
        const double length = length_to(path, ways, n);
        reach.length += length;
        along.push_back(reach.length);
        if (point.trouble != ArmTrouble::none) {
            continue;
        }
        const bool first = reach.lowest.size() == 0;
        reach.reached += length;
        reach.lowest = first ? point.joints : JointPositions(reach.lowest.cwiseMin(point.joints));
        reach.highest = first ? point.joints : JointPositions(reach.highest.cwiseMax(point.joints));
        reach.most_tilt = std::max(reach.most_tilt, point.tilt);
        if (first || point.manipulability < reach.least_manipulability) {
            reach.least_manipulability = point.manipulability;
            reach.least_line = line_of(path, ways, n);
        }
    }
    for (const ArmFinding& finding : path.findings) {
        reach.holes.push_back(hole_of(path, ways, along, finding));
    }
    return reach;
}

const ArmReachPoint& ArmHole::worst() const {
    return *std::ranges::max_element(points, {}, [](const ArmReachPoint& point) {
        return std::tuple(point.off.tip, point.off.joint.beyond, point.off.axis);
    });
}

std::string to_text(const ArmModel& arm, ArmTrouble trouble, const ArmShortfall& off) {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (off.tip > 0.0) {
        add(fmt::format("{:.3f} mm off", off.tip));
    }
    if (off.joint.joint >= 0) {
        const ArmJoint& joint = arm.joint(off.joint.joint);
        const bool turns = joint.kind == JointKind::revolute;
        const bool jumps = trouble == ArmTrouble::jump;
        add(fmt::format("joint {} {} {:.3f} {}{}",
                        joint.name,
                        jumps ? "jumps by" : "is",
                        turns ? to_degrees(off.joint.beyond) : off.joint.beyond,
                        turns ? "deg" : "mm",
                        jumps ? "" : " beyond its limit"));
    }
    if (off.axis > 0.0) {
        add(fmt::format("the tool direction is {:.3f} deg off", to_degrees(off.axis)));
    }
    return text;
}

const char* name_of(ArmTrouble trouble) {
    switch (trouble) {
    case ArmTrouble::none:
        return "none";
    case ArmTrouble::out_of_reach:
        return "out of reach";
    case ArmTrouble::joint_limit:
        return "joint limit";
    case ArmTrouble::tool_axis:
        return "tool axis";
    case ArmTrouble::jump:
        return "jump";
    }
    return "none";
}

} // namespace millwright::arm
