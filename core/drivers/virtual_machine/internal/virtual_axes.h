// The virtual machine without threads and clocks: its axes, moved on by whoever owns it.
#pragma once

#include "core/drivers/driver.h"
#include "core/drivers/virtual_machine/internal/manual_control.h"
#include "core/motion/override.h"

#include <deque>
#include <optional>

namespace millwright::drivers::internal {

class VirtualAxes {
public:
    /// At rest at `position`, disconnected. Without a model it executes programs alone, no jog, homing or
    /// single lines. Throws Defect if the position is not one of the model.
    explicit VirtualAxes(kinematics::AxisPositions position,
                         std::shared_ptr<const kinematics::MachineModel> model = nullptr);

    [[nodiscard]] DriverStatus status() const;
    [[nodiscard]] const kinematics::MachineModel* model() const { return model_.get(); }
    [[nodiscard]] std::vector<StoredOffset> stored_offsets() const;
    /// Whether advance() changes anything.
    [[nodiscard]] bool moving() const;
    [[nodiscard]] bool jogging() const { return activity_ == Activity::jog && moving(); }

    /// Lets `seconds` >= 0 of machine time pass.
    void advance(double seconds);

    /// As in Driver.
    void connect();
    void start(Work work);
    void hold();
    void resume();
    void stop();
    void emergency_stop(std::string why);
    void reset();
    void stands_at(const kinematics::AxisPositions& position);
    /// Without the dead man: whoever knows the time, calls stop_jog().
    void jog(const Jog& jog);
    void stop_jog();
    void set_overrides(const Overrides& wanted);
    void set_single_block(bool on);
    void set_optional_stop(bool on);
    void home();
    int command(const std::string& lines);
    /// Brakes to rest within this call, whatever time that would take, and disconnects.
    void close();

private:
    enum class Pace {
        moving,
        at_rest,
        between_blocks, ///< at rest at the end of `now_`, and more of the program follows
        at_pause        ///< at rest in `pause_`
    };
    /// Jogs that follow the present one.
    struct Leg {
        kinematics::AxisPositions way;
        double speed = 0.0;
    };

    void require_model(std::string_view what) const;
    void require_rest(std::string_view what) const;
    void come_to_rest();
    void follow(motion::Trajectory next, DriverState state);
    void go_on();
    void execute(Work work, Activity activity);
    void execute(program::Program program, Activity activity);
    [[nodiscard]] motion::Override rates() const;
    [[nodiscard]] bool begin_leg(const Leg& leg);
    [[nodiscard]] bool extend_jog(const Jog& jog);
    void take_accessories(int executed_blocks);
    void look_for_pause(int block);
    [[nodiscard]] double time_of_pause() const;
    void wait_for_person();
    void show_program(DriverStatus& status, const motion::Sample& sample) const;

    std::shared_ptr<const kinematics::MachineModel> model_;
    std::optional<HandControl> control_;
    DriverState state_ = DriverState::disconnected;
    Activity activity_ = Activity::none;
    Work work_;
    std::shared_ptr<const motion::Trajectory> now_; ///< the plan, or what became of it; null: none
    double time_ = 0.0;                             ///< into `now_`
    double look_at_ = 0.0; ///< the time at which `now_` is planned on; after its end: it is whole
    Pace pace_ = Pace::at_rest;
    kinematics::AxisPositions rest_position_; ///< where the axes stand if at rest
    std::string message_;
    Overrides overrides_;
    bool single_block_ = false;
    bool optional_stop_ = false;
    int pause_ = 0;         ///< the program's next block that waits for a person; behind all: none
    double pause_at_ = 0.0; ///< the time at which `now_` comes to its end; after its own: it does not
    std::deque<Leg> legs_;
    std::optional<Leg> leg_; ///< the present jog, from the start of `work_`
    bool jog_ends_ = false;  ///< it brakes
    CommandAnswer answer_;
    int switched_blocks_ = 0;  ///< of the work, whose spindle and coolant commands are in force
    double spindle_rpm_ = 0.0; ///< clockwise if positive
    bool coolant_ = false;
};

} // namespace millwright::drivers::internal
