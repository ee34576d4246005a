// The part of AppController that deals with the arm: what it shows, plays, and gives to its card.
#include "core/arm/arm_motion_file.h"
#include "core/arm/arm_simulation.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/motion/arm_motion.h"
#include "core/pmac/driver/arm_axes.h"
#include "core/pmac/driver/pmac_file.h"
#include "core/pmac/driver/pmac_program.h"
#include "core/project/taught_points.h"
#include "ui/actions/app_controller.h"
#include "ui/workspaces/arm_workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::actions {

namespace {

namespace fs = std::filesystem;

} // namespace

ArmPlay play_of(std::shared_ptr<const pmac::MotionSimulation> simulation) {
    const double duration = simulation->records.back().time;
    const auto at = [records = std::move(simulation)](double time) {
        const auto& all = records->records;
        const auto next = std::ranges::lower_bound(all, time, {}, &pmac::MotionRecord::time);
        const pmac::MotionRecord& after = next == all.end() ? all.back() : *next;
        const pmac::MotionRecord& before = next == all.begin() ? after : *(next - 1);
        const double span = after.time - before.time;
        const double share = span > 0.0 ? std::clamp((time - before.time) / span, 0.0, 1.0) : 1.0;
        arm::JointPositions joints(std::ssize(after.degrees));
        for (Eigen::Index n = 0; n < joints.size(); ++n) {
            const auto axis = static_cast<std::size_t>(n);
            joints[n] = from_degrees(std::lerp(before.degrees[axis], after.degrees[axis], share));
        }
        return joints;
    };
    return {at, duration};
}

namespace {

/// While a motion was worked out the arm may have been moved.
void expect_start(const motion::Trajectory& motion, const arm::JointPositions& joints) {
    constexpr double near_deg = 0.5;
    const double away = (motion.at(0.0).position - joints).cwiseAbs().maxCoeff();
    if (away > from_degrees(near_deg)) {
        throw Error("the arm is no longer where this motion begins", {}, "start the motion again");
    }
}

/// Nothing came between while the motion was worked out: no stop, no loss of power, no other arm.
bool can_go_path(const FrameState& now, bool of_card) {
    using drivers::DriverState;
    const drivers::DriverStatus& status = now.connection.status;
    const bool rests = status.state == DriverState::idle || status.state == DriverState::stopped;
    return of_card ? now.arm_connected() && rests && status.powered && status.position_known
                   : !now.arm_connected();
}

/// One notice of one kind of findings: a pile of them would hide what matters.
void tell_findings(ViewState& view_state, const std::vector<Diagnostic>& found, std::string_view several) {
    if (found.empty()) {
        return;
    }
    std::string text = found.size() > 1 ? fmt::format("{} {}:", found.size(), several) : "";
    for (const Diagnostic& one : found) {
        text += fmt::format("{}line {}: {}", text.empty() ? "" : "\n", one.place.line, one.message);
    }
    tell(view_state, widgets::Severity::warning, text, found.front().place.file.filename().string());
}

} // namespace

/// It has an arm once it is looked at; a connected one is drawn at its position.
bool AppController::follow_arm(const FrameState& now, double seconds) {
    if (view_state_.workspace == Workspace::arm && !arm_->loaded() && !arm_failed_) {
        arm_failed_ = true; // said once
        guarded([this] { arm_->load("motoman-l3"); });
        arm_failed_ = !arm_->loaded();
    }
    if (!arm_->loaded()) {
        return false;
    }
    follow_arm_work(now);
    const ConnectionView& connection = now.connection;
    arm_->card_run().follow(connection.status, seconds);
    if (connection.connected() && connection.row().kind == machine::MachineKind::arm) {
        arm_->follow(connection.status.position, connection.status.position_known);
    }
    return arm_->advance(seconds);
}

