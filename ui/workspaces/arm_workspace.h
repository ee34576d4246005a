// The robot arm of the Arm workspace: which one, how its joints stand, where it shall go and how it could,
// and what it does on the way there. Moved by hand here it is a drawing; a connected controller is moved by
// jogs. Lengths mm, angles rad, in the arm's base.
#pragma once

#include "core/arm/arm_inverse.h"
#include "core/motion/arm_motion.h"
#include "core/motion/trajectory.h"
#include "core/pmac/emulator/shared_memory_stream.h"
#include "core/project/arm_input.h"
#include "ui/viewport/arm_scene.h"
#include "ui/workspaces/arm_path_work.h"
#include "ui/workspaces/card_run.h"
#include "ui/workspaces/machine_news.h"
#include "ui/workspaces/motion_file_draft.h"
#include "ui/workspaces/motion_program_draft.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::actions {

/// One way to hold the tool at the goal.
struct ArmSolution {
    arm::JointPositions joints;
    std::string branch;          ///< "front, elbow up"; of other arms than the L-3's kind empty
    double farthest_turn = 0.0;  ///< of a joint from its position, rad
    double farthest_slide = 0.0; ///< mm, of a joint that slides
};

enum class ArmMove : std::uint8_t {
    joints,  ///< every joint straight to its end
    straight ///< the tip along a line
};

/// A motion of the drawn arm: its joints at each moment, s. Of fewer joints than the arm has the others stay.
struct ArmPlay {
    std::function<arm::JointPositions(double)> at;
    double duration = 0.0;
    std::vector<ArmBlockPlayed> blocks{}; ///< of a motion file
};

[[nodiscard]] ArmPlay play_of(motion::Trajectory trajectory);
[[nodiscard]] ArmPlay play_of(ArmFileMotion motion);
/// What the motors of an emulated card did, of its axes alone; there is a record.
[[nodiscard]] ArmPlay play_of(std::shared_ptr<const pmac::MotionSimulation> simulation);
/// What the motors do that an emulated card drives by the points of its dual-ported RAM, from the joints
/// `start` on.
[[nodiscard]] ArmPlay play_of(std::shared_ptr<pmac::SharedMemoryStream> stream, arm::JointPositions start);

class ArmWorkspace {
public:
    /// `assets`: what ships with the program. `wake`: from any thread, when something was worked out.
    explicit ArmWorkspace(std::filesystem::path assets, const std::function<void()>& wake = {})
        : assets_(std::move(assets)), program_(wake), path_(work_out, wake) {}

    /// By its name or file, with the joints at home. Throws Error; the arm from before then stays.
    void load(const std::string& name);
    [[nodiscard]] bool loaded() const { return look_ != nullptr; }
    /// What follows needs an arm.
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const std::shared_ptr<const viewport::ArmLook>& look() const { return look_; }
    [[nodiscard]] const arm::ArmModel& arm() const { return look_->arm(); }

    [[nodiscard]] const arm::JointPositions& joints() const { return joints_; }
    [[nodiscard]] Frame tool() const;
    /// 0 where the arm is singular (core/arm/arm_forward.h).
    [[nodiscard]] double manipulability() const;

    /// Stops what moves. A joint stays inside its limits.
    void set_joint(int joint, double position);
    void set_joints(const arm::JointPositions& joints);
    /// The upper arm upright, the forearm level; of other arms every joint at 0, or near it.
    void go_home();
    /// The joints of it.
    [[nodiscard]] arm::JointPositions home() const;
    /// The tip there and the tool leaning as it does; where the arm cannot it stays, and refusal() says why.
    void move_tip(const Vec3& tip);
    /// The same by `way` in a straight line, base's frame, mm.
    void move_tip_by(const Vec3& way);
    /// Why the last of these was not done, or only in part; empty if it was.
    [[nodiscard]] const std::string& refusal() const { return refusal_; }

    /// Looks for every way to hold the tool there. `axis` need not be a unit vector; one of no length is
    /// refused by reason().
    void set_goal(const Vec3& tip, const Vec3& axis);
    /// The tool as it is now; its roll, too, where one is asked for.
    void set_goal_from_tool();
    /// The roll about the goal's axis (core/kinematics/tool_rotation.h), rad; nullopt: any will do.
    void set_goal_roll(std::optional<double> roll);
    [[nodiscard]] const std::optional<double>& goal_roll() const { return goal_roll_; }
    /// Turns the goal's axis by the smallest angle into the plane of an arm with five joints.
    void set_projects(bool on);
    [[nodiscard]] bool projects() const { return projects_; }
    [[nodiscard]] const std::optional<arm::PointedGoal>& goal() const { return goal_; }
    [[nodiscard]] const std::vector<ArmSolution>& solutions() const { return solutions_; }
    [[nodiscard]] const std::string& reason() const { return reason_; } ///< why there is none
    /// Which one is drawn as a ghost and gone to; -1: none.
    void choose(int solution);
    [[nodiscard]] int chosen() const { return chosen_; }
    void drop_goal();

