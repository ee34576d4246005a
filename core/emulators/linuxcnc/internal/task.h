// What LinuxCNC's task does with the commands of its user interfaces: emergency stop, power, modes, programs,
// single lines, jogs. The machine is the virtual one, in a time of its own.
#pragma once

#include "core/base/clock.h"
#include "core/drivers/virtual_machine/virtual_machine.h"
#include "core/emulators/linuxcnc/linuxcnc_emulator.h"

#include <atomic>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::emulators::internal {

enum class TaskMode { manual, automatic, mdi };

class LinuxCncTask {
public:
    /// Switched on at `time`, in its emergency stop, at zero; goes on writing `truth`.
    explicit LinuxCncTask(std::shared_ptr<const kinematics::MachineModel> model,
                          double time = 0.0,
                          LinuxCncTruth truth = {});

    void advance(double seconds);
    [[nodiscard]] double time() const { return clock_.now(); }

    // Commands. What cannot be done now goes to the errors.
    void set_estop(bool on);
    void set_power(bool on);
    void set_mode(TaskMode mode);
    void open(const std::filesystem::path& file);
    void run();
    void pause();
    void resume();
    void abort();
    void mdi(const std::string& line);
    void home();
    /// `speed` is signed and mm/min, `way` positive.
    void jog(int axis, double speed, double way);
    void stop_jog();
    void set_feed_override(int percent);

    [[nodiscard]] bool estop() const { return power_ == Power::estop; }
    [[nodiscard]] bool power() const { return power_ == Power::on; }
    [[nodiscard]] TaskMode mode() const { return mode_; }
    [[nodiscard]] bool homed() const { return homed_; }
    [[nodiscard]] int feed_override() const { return feed_override_; }
    [[nodiscard]] drivers::DriverStatus machine() const { return machine_.status(); }
    [[nodiscard]] const kinematics::MachineModel& model() const { return *model_; }
    [[nodiscard]] std::string program_status() const;
    /// The line in execution, or the last one; 0 before any program. While a program begins, and after it is
    /// aborted, for a moment the last line with a move that was read, as the real one.
    [[nodiscard]] int program_line() const { return clock_.now() < shows_read_until_ ? read_line_ : line_; }
    /// The oldest that has not been taken; "OK" if there is none.
    [[nodiscard]] std::string take_error();
    [[nodiscard]] std::string take_message();
    [[nodiscard]] const LinuxCncTruth& truth() const { return truth_; }

private:
    class OwnClock final : public Clock {
    public:
        explicit OwnClock(double time) : time_(time) {}
        [[nodiscard]] double now() const override { return time_; }
        void wait(double seconds) override { time_ = time_ + seconds; }

    private:
        std::atomic<double> time_;
    };

    /// A program on its way.
    struct Program {
        std::shared_ptr<const program::Program> blocks;
        std::deque<std::pair<int, std::string>> messages; ///< (MSG,...), with their lines
        std::string error;                                ///< that ends it; empty: its own end
        int executed = 0;                                 ///< blocks, entered in the truth
    };

    [[nodiscard]] bool ready(TaskMode mode, std::string_view what);
    [[nodiscard]] Program read(const std::string& text) const;
    void cut_at_limits(Program& program, program::Program& blocks) const;
    void follow(const drivers::DriverStatus& now);
    void tell_messages(int before_line);
    void end_program();
    void show_read_line();
    void fall_off();

    std::shared_ptr<const kinematics::MachineModel> model_;
    OwnClock clock_;
    drivers::VirtualMachine machine_;
    enum class Power { estop, off, on };
    Power power_ = Power::estop;
    bool homed_ = false, homing_ = false, paused_ = false;
    TaskMode mode_ = TaskMode::manual;
    int feed_override_ = 100;
    std::optional<std::string> opened_; ///< the text of the file; nothing: none is open
    std::optional<Program> program_;
    int line_ = 0;
    int read_line_ = 0;              ///< the last one that was read ahead
    double shows_read_until_ = -1.0; ///< s
    std::deque<std::string> errors_, messages_;
    LinuxCncTruth truth_;
};

} // namespace millwright::emulators::internal
