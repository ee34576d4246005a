#include "core/emulators/linuxcnc/internal/task.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/gcode/interpreter.h"
#include "core/gcode_programs/machine_program.h"
#include "core/motion/planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::emulators::internal {

namespace {

using kinematics::AxisPositions;
using program::Block;

std::string take_first(std::deque<std::string>& queue) {
    if (queue.empty()) {
        return "OK";
    }
    std::string first = std::move(queue.front());
    queue.pop_front();
    return first;
}

std::deque<std::pair<int, std::string>> messages_in(const std::string& text) {
    constexpr std::string_view begin = "(MSG,";
    std::deque<std::pair<int, std::string>> found;
    int line = 1;
    for (std::size_t at = 0; at < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view words = std::string_view(text).substr(at, end - at);
        if (words.starts_with(begin)) {
            found.emplace_back(line, words.substr(begin.size(), words.find(')') - begin.size()));
        }
        at = end + 1;
    }
    return found;
}

} // namespace

LinuxCncTask::LinuxCncTask(std::shared_ptr<const kinematics::MachineModel> model,
                           double time,
                           LinuxCncTruth truth)
    : model_(std::move(model)), clock_(time),
      machine_(AxisPositions(AxisPositions::Zero(model_->axis_count())), {1.0}, clock_, model_),
      truth_(std::move(truth)) {
    machine_.connect();
    machine_.emergency_stop();
}

void LinuxCncTask::advance(double seconds) {
    clock_.wait(seconds);
    follow(machine_.status());
}

/// What the machine has done since the last look.
void LinuxCncTask::follow(const drivers::DriverStatus& now) {
    if (now.velocity.size() > 0 && now.velocity.cwiseAbs().maxCoeff() > 0.0) {
        truth_.last_motion = clock_.now();
    }
    if (homing_ && now.activity == drivers::Activity::none) {
        homing_ = false;
        homed_ = now.state == drivers::DriverState::idle;
    }
    if (!program_) {
        return;
    }
    const auto& blocks = program_->blocks->blocks;
    for (; program_->executed < now.executed_blocks; ++program_->executed) {
        const Block& block = blocks[static_cast<std::size_t>(program_->executed)];
        const bool last_of_line =
            program_->executed + 1 == std::ssize(blocks) ||
            blocks[static_cast<std::size_t>(program_->executed) + 1].source_line != block.source_line;
        if (block.moves() && last_of_line) {
            truth_.lines.push_back({truth_.runs, block.source_line, clock_.now()});
        }
    }
    if (now.block >= 0 && now.block < std::ssize(blocks)) {
        line_ = blocks[static_cast<std::size_t>(now.block)].source_line;
        tell_messages(line_);
    }
    paused_ = paused_ || now.state == drivers::DriverState::holding;
    if (now.state == drivers::DriverState::idle) {
        end_program();
    } else if (now.state == drivers::DriverState::stopped) {
        program_.reset();
    }
}

void LinuxCncTask::tell_messages(int before_line) {
    while (!program_->messages.empty() && program_->messages.front().first < before_line) {
        messages_.push_back(program_->messages.front().second);
        program_->messages.pop_front();
    }
}

void LinuxCncTask::end_program() {
    if (program_->error.empty()) {
        constexpr int behind_all = 1'000'000'000;
        tell_messages(behind_all);
        ++truth_.ended_runs;
    } else {
        errors_.push_back(program_->error);
    }
    program_.reset();
    paused_ = false;
}

void LinuxCncTask::fall_off() {
    machine_.emergency_stop();
    follow(machine_.status());
    paused_ = homing_ = false;
    power_ = power_ == Power::on ? Power::off : power_;
    program_.reset();
}

void LinuxCncTask::set_estop(bool on) {
    if (on) {
        fall_off();
        power_ = Power::estop;
    } else if (power_ == Power::estop) {
        power_ = Power::off;
    }
}

void LinuxCncTask::set_power(bool on) {
    if (!on) {
        fall_off();
    } else if (power_ == Power::estop) {
        errors_.emplace_back("can't turn the machine on in its emergency stop");
    } else if (power_ == Power::off) {
        power_ = Power::on;
        machine_.reset();
    }
}

bool LinuxCncTask::ready(TaskMode mode, std::string_view what) {
    if (power_ != Power::on) {
        errors_.push_back(fmt::format("can't {} while the machine is off", what));
    } else if (mode_ != mode) {
        errors_.push_back(fmt::format("can't {} in this mode", what));
    } else if (mode != TaskMode::manual && !homed_) {
        errors_.push_back(fmt::format("can't {} when not homed", what));
    } else if (machine_.status().activity != drivers::Activity::none &&
               machine_.status().activity != drivers::Activity::jog) {
        errors_.push_back(fmt::format("can't {} while the machine is busy", what));
    } else {
        return true;
    }
    return false;
}

void LinuxCncTask::set_mode(TaskMode mode) {
    if (machine_.status().activity != drivers::Activity::none && mode != mode_) {
        errors_.emplace_back("can't change the mode while the machine is busy");
        return;
    }
    mode_ = mode;
}

void LinuxCncTask::open(const std::filesystem::path& file) {
    try {
        opened_ = read_file(file);
    } catch (const Error& error) {
        opened_.reset();
        errors_.push_back(fmt::format("can't open {}: {}", file.string(), error.what()));
    }
}

