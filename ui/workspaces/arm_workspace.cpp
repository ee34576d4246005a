#include "ui/workspaces/arm_workspace.h"

#include "core/arm/arm_forward.h"
#include "core/arm/arm_hold.h"
#include "core/arm/arm_simulation.h"
#include "core/arm/arm_zone.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/tool_rotation.h"
#include "core/motion/arm_motion.h"
#include "core/motion/planner.h"
#include "core/project/assets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::actions {

namespace {

using arm::ArmModel;
using arm::JointPositions;

constexpr std::size_t longest_trace = 10'000;
constexpr double least_way_mm = 0.5;           // between two points of the trace
constexpr double rounding = 0.01 * pi / 180.0; // a tool axis so little out of the plane was meant to be in it

JointPositions inside(const ArmModel& arm, JointPositions joints) {
    for (int n = 0; n < arm.joint_count(); ++n) {
        joints[n] = std::clamp(joints[n], arm.joint(n).min, arm.joint(n).max);
    }
    return joints;
}

JointPositions home_of(const ArmModel& arm) {
    return inside(arm, arm.home());
}

bool turns(const ArmModel& arm, int joint) {
    return arm.joint(joint).kind == arm::JointKind::revolute;
}

Frame frame_at(const Vec3& tip, const Mat3& directions) {
    Frame frame = Frame::Identity();
    frame.translation() = tip;
    frame.linear() = directions;
    return frame;
}

} // namespace

ArmPlay play_of(motion::Trajectory trajectory) {
    const double duration = trajectory.duration();
    return {[motion = std::move(trajectory)](double time) { return motion.at(time).position; }, duration};
}

ArmPlay play_of(ArmFileMotion motion) {
    ArmPlay play = play_of(std::move(motion.trajectory));
    play.blocks = std::move(motion.blocks);
    return play;
}

ArmPlay play_of(std::shared_ptr<pmac::SharedMemoryStream> stream, arm::JointPositions start) {
    constexpr double settling = 2.0; // s: the card begins, brakes, and its motors come to rest
    const double duration = stream->count() * stream->move_time() + settling;
    return {[stream = std::move(stream), start = std::move(start)](double time) {
                while (stream->buffer().time < time && !stream->finished()) {
                    stream->advance(time - stream->buffer().time);
                }
                arm::JointPositions joints = start;
                for (std::size_t n = 0; n < stream->buffer().position.size(); ++n) {
                    joints[static_cast<Eigen::Index>(n)] += from_degrees(stream->buffer().position[n]);
                }
                return joints;
            },
            duration};
}

void ArmWorkspace::load(const std::string& name) {
    auto look = viewport::read_arm_look(project::arm_path(name, ".", assets_));
    name_ = name;
    look_ = std::move(look);
    motion_.reset();
    trace_.reset();
    drop_goal();
    refusal_.clear();
    joints_ = home_of(arm());
}

Frame ArmWorkspace::tool() const {
    return arm::base_T_tool(arm(), joints_);
}

double ArmWorkspace::manipulability() const {
    return arm::manipulability(arm::arm_jacobian(arm(), joints_), look_->reach);
}

void ArmWorkspace::set_joint(int joint, double position) {
    JointPositions wanted = joints_;
    wanted[joint] = position;
    set_joints(wanted);
}

void ArmWorkspace::set_joints(const JointPositions& joints) {
    stop();
    refusal_.clear();
    if (const int outside = arm().joint_outside(joints); outside >= 0) {
        refusal_ = "Joint " + arm().joint(outside).name + " is at its limit.";
    }
    const JointPositions wanted = inside(arm(), joints);
    if (std::string why = arm::leaves_zone(arm(), joints_, wanted); !why.empty()) {
        refusal_ = std::move(why);
    } else {
        place(wanted);
    }
}

void ArmWorkspace::go_home() {
    set_joints(home());
}

JointPositions ArmWorkspace::home() const {
    return home_of(arm());
}