    /// Begins to move to the chosen solution. Throws Error with the reason where the arm cannot.
    void go(ArmMove how);
    void stop();
    /// Begins a motion, wherever it begins.
    void play(ArmPlay motion);
    /// From where the joints stand through points that were taught. Throws Error with the name of the one
    /// that the arm cannot go to.
    [[nodiscard]] motion::Trajectory taught_motion(const std::vector<project::TaughtPoint>& points) const;
    /// What stands now, as a point to come back to.
    [[nodiscard]] project::TaughtPoint taught(std::string name) const;
    /// Until the next advance() the joints move at these rates, as far as their limits: to be wanted in every
    /// frame, rad/s or mm/s.
    void hold_jog(const arm::JointPositions& rates);
    /// The same for the tip in a straight line: base's frame, mm/s.
    void hold_line(const Vec3& velocity);
    [[nodiscard]] bool moving() const { return motion_ || held_ || held_line_; }
    /// Of the motion, s; 0 without one.
    [[nodiscard]] double duration() const { return motion_ ? motion_->duration : 0.0; }
    [[nodiscard]] double time() const { return time_; }
    /// The block of a motion file that is under way; null where there is none.
    [[nodiscard]] const ArmBlockPlayed* block() const;
    /// Lets `seconds` pass. True if anything changed.
    bool advance(double seconds);

    void clear_trace() { trace_.reset(); }
    /// Where a connected arm stands; joints that it does not tell stay. Draws the trace, if the position is
    /// `known`: a trace begins anew when it becomes so, since homing moves the zero of what was told before.
    void follow(const arm::JointPositions& told, bool known = true);

    /// The program that a connected card was sent.
    [[nodiscard]] CardRun& card_run() { return card_run_; }
    [[nodiscard]] const CardRun& card_run() const { return card_run_; }

    /// What the card, or whatever else is connected, has to say.
    [[nodiscard]] MachineNews& news() { return news_; }
    [[nodiscard]] const MachineNews& news() const { return news_; }

    /// The point of the project that was taught just now, from 0, until somebody has shown it.
    [[nodiscard]] const std::optional<int>& new_point() const { return new_point_; }
    void set_new_point(std::optional<int> point) { new_point_ = point; }

    [[nodiscard]] MotionProgramDraft& program() { return program_; }
    [[nodiscard]] const MotionProgramDraft& program() const { return program_; }

    [[nodiscard]] MotionFileDraft& motion_file() { return motion_file_; }
    [[nodiscard]] const MotionFileDraft& motion_file() const { return motion_file_; }

    /// The dual-ported RAM of an emulated card, while points go through it and after that; null before.
    [[nodiscard]] const pmac::SharedMemoryStream* stream() const { return stream_.get(); }
    /// Begins to move by its points, from home on.
    void play_stream(std::shared_ptr<pmac::SharedMemoryStream> stream);

    /// A program on the part that stands there is looked at, in the background; none: nothing is. The joints
    /// of the wish are those of now.
    void look_at_path(std::optional<ArmPathWish> wish);
    /// Works out the motion of the path that is looked at; take_path_motion() reports the result. `of_card`:
    /// it is a connected arm that shall go it, not the drawn one.
    void want_path_motion(bool of_card);
    void call_off_path_motion() { wants_path_motion_ = false; }
    [[nodiscard]] bool path_motion_is_of_card() const { return of_card_; }
    /// A motion that was wanted, once; or why there is none.
    [[nodiscard]] std::shared_ptr<const ArmPathAnswer> take_path_motion();
    /// One is wanted, and not yet taken.
    [[nodiscard]] bool works_out_path_motion() const { return wants_path_motion_; }
    /// The newest answer; null without a path.
    [[nodiscard]] std::shared_ptr<const ArmPathAnswer> path() const;
    void wait_idle() const;

    [[nodiscard]] viewport::ArmScene scene() const;

private:
    void solve();
    [[nodiscard]] Frame goal_frame(const arm::ArmAim& aim) const;
    [[nodiscard]] motion::Trajectory planned(const std::vector<motion::ArmStop>& stops) const;
    void place(const arm::JointPositions& joints); ///< and the trace
    void extend_trace();
    [[nodiscard]] std::string branch_of(const arm::JointPositions& joints) const;

    std::filesystem::path assets_;
    std::string name_;
    std::shared_ptr<const viewport::ArmLook> look_;
    arm::JointPositions joints_;
    std::string refusal_;
    std::optional<arm::PointedGoal> goal_;
    Vec3 wanted_axis_ = Vec3::UnitZ(); ///< of the goal, before it was projected
    std::optional<double> goal_roll_;
    bool projects_ = true;
    std::vector<ArmSolution> solutions_;
    std::string reason_;
    int chosen_ = -1;
    std::optional<ArmPlay> motion_;
    double time_ = 0.0;
    std::optional<arm::JointPositions> held_; ///< rates of a jog
    std::optional<Vec3> held_line_;
    std::shared_ptr<const std::vector<Vec3>> trace_;
    bool follows_unknown_ = false; ///< a controller whose zero means nothing yet
    CardRun card_run_;
    MachineNews news_;
    std::optional<int> new_point_;
    MotionProgramDraft program_;
    MotionFileDraft motion_file_;
    std::shared_ptr<pmac::SharedMemoryStream> stream_;
    std::optional<ArmPathWish> path_wish_;
    bool wants_path_motion_ = false;
    bool of_card_ = false; ///< the motion that is wanted
    int path_motions_ = 0; ///< how many were wanted: an answer to an earlier wish is none to the last
    ArmPathWork path_;
};

} // namespace millwright::actions