/// What comes before the first line that is wrong, as LinuxCNC executes it before it complains.
LinuxCncTask::Program LinuxCncTask::read(const std::string& text) const {
    gcode::ReaderSettings settings;
    settings.any_tool = true;
    const AxisPositions position = machine_.status().position;
    for (int n = 0; n < model_->axis_count(); ++n) {
        const auto* letter = std::ranges::find(gcode::axis_letters, model_->axis(n).letter);
        const bool rotary = model_->axis(n).kind == kinematics::AxisKind::rotary;
        settings.start[static_cast<std::size_t>(letter - gcode::axis_letters.begin())] =
            rotary ? to_degrees(position[n]) : position[n];
    }
    gcode::MachineProgramSettings target;
    target.start = position;
    gcode::MachineProgramBuilder builder(*model_, "program", target);
    gcode::Interpreter reader(std::string_view(text), "program", std::move(settings), builder);
    reader.run();
    gcode::MachineProgram made = builder.take();
    std::vector<Diagnostic> faults = reader.errors();
    faults.insert(faults.end(), made.faults.begin(), made.faults.end());
    Program result;
    result.messages = messages_in(text);
    if (!faults.empty()) {
        const auto first =
            std::ranges::min_element(faults, {}, [](const Diagnostic& fault) { return fault.place.line; });
        result.error = first->message;
        std::erase_if(made.program.blocks,
                      [&](const Block& block) { return block.source_line >= first->place.line; });
    }
    cut_at_limits(result, made.program);
    for (Block& block : made.program.blocks) {
        if (block.kind == program::BlockKind::pause && block.pause == program::PauseKind::tool_change) {
            block.kind = program::BlockKind::spindle_off; // its tool changer does not wait for an operator
        }
    }
    if (made.program.blocks.empty()) { // nothing moves, and that takes no time
        made.program.blocks.emplace_back().kind = program::BlockKind::end;
        made.program.blocks.back().target = position;
    }
    result.blocks = std::make_shared<const program::Program>(std::move(made.program));
    return result;
}

void LinuxCncTask::cut_at_limits(Program& program, program::Program& blocks) const {
    for (std::size_t n = 0; n < blocks.blocks.size(); ++n) {
        for (int axis = 0; axis < model_->axis_count(); ++axis) {
            const double target = blocks.blocks[n].target[axis];
            if (!(target >= model_->axis(axis).min && target <= model_->axis(axis).max)) {
                program.error = fmt::format("Linear move on line {} would exceed the limits of axis {}",
                                            blocks.blocks[n].source_line,
                                            model_->axis(axis).letter);
                blocks.blocks.resize(n);
                return;
            }
        }
    }
}

void LinuxCncTask::run() {
    if (!ready(TaskMode::automatic, "run a program")) {
        return;
    }
    if (!opened_) {
        errors_.emplace_back("can't run a program: none is open");
        return;
    }
    Program program = read(*opened_);
    auto motion = std::make_shared<const motion::Trajectory>(
        motion::plan(*program.blocks, *model_, {}, Progress(), machine_.status().position));
    ++truth_.runs;
    const auto moving =
        std::ranges::find_if(program.blocks->blocks.rbegin(), program.blocks->blocks.rend(), &Block::moves);
    read_line_ = moving == program.blocks->blocks.rend() ? 0 : moving->source_line;
    show_read_line();
    machine_.start({program.blocks, std::move(motion), nullptr, {}});
    program_ = std::move(program);
    paused_ = false;
    set_feed_override(feed_override_);
}

void LinuxCncTask::pause() {
    if (program_) {
        machine_.hold();
        paused_ = true;
    }
}

void LinuxCncTask::resume() {
    if (program_ && paused_) {
        machine_.resume();
        paused_ = false;
    }
}

void LinuxCncTask::show_read_line() {
    constexpr double moment = 0.05; // s
    shows_read_until_ = clock_.now() + moment;
}

void LinuxCncTask::abort() {
    if (program_) {
        show_read_line();
    }
    machine_.stop();
    paused_ = homing_ = false;
    follow(machine_.status());
}

void LinuxCncTask::mdi(const std::string& line) {
    if (!ready(TaskMode::mdi, "issue an MDI command")) {
        return;
    }
    (void)machine_.command(line);
    const drivers::CommandAnswer answer = machine_.status().answer;
    if (answer.state == drivers::CommandAnswer::State::refused) {
        errors_.push_back(answer.text);
    }
}

void LinuxCncTask::home() {
    if (ready(TaskMode::manual, "home")) {
        machine_.home();
        homing_ = true;
    }
}

void LinuxCncTask::jog(int axis, double speed, double way) {
    if (!ready(TaskMode::manual, "jog")) {
        return;
    }
    drivers::Jog jog;
    jog.way = AxisPositions::Zero(model_->axis_count());
    jog.way[axis] = std::copysign(way, speed);
    jog.speed = from_mm_per_min(std::abs(speed));
    try {
        machine_.jog(jog);
    } catch (const Error& error) {
        errors_.emplace_back(error.what());
    }
}

void LinuxCncTask::stop_jog() {
    machine_.stop_jog();
}

void LinuxCncTask::set_feed_override(int percent) {
    feed_override_ = percent;
    machine_.set_overrides({.feed = percent, .rapid = 100, .spindle = 100});
}

std::string LinuxCncTask::program_status() const {
    if (machine_.status().activity == drivers::Activity::none && !program_) {
        return "IDLE";
    }
    return paused_ ? "PAUSED" : "RUNNING";
}

std::string LinuxCncTask::take_error() {
    return take_first(errors_);
}

std::string LinuxCncTask::take_message() {
    return take_first(messages_);
}

} // namespace millwright::emulators::internal
