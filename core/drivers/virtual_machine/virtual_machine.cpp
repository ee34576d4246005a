#include "core/drivers/virtual_machine/virtual_machine.h"

#include "core/base/error.h"
#include "core/drivers/virtual_machine/internal/virtual_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace millwright::drivers {

namespace {

bool unlimited(VirtualSpeed speed) {
    return !(speed.factor > VirtualSpeed::unlimited);
}

void check_speed(VirtualSpeed speed) {
    const double factor = speed.factor;
    const bool in_range = factor >= VirtualSpeed::slowest && factor <= VirtualSpeed::fastest;
    if (!in_range && !(factor >= 0.0 && unlimited(speed))) {
        throw Error(
            fmt::format("the speed of the virtual machine, {}, must be between {} and {}, or 0 for unlimited",
                        factor,
                        VirtualSpeed::slowest,
                        VirtualSpeed::fastest));
    }
}

} // namespace

VirtualMachine::VirtualMachine(kinematics::AxisPositions position,
                               VirtualSpeed speed,
                               Clock& clock,
                               std::shared_ptr<const kinematics::MachineModel> model)
    : clock_(clock), speed_(speed),
      axes_(std::make_unique<internal::VirtualAxes>(std::move(position), std::move(model))) {
    check_speed(speed);
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

VirtualMachine::~VirtualMachine() {
    close();
}

DriverStatus VirtualMachine::status() const {
    const std::scoped_lock lock(mutex_);
    catch_up();
    return axes_->status();
}

void VirtualMachine::set_speed(VirtualSpeed speed) {
    check_speed(speed);
    const std::scoped_lock lock(mutex_);
    catch_up();
    speed_ = speed;
    changed_.notify_all();
}

void VirtualMachine::connect() {
    const std::scoped_lock lock(mutex_);
    axes_->connect();
}

void VirtualMachine::start(Work work) {
    const std::scoped_lock lock(mutex_);
    catch_up();
    axes_->start(std::move(work));
    changed_.notify_all();
}

void VirtualMachine::hold() {
    const std::scoped_lock lock(mutex_);
    catch_up();
    axes_->hold();
}

void VirtualMachine::resume() {
    const std::scoped_lock lock(mutex_);
    catch_up();
    axes_->resume();
    changed_.notify_all();
}

void VirtualMachine::stop() {
    const std::scoped_lock lock(mutex_);
    catch_up();
    axes_->stop();
}

void VirtualMachine::emergency_stop() {
    const std::scoped_lock lock(mutex_);
    catch_up();
    axes_->emergency_stop("emergency stop");
}

void VirtualMachine::reset() {
    const std::scoped_lock lock(mutex_);
    axes_->reset();
}

void VirtualMachine::stands_at(const kinematics::AxisPositions& position) {
    const std::scoped_lock lock(mutex_);
    catch_up();
    axes_->stands_at(position);
}

void VirtualMachine::close() noexcept {
    const std::scoped_lock lock(mutex_);
    try {
        catch_up();
        axes_->close();
    } catch (const std::exception& defect) {
        axes_->emergency_stop(defect.what());
    }
}

Capabilities VirtualMachine::capabilities() const {
    Capabilities able;
    able.program.single_block = able.program.optional_stop = true;
    able.overrides = Capabilities::OverrideRange::all;
    if (const kinematics::MachineModel* model = axes_->model()) {
        for (const kinematics::MachineAxis& axis : model->axes()) {
            able.axes.push_back({axis.letter, axis.kind});
        }
        able.manual.jog = able.manual.home = able.manual.command = true;
    }
    return able;
}

void VirtualMachine::set_overrides(const Overrides& wanted) {
    const std::scoped_lock lock(mutex_);
    catch_up();
    axes_->set_overrides(wanted);
    changed_.notify_all();
}

void VirtualMachine::set_single_block(bool on) {
    const std::scoped_lock lock(mutex_);
    catch_up();
    axes_->set_single_block(on);
    changed_.notify_all();
}

void VirtualMachine::set_optional_stop(bool on) {
    const std::scoped_lock lock(mutex_);
    catch_up();
    axes_->set_optional_stop(on);
}

void VirtualMachine::jog(const Jog& jog) {
    const std::scoped_lock lock(mutex_);
    catch_up();
    axes_->jog(jog);
    jog_until_ = jog.dead_man > 0.0 ? std::optional(clock_.now() + jog.dead_man) : std::nullopt;
    changed_.notify_all();
}

void VirtualMachine::stop_jog() {
    const std::scoped_lock lock(mutex_);
    catch_up();
    axes_->stop_jog();
}

void VirtualMachine::home() {
    const std::scoped_lock lock(mutex_);
    catch_up();
    axes_->home();
    changed_.notify_all();
}

int VirtualMachine::command(const std::string& lines) {
    const std::scoped_lock lock(mutex_);
    catch_up();
    const int number = axes_->command(lines);
    console_.add(clock_.now(), true, ConsoleKind::line, lines);
    const CommandAnswer answer = axes_->status().answer;
    if (answer.state == CommandAnswer::State::refused) {
        console_.add(clock_.now(), false, ConsoleKind::fault, answer.text);
    } else {
        console_.add(clock_.now(), false, ConsoleKind::answer, "ok");
    }
    changed_.notify_all();
    return number;
}

std::vector<StoredOffset> VirtualMachine::stored_offsets() const {
    const std::scoped_lock lock(mutex_);
    return axes_->stored_offsets();
}

/// A hand has real time, whatever the machine's.
bool VirtualMachine::as_fast_as_possible() const {
    return unlimited(speed_) && !axes_->jogging();
}

/// Moves the axes to where they are at this moment of the clock.
void VirtualMachine::catch_up() const {
    const double now = clock_.now();
    double from = std::exchange(caught_up_to_, now);
    if (axes_->jogging()) {
        if (jog_until_ && *jog_until_ < now) {
            const double dead = std::max(from, *jog_until_);
            axes_->advance(std::max(0.0, dead - from));
            axes_->stop_jog();
            jog_until_.reset();
            from = dead;
        }
        axes_->advance(std::max(0.0, now - from));
    } else if (!unlimited(speed_)) {
        axes_->advance(std::max(0.0, now - from) * speed_.factor);
    }
}

void VirtualMachine::run(const std::stop_token& stop) noexcept {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
        try {
            move_on(lock, stop);
        } catch (const std::exception& defect) {
            axes_->emergency_stop(defect.what());
        }
    }
}

void VirtualMachine::move_on(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
    const auto woken = [&] { return stop.stop_requested(); };
    if (!axes_->moving()) {
        changed_.wait(lock, stop, [&] { return axes_->moving(); });
        return;
    }
    if (as_fast_as_possible()) {
        constexpr double stride = 0.5;                  // s of the machine
        constexpr std::chrono::microseconds others{50}; // in which commands get their turn
        axes_->advance(stride);
        changed_.wait_for(lock, stop, others, woken);
        return;
    }
    constexpr std::chrono::milliseconds tick{5};
    catch_up();
    changed_.wait_for(lock, stop, tick, woken);
}

} // namespace millwright::drivers
