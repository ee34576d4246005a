#include "ui/workspaces/arm_path_work.h"

#include "core/base/units.h"
#include "core/motion/arm_motion.h"
#include "core/motion/planner.h"
#include "core/program/arm_ways.h"

namespace millwright::actions {

namespace {

// Coarser than for the motion itself: what a person sees while the part is dragged.
constexpr double shown_tolerance = 0.2, shown_axis_tolerance = 0.01, shown_step = 20.0;

// The way to the beginning is not in the picture: as slow as a taught point is at first.
constexpr double share_to_beginning = 0.25;

arm::ArmPathSettings settings_of(const ArmPathWish& wish) {
    arm::ArmPathSettings settings;
    settings.aim = arm::aim_of(wish.arm->arm(), wish.most_lean);
    if (wish.motion == 0) {
        settings.tip_tolerance = shown_tolerance;
        settings.axis_tolerance = shown_axis_tolerance;
        settings.longest_step = shown_step;
    }
    return settings;
}

std::shared_ptr<const viewport::ArmTrack> track_of(const arm::ArmPath& path,
                                                   const std::vector<arm::ArmWay>& ways) {
    auto track = std::make_shared<viewport::ArmTrack>();
    for (const arm::ArmPathPoint& point : path.points) {
        track->tips.emplace_back(ways[static_cast<std::size_t>(point.way)].at(point.share).translation());
        track->troubles.push_back(point.trouble);
    }
    return track;
}

void find(ArmPathAnswer& answer, const Progress& progress) {
    const ArmPathWish& wish = answer.wish;
    const arm::ArmModel& arm = wish.arm->arm();
    const auto ways = program::arm_ways(wish.program, wish.machine, wish.base_T_part);
    if (ways.empty()) {
        throw Error("the program contains no motion");
    }
    const arm::ArmPath path = arm::follow_path_well(arm, ways, wish.joints, settings_of(wish), progress);
    answer.track = track_of(path, ways);
    answer.reach = arm::reach_of(path, ways);
    if (wish.motion > 0) {
        motion::ArmMotion motion(arm, wish.joints);
        if (path.whole()) {
            const arm::JointPositions& first = path.points.front().joints;
            const double seconds = motion::joint_time(arm, first - wish.joints, share_to_beginning);
            if (seconds > 0.0) {
                motion.go_to(first, seconds);
            }
        }
        motion.follow(ways, path, {});
        answer.motion =
            std::make_shared<const motion::Trajectory>(motion::plan(motion.program(), arm, {}, progress));
    }
}

} // namespace

ArmPathAnswer work_out(const ArmPathWish& wish, const Progress& progress) {
    ArmPathAnswer answer{wish, nullptr, {}, nullptr, {}};
    try {
        find(answer, progress);
    } catch (const Error& error) {
        const Diagnostic& found = error.diagnostic();
        answer.why =
            (found.place.line > 0 ? "line " + std::to_string(found.place.line) + ": " : std::string()) +
            found.message;
    }
    return answer;
}

} // namespace millwright::actions
