// The machine that is connected, between jobs and while one runs: made and dropped in the background, watched
// all the time, told what a person does by hand.
#pragma once

#include "core/base/clock.h"
#include "core/base/error.h"
#include "core/drivers/console.h"
#include "core/drivers/driver.h"
#include "core/jobs/position_memory.h"
#include "core/machine/drivers_by_name.h"

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace millwright::actions {

enum class LinkState { none, connecting, connected, closing };

/// What is known of it, for one frame.
struct ConnectionView {
    LinkState link = LinkState::none;
    machine::DriverChoice choice;      ///< of the link that is there or was tried last
    std::optional<Diagnostic> failure; ///< why the last attempt came to nothing
    drivers::DriverStatus status;
    drivers::Capabilities can;
    std::vector<program::ProgramAxis> axes; ///< in the order of the positions
    std::vector<drivers::ControllerSetting> settings;
    std::vector<drivers::StoredOffset> offsets;
    drivers::MachineLimits limits;
    std::string firmware{};             ///< Driver::firmware()
    std::vector<std::string> remarks{}; ///< Driver::remarks()

    [[nodiscard]] bool connected() const { return link == LinkState::connected; }
    /// What its driver brings along.
    [[nodiscard]] const machine::DriverRow& row() const { return machine::driver_row(choice.driver); }
};

/// What the connected machine refuses, or says of itself: shown as long as it is in that state.
class MachineError final : public Error {
public:
    explicit MachineError(const Error& of_driver) : Error(of_driver.diagnostic()) {}
};

class MachineConnection {
public:
    /// `wake`: from any thread, when something that is seen has changed. Doubts about positions outlast this
    /// in `folder`.
    MachineConnection(std::filesystem::path folder, std::function<void()> wake);
    MachineConnection(const MachineConnection&) = delete;
    MachineConnection& operator=(const MachineConnection&) = delete;
    /// Stops whatever moves and drops the link.
    ~MachineConnection();

    /// In the background, in place of what is connected. `model`: of machines that no controller plans for;
    /// `arm`: what a PMAC moves. Nothing moves.
    void connect(const machine::DriverChoice& choice,
                 std::shared_ptr<const kinematics::MachineModel> model,
                 std::shared_ptr<const arm::ArmModel> arm);
    /// In the background, makes a lost link again. Nothing moves; a controller that is locked stays so.
    void reconnect();
    /// In the background: stops what moves first.
    void disconnect();
    /// After an alarm, in the background.
    void reset();

    [[nodiscard]] ConnectionView view() const;
    /// Null unless connected. For jobs; stays alive as long as somebody has it.
    [[nodiscard]] std::shared_ptr<drivers::Driver> driver() const;
    /// Null where there is none. Lives as long as the driver.
    [[nodiscard]] std::shared_ptr<drivers::Console> console() const;

    /// Does something with the driver at once. Throws Error if none is connected, MachineError with what the
    /// driver says.
    void tell(const std::function<void(drivers::Driver&)>& what);
    /// The same without any complaint where nothing is connected.
    void emergency_stop();

    /// Blocks until nothing of the above is under way (tests).
    void wait_idle() const;

private:
    using Task = std::function<void()>;

    void enqueue(Task task);
    void work(const std::stop_token& stop);
    void watch();
    void try_connect(const machine::DriverChoice& choice, const machine::MovedAxes& axes);
    void drop();
    void remember(const drivers::DriverStatus& status);
    void tell_in_background(std::function<void(drivers::Driver&)> what);

    std::filesystem::path folder_;
    std::function<void()> wake_;
    SteadyClock clock_;        ///< outlives every driver
    mutable std::mutex mutex_; ///< guards what follows
    mutable std::condition_variable_any changed_;
    std::deque<Task> tasks_;
    bool busy_ = false;
    std::shared_ptr<drivers::Driver> driver_;
    std::optional<jobs::PositionMemory> memory_; ///< of `driver_`; for the thread alone
    ConnectionView view_;
    std::jthread thread_; // last: it ends before what it uses
};

} // namespace millwright::actions
