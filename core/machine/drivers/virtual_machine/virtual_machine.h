// A machine inside this program: moves its axes along the trajectory in real or faster time, and brakes and
// starts again as the axes' accelerations allow. The default driver, so that everything works with nothing
// plugged in.
#pragma once

#include "core/machine/clock.h"
#include "core/machine/driver.h"

#include <condition_variable>
#include <mutex>
#include <thread>

namespace millwright::machine {

struct VirtualMachineSettings {
    static constexpr double unlimited = 0.0;
    double speed =
        1.0; ///< machine seconds a second, 0.01 to 1000, or `unlimited`: as fast as it can be computed
};

class VirtualMachine final : public Driver {
public:
    /// Stands at `position`, disconnected. `clock` must outlive it. Throws Error for a speed out of range.
    VirtualMachine(kinematics::AxisPositions position, VirtualMachineSettings settings, Clock& clock);
    VirtualMachine(const VirtualMachine&) = delete;
    VirtualMachine& operator=(const VirtualMachine&) = delete;
    ~VirtualMachine() override;

    [[nodiscard]] std::string name() const override { return "virtual"; }
    [[nodiscard]] DriverStatus status() const override;
    /// May be changed while running.
    void set_speed(double speed);

    void connect() override;
    void start(Work work) override;
    void hold() override;
    void resume() override;
    void stop() override;
    void emergency_stop() override;
    void reset() override;
    void close() noexcept override;

private:
    class Axes;
};

} // namespace millwright::machine
