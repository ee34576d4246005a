#include "ui/workspaces/machine_connection.h"

#include "core/pmac/driver/pmac_driver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace millwright::actions {

namespace {

using drivers::DriverState;
using drivers::DriverStatus;

constexpr auto between_looks = std::chrono::milliseconds(50);

bool same(const kinematics::AxisPositions& a, const kinematics::AxisPositions& b) {
    return a.size() == b.size() && a == b;
}

bool same(double a, double b) {
    return !(std::abs(a - b) > 0.0);
}

/// Whether both look the same to a person.
bool looks_same(const DriverStatus& a, const DriverStatus& b) {
    return a.state == b.state && a.activity == b.activity && same(a.position, b.position) &&
           same(a.work_offset, b.work_offset) && a.powered == b.powered &&
           a.position_known == b.position_known && a.modes == b.modes &&
           a.position_doubt == b.position_doubt && a.block == b.block &&
           a.executed_blocks == b.executed_blocks && a.overrides == b.overrides && a.inputs == b.inputs &&
           a.motors == b.motors && a.spindle == b.spindle && a.coolant == b.coolant &&
           a.work_system == b.work_system && a.tool == b.tool && a.sent_blocks == b.sent_blocks &&
           a.tool_change == b.tool_change && same(a.feed, b.feed) && same(a.spindle_rpm, b.spindle_rpm) &&
           a.message == b.message && a.answer.number == b.answer.number && a.answer.state == b.answer.state &&
           (a.probe ? a.probe->number : 0) == (b.probe ? b.probe->number : 0);
}

std::vector<program::ProgramAxis> axes_of(const drivers::Capabilities& can,
                                          const kinematics::MachineModel* model) {
    if (!can.axes.empty() || model == nullptr) {
        return can.axes;
    }
    std::vector<program::ProgramAxis> axes;
    for (const kinematics::MachineAxis& axis : model->axes()) {
        axes.push_back({axis.letter, axis.kind});
    }
    return axes;
}

kinematics::AxisPositions resting_place(const kinematics::MachineModel& model) {
    kinematics::AxisPositions place = kinematics::AxisPositions::Zero(model.axis_count());
    for (int n = 0; n < model.axis_count(); ++n) {
        place[n] = std::clamp(0.0, model.axis(n).min, model.axis(n).max);
    }
    return place;
}

} // namespace

MachineConnection::MachineConnection(std::filesystem::path folder, std::function<void()> wake)
    : folder_(std::move(folder)), wake_(std::move(wake)),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

MachineConnection::~MachineConnection() {
    thread_.request_stop();
    changed_.notify_all();
    thread_.join();
    drop();
}

void MachineConnection::enqueue(Task task) {
    {
        const std::scoped_lock lock(mutex_);
        tasks_.push_back(std::move(task));
    }
    changed_.notify_all();
}

void MachineConnection::connect(const machine::DriverChoice& choice,
                                std::shared_ptr<const kinematics::MachineModel> model,
                                std::shared_ptr<const arm::ArmModel> arm) {
    {
        const std::scoped_lock lock(mutex_);
        view_.link = LinkState::connecting;
        view_.choice = choice;
        view_.failure.reset();
    }
    machine::MovedAxes axes{std::move(model), {}, 1.0, std::move(arm)};
    if (axes.model) {
        axes.position = resting_place(*axes.model);
        axes.known = false; // not checked yet
    }
    enqueue([this, choice, axes = std::move(axes)] {
        drop();
        try_connect(choice, axes);
    });
}

void MachineConnection::disconnect() {
    {
        const std::scoped_lock lock(mutex_);
        if (view_.link == LinkState::none) {
            return;
        }
        view_.link = LinkState::closing;
    }
    enqueue([this] {
        drop();
        const std::scoped_lock lock(mutex_);
        view_ = {LinkState::none, view_.choice, view_.failure, {}, {}, {}, {}, {}, {}};
    });
}

void MachineConnection::reset() {
    tell_in_background([](drivers::Driver& driver) { driver.reset(); });
}

void MachineConnection::reconnect() {
    tell_in_background([this](drivers::Driver& driver) {
        driver.close();
        driver.connect();
        memory_->remind(driver);
    });
}

/// A driver that has no link any more afterwards is dropped: it can be connected anew.
void MachineConnection::tell_in_background(std::function<void(drivers::Driver&)> what) {
    enqueue([this, what = std::move(what)] {
        const auto driver = this->driver();
        if (!driver) {
            return;
        }
        std::optional<Diagnostic> failure;
        try {
            what(*driver);
        } catch (const Error& error) {
            failure = error.diagnostic();
        }
        const bool gone = failure && driver->status().state == DriverState::disconnected;
        const std::scoped_lock lock(mutex_);
        if (gone) {
            driver_.reset();
            view_ = {LinkState::none, view_.choice, failure, {}, {}, {}, {}, {}, {}};
        } else {
            view_.failure = failure;
        }
    });
}