void ArmWorkspace::move_tip(const Vec3& tip) {
    stop();
    const Frame goal = arm::carried_tool(arm(), joints_, tip);
    const arm::ArmHold hold = arm::hold_tool(arm(), goal, arm::aim_of(arm(), 0.5 * pi), joints_);
    refusal_ = hold.trouble == arm::ArmTrouble::none ? std::string() : hold.why;
    if (refusal_.empty()) {
        place(hold.joints);
    }
}

void ArmWorkspace::move_tip_by(const Vec3& way) {
    stop();
    const arm::ArmHold hold = arm::moved_tip(arm(), joints_, way);
    refusal_ = hold.trouble == arm::ArmTrouble::none ? std::string() : hold.why;
    if (refusal_.empty()) {
        place(hold.joints);
    }
}

void ArmWorkspace::set_goal(const Vec3& tip, const Vec3& axis) {
    const double length = axis.norm();
    wanted_axis_ = length > 0.0 ? Vec3(axis / length) : Vec3(Vec3::Zero());
    goal_ = arm::PointedGoal{tip, wanted_axis_};
    solve();
}

void ArmWorkspace::set_goal_from_tool() {
    const Frame now = tool();
    if (goal_roll_) {
        goal_roll_ = kinematics::roll_of(now.linear());
    }
    set_goal(now.translation(), now.linear().col(2));
}

void ArmWorkspace::set_goal_roll(std::optional<double> roll) {
    goal_roll_ = roll;
    if (goal_) {
        goal_->axis = wanted_axis_;
        solve();
    }
}

void ArmWorkspace::set_projects(bool on) {
    projects_ = on;
    if (goal_) {
        goal_->axis = wanted_axis_;
        solve();
    }
}

/// The roll is that about the axis which the arm can hold, as of `millwright arm ik --roll`.
Frame ArmWorkspace::goal_frame(const arm::ArmAim& aim) const {
    if (!goal_roll_) {
        return frame_at(goal_->tip, frame_along(goal_->axis));
    }
    Vec3 axis = goal_->axis;
    const auto in_plane = arm().planar_elbow() ? arm::projected_axis(*goal_) : std::nullopt;
    if (in_plane && angle_between(*in_plane, axis) <= aim.most_tilt) {
        axis = *in_plane;
    }
    return frame_at(goal_->tip, kinematics::frame_with_roll(axis, *goal_roll_));
}

void ArmWorkspace::solve() {
    solutions_.clear();
    reason_.clear();
    chosen_ = -1;
    if (!(wanted_axis_.norm() > 0.0)) {
        reason_ = "the tool axis has no direction";
        return;
    }
    using arm::ArmDemand;
    const arm::ArmAim aim{goal_roll_ ? ArmDemand::frame : ArmDemand::tip_and_axis,
                          projects_ ? 0.5 * pi : rounding};
    const Frame goal = goal_frame(aim);
    for (JointPositions& joints : arm::all_holds(arm(), goal, aim, joints_)) {
        std::string branch = branch_of(joints);
        ArmSolution solution{std::move(joints), std::move(branch)};
        for (int n = 0; n < arm().joint_count(); ++n) {
            const bool slides = arm().joint(n).kind == arm::JointKind::prismatic;
            double& farthest = slides ? solution.farthest_slide : solution.farthest_turn;
            farthest = std::max(farthest, std::abs(solution.joints[n] - joints_[n]));
        }
        solutions_.push_back(std::move(solution));
    }
    if (solutions_.empty()) {
        reason_ = arm::hold_tool(arm(), goal, aim, joints_).why;
    } else {
        goal_->axis = arm::base_T_tool(arm(), solutions_.front().joints).linear().col(2);
        chosen_ = 0;
    }
}

std::string ArmWorkspace::branch_of(const JointPositions& joints) const {
    if (!arm().planar_elbow()) {
        return {};
    }
    const std::vector<Frame> frames = arm::base_T_joints(arm(), joints);
    const Vec3 elbow = frames[2].translation(), wrist = frames[3].translation();
    const Vec3 forward = frames[0].linear().col(0);
    const double height = forward.dot(wrist) * elbow.z() - wrist.z() * forward.dot(elbow);
    return std::string(forward.dot(wrist) >= 0.0 ? "front" : "back") +
           (height * (forward.dot(wrist) >= 0.0 ? 1.0 : -1.0) >= 0.0 ? ", elbow up" : ", elbow down");
}