/// What was asked of the background: faults of the text, its simulation, the path on the arm.
void AppController::follow_arm_work(const FrameState& now) {
    arm_->program().follow(now.project.arm.program);
    arm_->motion_file().follow(now.project.arm.motion_file);
    if (const auto simulation = arm_->program().take()) {
        if (simulation->records.size() > 1 && !now.arm_connected()) {
            arm_->play(play_of(simulation));
        } else if (simulation->faults.empty()) {
            tell(view_state_,
                 widgets::Severity::good,
                 fmt::format(
                     "On an emulated card, the program takes {:.1f} s and no joint exceeds its limits.",
                     simulation->duration));
        }
        if (!simulation->faults.empty()) {
            tell(view_state_, widgets::Severity::warning, to_text(simulation->faults.front()));
        }
    }
    const ProgramOfMachine shown_one = now.arm_program();
    const bool shown =
        view_state_.manual.arm_path.shown && view_state_.workspace == Workspace::arm && shown_one.program;
    arm_->look_at_path(shown ? std::optional(ArmPathWish{shown_one.program,
                                                         shown_one.machine,
                                                         arm_->look(),
                                                         project::base_T_path(now.project.arm.path),
                                                         from_degrees(now.project.arm.path.most_lean_deg),
                                                         arm_->joints(),
                                                         0})
                             : std::nullopt);
    if (arm_->works_out_path_motion() && !can_go_path(now, arm_->path_motion_is_of_card())) {
        arm_->call_off_path_motion();
        tell(view_state_,
             widgets::Severity::warning,
             "The path was not run: the state of the arm has changed since the request. Start it again.");
    }
    if (const auto answer = arm_->take_path_motion()) {
        guarded([&] {
            if (!answer->motion) {
                throw Error("the arm cannot run this path: " + answer->why);
            }
            play_on_arm(*answer->motion);
        });
    }
}

void AppController::play_on_arm(const motion::Trajectory& motion) {
    expect_start(motion, arm_->joints());
    if (look().arm_connected()) {
        const auto lines = pmac::pmac_program(motion, pmac::arm_settings_of(look().connection.choice.axes));
        const auto axes = std::ssize(look().connection.axes);
        run_on_card(lines, motion.duration(), pmac::line_ends(lines));
        arm_->card_run().know_way(
            [motion = std::make_shared<const motion::Trajectory>(motion), axes](double time) {
                return kinematics::AxisPositions(motion->at(time).position.head(axes));
            });
    } else {
        arm_->play(play_of(motion));
    }
}

void AppController::play_on_arm(ArmFileMotion motion) {
    if (look().arm_connected()) {
        play_on_arm(motion.trajectory);
    } else {
        expect_start(motion.trajectory, arm_->joints());
        arm_->play(play_of(std::move(motion)));
    }
}

void AppController::open_arm(const fs::path& file) {
    view_state_.file_prompt = FilePrompt::none;
    arm_->load(fs::absolute(file).string());
    view_state_.fit_wanted_in(Workspace::arm) = true; // arms differ in size
}

void AppController::play_motion_file(const fs::path& file) {
    view_state_.file_prompt = FilePrompt::none;
    play_on_arm(motion_of_file(arm_->arm(), read_file(file), arm_->joints(), file));
}

void AppController::play_motion_text() {
    play_on_arm(motion_of_file(
        arm_->arm(), history_.current().arm.motion_file, arm_->joints(), MotionFileDraft::name()));
}

void AppController::simulate_motion_file() {
    auto motion = motion_of_file(
        arm_->arm(), history_.current().arm.motion_file, arm_->home(), MotionFileDraft::name());
    tell(view_state_,
         widgets::Severity::info,
         fmt::format("From its home, the arm takes {:.1f} s.", motion.trajectory.duration()));
    arm_->play(play_of(std::move(motion)));
    arm_->clear_trace();
}