void MachineConnection::try_connect(const machine::DriverChoice& choice, const machine::MovedAxes& axes) {
    std::shared_ptr<drivers::Driver> made;
    jobs::PositionMemory memory(folder_, choice.driver + " " + choice.address);
    std::optional<Diagnostic> failure;
    try {
        made = machine::make_driver(choice, axes, clock_);
        made->connect();
        memory.remind(*made);
    } catch (const Error& error) {
        failure = error.diagnostic();
    }
    const std::scoped_lock lock(mutex_);
    view_ = {failure ? LinkState::none : LinkState::connected, choice, failure, {}, {}, {}, {}, {}, {}};
    if (!failure) {
        memory_ = std::move(memory);
        driver_ = std::move(made);
        view_.status = driver_->status();
        view_.can = driver_->capabilities();
        view_.axes = axes_of(view_.can, axes.model.get());
        view_.firmware = driver_->firmware();
        view_.remarks = driver_->remarks();
    }
}

/// What a person should know of what is left behind is the failure then.
void MachineConnection::drop() {
    std::shared_ptr<drivers::Driver> old;
    {
        const std::scoped_lock lock(mutex_);
        old = std::exchange(driver_, nullptr);
    }
    if (old) {
        remember(old->status()); // a doubt that arose since the last look
        old->close();
    }
    const auto* const card = dynamic_cast<const pmac::PmacDriver*>(old.get());
    const std::string farewell = card == nullptr ? "" : card->farewell();
    const std::scoped_lock lock(mutex_);
    view_.failure =
        farewell.empty() ? std::nullopt : std::optional(Diagnostic{{}, farewell, "inspect the machine"});
}

void MachineConnection::remember(const DriverStatus& status) {
    try {
        memory_->keep(status);
    } catch (const Error& error) {
        const std::scoped_lock lock(mutex_);
        view_.failure = error.diagnostic();
    }
}

void MachineConnection::work(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        Task task;
        {
            std::unique_lock lock(mutex_);
            changed_.wait_for(lock, stop, between_looks, [this] { return !tasks_.empty(); });
            if (stop.stop_requested()) {
                return;
            }
            if (!tasks_.empty()) {
                task = std::move(tasks_.front());
                tasks_.pop_front();
                busy_ = true;
            }
        }
        if (task) {
            task();
            {
                const std::scoped_lock lock(mutex_);
                busy_ = false;
            }
            changed_.notify_all();
            wake_();
        }
        watch();
    }
}

/// Wakes the window when something that it shows is other than before.
void MachineConnection::watch() {
    const auto driver = this->driver();
    if (!driver) {
        return;
    }
    DriverStatus status = driver->status();
    remember(status);
    auto settings = driver->settings();
    auto offsets = driver->stored_offsets();
    auto limits = driver->limits();
    drivers::Capabilities can = driver->capabilities(); // a setting may change them
    std::string firmware = driver->firmware();
    std::vector<std::string> remarks = driver->remarks();
    bool changed = false;
    {
        const std::scoped_lock lock(mutex_);
        changed = !looks_same(status, view_.status) || settings.size() != view_.settings.size() ||
                  can.manual.home != view_.can.manual.home || firmware != view_.firmware ||
                  remarks != view_.remarks;
        if (!can.axes.empty()) {
            view_.axes = can.axes;
        }
        view_.can = std::move(can);
        view_.status = std::move(status);
        view_.settings = std::move(settings);
        view_.offsets = std::move(offsets);
        view_.limits = std::move(limits);
        view_.firmware = std::move(firmware);
        view_.remarks = std::move(remarks);
    }
    if (changed) {
        wake_();
    }
}

ConnectionView MachineConnection::view() const {
    const std::scoped_lock lock(mutex_);
    return view_;
}

std::shared_ptr<drivers::Driver> MachineConnection::driver() const {
    const std::scoped_lock lock(mutex_);
    return driver_;
}

std::shared_ptr<drivers::Console> MachineConnection::console() const {
    auto owner = driver();
    drivers::Console* console = owner ? owner->console() : nullptr;
    return console == nullptr ? nullptr : std::shared_ptr<drivers::Console>(std::move(owner), console);
}

void MachineConnection::tell(const std::function<void(drivers::Driver&)>& what) {
    const auto driver = this->driver();
    if (!driver) {
        throw Error("no machine is connected");
    }
    try {
        what(*driver);
    } catch (const Error& error) {
        throw MachineError(error);
    }
}

void MachineConnection::emergency_stop() {
    if (const auto driver = this->driver()) {
        driver->emergency_stop();
    }
}

void MachineConnection::wait_idle() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return tasks_.empty() && !busy_; });
}

} // namespace millwright::actions