void ArmWorkspace::choose(int solution) {
    chosen_ = solution >= 0 && solution < std::ssize(solutions_) ? solution : -1;
}

void ArmWorkspace::drop_goal() {
    goal_.reset();
    solutions_.clear();
    reason_.clear();
    chosen_ = -1;
}

void ArmWorkspace::go(ArmMove how) {
    if (chosen_ < 0) {
        throw Error("there is no solution to move to", {}, "set a goal that the arm can reach");
    }
    const motion::ArmStop goal{
        "The goal", solutions_[static_cast<std::size_t>(chosen_)].joints, how == ArmMove::straight, 1.0};
    play(play_of(planned({goal})));
}

void ArmWorkspace::stop() {
    motion_.reset();
    held_.reset();
    held_line_.reset();
    wants_path_motion_ = false;
}

void ArmWorkspace::play(ArmPlay motion) {
    stop();
    motion_ = std::move(motion);
    time_ = 0.0;
    refusal_.clear();
}

const ArmBlockPlayed* ArmWorkspace::block() const {
    if (!motion_) {
        return nullptr;
    }
    const auto at = std::ranges::find_if(motion_->blocks,
                                         [this](const ArmBlockPlayed& block) { return time_ < block.end; });
    return at == motion_->blocks.end() ? nullptr : &*at;
}

motion::Trajectory ArmWorkspace::taught_motion(const std::vector<project::TaughtPoint>& points) const {
    constexpr double whole_percent = 100.0;
    std::vector<motion::ArmStop> stops;
    for (const project::TaughtPoint& point : points) {
        JointPositions joints(std::ssize(point.joints_deg));
        for (int n = 0; n < joints.size(); ++n) {
            const double told = point.joints_deg[static_cast<std::size_t>(n)];
            joints[n] = n < arm().joint_count() && !turns(arm(), n) ? told : from_degrees(told);
        }
        stops.push_back({point.name, std::move(joints), point.straight, point.speed_percent / whole_percent});
    }
    return planned(stops);
}

/// Throws Error where it would leave the arm's zone.
motion::Trajectory ArmWorkspace::planned(const std::vector<motion::ArmStop>& stops) const {
    motion::Trajectory taught_motion =
        motion::plan(motion::motion_through(arm(), joints_, stops), arm(), {}, {});
    constexpr double glance = 0.02; // s
    JointPositions before = joints_;
    for (double time = 0.0; arm().zone() != nullptr && time < taught_motion.duration() + glance;
         time += glance) {
        JointPositions at = taught_motion.at(std::min(time, taught_motion.duration())).position;
        if (const std::string why = arm::leaves_zone(arm(), before, at); !why.empty()) {
            throw Error(fmt::format("after {:.1f} s of the motion, {}", time, why));
        }
        before = std::move(at);
    }
    return taught_motion;
}

project::TaughtPoint ArmWorkspace::taught(std::string name) const {
    project::TaughtPoint point;
    constexpr double careful_percent = 25.0; // of a first run
    point.name = std::move(name);
    point.speed_percent = careful_percent;
    for (int n = 0; n < joints_.size(); ++n) {
        constexpr double steps = 1e4; // of a degree or mm
        const double told = turns(arm(), n) ? to_degrees(joints_[n]) : joints_[n];
        point.joints_deg.push_back(std::round(told * steps) / steps);
    }
    return point;
}

void ArmWorkspace::look_at_path(std::optional<ArmPathWish> wish) {
    if (!wish) {
        if (path_wish_) {
            path_.forget();
            path_wish_.reset();
            wants_path_motion_ = false;
        }
        return;
    }
    const bool same = path_wish_ && path_wish_->program == wish->program &&
                      path_wish_->machine == wish->machine && path_wish_->arm == wish->arm &&
                      path_wish_->base_T_part.matrix() == wish->base_T_part.matrix() &&
                      !(std::abs(path_wish_->most_lean - wish->most_lean) > 0.0);
    if (!same) {
        path_wish_ = std::move(wish);
        path_wish_->joints = joints_;
        path_wish_->motion = 0;
        wants_path_motion_ = false; // it would be that of the path before
        path_.want(*path_wish_);
    }
}

