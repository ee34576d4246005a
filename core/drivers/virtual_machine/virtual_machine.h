// A machine inside this program: moves its axes along the trajectory in real or faster time, and brakes and
// starts again as the axes' accelerations allow. The default driver, so that everything works with nothing
// plugged in.
#pragma once

#include "core/base/clock.h"
#include "core/drivers/console.h"
#include "core/drivers/driver.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

namespace millwright::drivers {

namespace internal {
class VirtualAxes;
}

/// Machine seconds per second: 0.01 to 1000, or `unlimited`: as fast as it can be computed.
struct VirtualSpeed {
    static constexpr double unlimited = 0.0;
    static constexpr double slowest = 0.01;
    static constexpr double fastest = 1000.0;
    double factor = 1.0;
};

/// Its own thread moves it on; the position that status() gives is that of the very moment of the call. On
/// close() it brakes to rest at once, without taking the time.
class VirtualMachine final : public Driver {
public:
    /// Stands at `position`, disconnected. `clock` must outlive it. Throws Error for a speed out of range.
    /// With a model it can also be moved by hand: it jogs (in real time, whatever the speed) and homes, to
    /// zero or the limit next to it, within the limits of its axes, and executes single lines of G-code as
    /// LinuxCNC reads them. Work offsets hold for these lines; programs come in machine coordinates. Its
    /// coolant is one and shown as flood.
    VirtualMachine(kinematics::AxisPositions position,
                   VirtualSpeed speed,
                   Clock& clock,
                   std::shared_ptr<const kinematics::MachineModel> model = nullptr);
    VirtualMachine(const VirtualMachine&) = delete;
    VirtualMachine& operator=(const VirtualMachine&) = delete;
    ~VirtualMachine() override;

    [[nodiscard]] std::string name() const override { return "virtual"; }
    [[nodiscard]] DriverStatus status() const override;
    [[nodiscard]] Capabilities capabilities() const override;
    /// Also while running. Throws Error if it is out of range.
    void set_speed(VirtualSpeed speed);

    void connect() override;
    void start(Work work) override;
    void hold() override;
    void resume() override;
    void stop() override;
    void emergency_stop() override;
    void reset() override;
    void close() noexcept override;
    void set_overrides(const Overrides& wanted) override;
    /// Rests after each move, and what follows it without one: on the path, so within its rounding of where
    /// the block ends.
    void set_single_block(bool on) override;
    void set_optional_stop(bool on) override;
    /// It is put there; nothing moves.
    void stands_at(const kinematics::AxisPositions& position) override;
    void jog(const Jog& jog) override;
    void stop_jog() override;
    void home() override;
    int command(const std::string& lines) override;
    [[nodiscard]] std::vector<StoredOffset> stored_offsets() const override;
    [[nodiscard]] Console* console() override { return &console_; }

private:
    void run(const std::stop_token& stop) noexcept;
    void move_on(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
    void catch_up() const;
    [[nodiscard]] bool as_fast_as_possible() const;

    Clock& clock_;
    mutable std::mutex mutex_; ///< guards all below
    std::condition_variable_any changed_;
    VirtualSpeed speed_;
    mutable double caught_up_to_ = 0.0; ///< clock time
    std::unique_ptr<internal::VirtualAxes> axes_;
    mutable std::optional<double> jog_until_; ///< clock time of the dead man
    Console console_;
    std::jthread thread_; ///< last: ends before what it uses
};

} // namespace millwright::drivers