void AppController::stream_motion_file() {
    constexpr double deg_per_s = 10.0;
    const auto blocks = arm::parse_arm_motion(history_.current().arm.motion_file, MotionFileDraft::name());
    const auto records = arm::simulate_arm(
        arm_->arm(), blocks, arm_->home(), view_state_.manual.arm_result_step, MotionFileDraft::name());
    auto stream =
        std::make_shared<pmac::SharedMemoryStream>(arm::first_turns_deg(arm_->arm(), records), deg_per_s);
    if (arm::sets_feed(blocks)) {
        tell(view_state_,
             widgets::Severity::info,
             fmt::format("The stream ignores F: each move takes {:.0f} ms, in which no motor exceeds {} "
                         "degrees per second.",
                         1e3 * stream->move_time(),
                         deg_per_s));
    }
    arm_->play_stream(std::move(stream));
}

void AppController::run_on_card(const std::vector<std::string>& lines,
                                double duration,
                                std::vector<double> ends) {
    auto listing = std::make_shared<program::Listing>();
    for (const std::string& line : lines) {
        listing->text += line + "\n";
    }
    connection_->tell([&](drivers::Driver& driver) { driver.start({nullptr, nullptr, std::move(listing)}); });
    arm_->card_run().begin({static_cast<int>(lines.size()), duration, std::move(ends)});
}

void AppController::load_card_settings(const fs::path& file) {
    view_state_.file_prompt = FilePrompt::none;
    pmac::PmacFile found = pmac::read_pmac_file(read_file(file), file);
    for (const auto& [kind, several] :
         {std::pair(&found.omissions, "lines were skipped"),
          std::pair(&found.warnings, "settings disable protections or are too large")}) {
        tell_findings(view_state_, *kind, several);
    }
    std::vector<std::string> lines;
    for (const pmac::PmacFile::Line& line : found.lines) {
        lines.push_back(line.text);
    }
    connection_->tell([&](drivers::Driver& driver) { settings_sent_ = driver.load(lines); });
    tell(view_state_,
         widgets::Severity::info,
         counted(lines.size(), "line") + " of " + file.filename().string() + " sent, with " +
             counted(found.warnings.size() + found.omissions.size(), "warning") + ".");
    arm_->news().sent(*std::exchange(settings_sent_, std::nullopt), std::move(found));
}

void AppController::open_points(const fs::path& file) {
    view_state_.file_prompt = FilePrompt::none;
    edit("Open taught points",
         [points = project::read_taught_points(file)](project::Project& draft) { draft.arm.points = points; },
         {});
}

void AppController::save_points(const fs::path& file) {
    project::write_taught_points(history_.current().arm.points, file);
    view_state_.file_prompt = FilePrompt::none;
    tell(view_state_, widgets::Severity::info, "Saved " + file.filename().string() + ".");
}

void AppController::open_motion_program(const fs::path& file) {
    view_state_.file_prompt = FilePrompt::none;
    edit("Open a motion program",
         [text = read_file(file)](project::Project& draft) { draft.arm.program = text; },
         {});
}

void AppController::save_motion_program(const fs::path& file) {
    write_file(file, history_.current().arm.program);
    view_state_.file_prompt = FilePrompt::none;
    tell(view_state_, widgets::Severity::info, "Saved " + file.filename().string() + ".");
}

void AppController::open_motion_file(const fs::path& file) {
    view_state_.file_prompt = FilePrompt::none;
    edit("Open a motion file",
         [text = read_file(file)](project::Project& draft) { draft.arm.motion_file = text; },
         {});
}

void AppController::save_motion_file(const fs::path& file) {
    write_file(file, history_.current().arm.motion_file);
    view_state_.file_prompt = FilePrompt::none;
    tell(view_state_, widgets::Severity::info, "Saved " + file.filename().string() + ".");
}

void AppController::save_motion_result(const fs::path& file) {
    view_state_.file_prompt = FilePrompt::none;
    const auto blocks = arm::parse_arm_motion(history_.current().arm.motion_file, MotionFileDraft::name());
    const auto records = arm::simulate_arm(
        arm_->arm(), blocks, arm_->home(), view_state_.manual.arm_result_step, MotionFileDraft::name());
    write_file(file, arm::arm_result_text(arm_->arm(), records));
    tell(view_state_,
         widgets::Severity::info,
         counted(records.size(), "point") + " saved in " + file.filename().string() + ".");
}

} // namespace millwright::actions