void ArmWorkspace::want_path_motion(bool of_card) {
    if (!path_wish_) {
        throw Error("there is no path on the arm", {}, "show a path first");
    }
    ArmPathWish wish = *path_wish_;
    wish.joints = joints_;
    wish.motion = ++path_motions_;
    wants_path_motion_ = true;
    of_card_ = of_card;
    path_.want(std::move(wish));
}

std::shared_ptr<const ArmPathAnswer> ArmWorkspace::take_path_motion() {
    auto answer = path_.answer();
    if (!wants_path_motion_ || !answer || answer->wish.motion != path_motions_) {
        return nullptr;
    }
    wants_path_motion_ = false;
    return answer;
}

std::shared_ptr<const ArmPathAnswer> ArmWorkspace::path() const {
    auto answer = path_wish_ ? path_.answer() : nullptr;
    return answer && answer->wish.arm == path_wish_->arm ? answer : nullptr; // not that of another arm
}

void ArmWorkspace::wait_idle() const {
    program_.wait_idle();
    path_.wait_idle();
}

void ArmWorkspace::hold_jog(const JointPositions& rates) {
    stop();
    held_ = rates;
}

void ArmWorkspace::hold_line(const Vec3& velocity) {
    stop();
    held_line_ = velocity;
}

void ArmWorkspace::play_stream(std::shared_ptr<pmac::SharedMemoryStream> stream) {
    stream_ = std::move(stream);
    play(play_of(stream_, home()));
    clear_trace();
}

bool ArmWorkspace::advance(double seconds) {
    if (held_) {
        const JointPositions rates = *std::exchange(held_, std::nullopt);
        set_joints(joints_ + seconds * rates);
        return true;
    }
    if (held_line_) {
        move_tip_by(seconds * *std::exchange(held_line_, std::nullopt));
        return true;
    }
    if (!motion_) {
        return false;
    }
    time_ = std::min(time_ + seconds, motion_->duration);
    JointPositions joints = joints_;
    const JointPositions told = motion_->at(time_);
    const Eigen::Index both = std::min(told.size(), joints.size());
    joints.head(both) = told.head(both);
    place(joints);
    if (!(time_ < motion_->duration)) {
        motion_.reset();
    }
    return true;
}

void ArmWorkspace::follow(const JointPositions& told, bool known) {
    if (known && follows_unknown_) {
        clear_trace();
    }
    follows_unknown_ = !known;
    JointPositions joints = joints_;
    for (Eigen::Index n = 0; n < std::min(told.size(), joints.size()); ++n) {
        joints[n] = told[n];
    }
    if ((joints - joints_).cwiseAbs().maxCoeff() > 0.0) {
        motion_.reset();
        held_.reset();
        held_line_.reset();
        refusal_.clear(); // of what was drawn before
        joints_ = joints;
        if (known) {
            extend_trace();
        }
    }
}

void ArmWorkspace::place(const JointPositions& joints) {
    joints_ = joints;
    extend_trace();
}

void ArmWorkspace::extend_trace() {
    const Vec3 tip = tool().translation();
    if (trace_ && !trace_->empty() && (trace_->back() - tip).norm() < least_way_mm) {
        return;
    }
    std::vector<Vec3> points = trace_ ? *trace_ : std::vector<Vec3>();
    if (points.size() >= longest_trace) {
        points.erase(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(longest_trace / 10));
    }
    points.push_back(tip);
    trace_ = std::make_shared<const std::vector<Vec3>>(std::move(points));
}

viewport::ArmScene ArmWorkspace::scene() const {
    viewport::ArmScene scene;
    scene.look = look_;
    scene.joints = joints_;
    if (chosen_ >= 0) {
        scene.ghost = solutions_[static_cast<std::size_t>(chosen_)].joints;
    }
    scene.trace = trace_;
    if (const auto found = path()) {
        scene.track = found->track;
        scene.part = path_wish_->base_T_part;
    }
    return scene;
}

} // namespace millwright::actions
