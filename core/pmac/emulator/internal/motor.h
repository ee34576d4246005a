// One motor of a PMAC and what hangs on it: its own trajectory, servo loop, protections, home search. Counts
// and s inside; what I-variables say comes in as MotorSettings.
#pragma once

#include "core/pmac/emulator/internal/ramp.h"
#include "core/pmac/emulator/pmac_plant.h"

#include <cstdint>
#include <optional>

namespace millwright::pmac::card {

/// A motor's I-variables, in counts and s.
struct MotorSettings {
    bool active = false;                    ///< Ix00
    double fatal_error = 0.0;               ///< Ix11, counts; 0: off
    double warning_error = 0.0;             ///< Ix12
    double soft_high = 0.0, soft_low = 0.0; ///< Ix13, Ix14; 0: off
    double abort_rate = 1.0;                ///< Ix15, counts/s^2
    JogRules jog;                           ///< Ix19 to Ix22
    double home_speed = 0.0;                ///< Ix23, signed
    std::int64_t flags = 0;                 ///< Ix25
    double home_offset = 0.0;               ///< Ix26
    double in_position = 10.0;              ///< Ix28
    double output_bias = 0.0;               ///< Ix29, bits
    double gain = 0.0, damping = 0.0, velocity_ahead = 0.0, integral = 0.0,
           acceleration_ahead = 0.0;                     ///< Ix30-33, 35
    bool integrate_at_rest = false;                      ///< Ix34
    double position_scale = 96.0, velocity_scale = 96.0; ///< Ix08, Ix09
    double most_error = 0.0;                             ///< Ix67, counts
    double most_output = 0.0;                            ///< Ix69, bits
    int in_position_scans = 1;                           ///< I7 + 1
    int decode = 7;                                      ///< of its encoder
    int capture = 0;                                     ///< control, I902
    int capture_flag = 0;                                ///< select, I903
    bool wired = true; ///< output, encoder and flags lead to a channel that exists
};

/// A channel of the card with what hangs on it.
class Channel {
public:
    explicit Channel(const PmacPlant& plant = {}) : plant_(plant) {}

    void advance(double output, bool enabled, int decode, double seconds);
    [[nodiscard]] double encoder() const { return encoder_; }
    [[nodiscard]] double velocity() const { return velocity_; } ///< counts/s, of the motor itself
    [[nodiscard]] bool home_flag() const { return position_ < plant_.home_edge; }
    [[nodiscard]] bool minus_limit_open() const {
        return position_ >= plant_.high_switch;
    } ///< stops positive motion
    [[nodiscard]] bool plus_limit_open() const { return position_ <= plant_.low_switch; }
    [[nodiscard]] const PmacPlant& plant() const { return plant_; }
    PmacPlant& plant() { return plant_; }
    bool fault = false;     ///< the amplifier is in fault and drives nothing
    bool powered = true;    ///< somebody took its power away otherwise
    bool unplugged = false; ///< the encoder
    /// Encoder counts where the flag changed in the last step; nothing if it did not.
    [[nodiscard]] std::optional<double> home_edge() const { return edge_; }

private:
    PmacPlant plant_;
    double position_ = 0.0, velocity_ = 0.0, encoder_ = 0.0;
    std::optional<double> edge_;
};

enum class MotorTask { none, jog, home_search, home_return, until_trigger, abort, limit_stop };

class Motor {
public:
    /// Stops whatever it does and starts afresh, as after a reset: nothing is known of the position.
    void reset(double encoder, bool closed);

    // What commands do. Each closes the loop of a killed motor.
    void jog(double speed, const MotorSettings& settings);
    void jog_stop(const MotorSettings& settings);
    void jog_to(double position, const MotorSettings& settings);
    void jog_to_trigger(double position, double past, const MotorSettings& settings);
    void home(const MotorSettings& settings);
    void home_here();
    void abort(const MotorSettings& settings);
    void kill();
    void open_loop(double percent, const MotorSettings& settings);
    void close_loop();
    /// A program has it: where it is sent at this moment.
    void follow(double position, double velocity);
    void release(); ///< the program leaves it where it is

    /// One servo cycle. Returns the output in bits.
    double servo(const MotorSettings& settings, Channel& channel, double cycle, double time_base);
    /// Whether, in the last cycle, something happened that the coordinate system must know.
    enum class Event { none, fatal_error, amplifier_fault, limit };
    [[nodiscard]] Event take_event();

    [[nodiscard]] bool closed() const { return closed_; }
    [[nodiscard]] bool enabled() const { return closed_ || open_output_.has_value(); }
    [[nodiscard]] MotorTask task() const { return task_; }
    [[nodiscard]] bool busy() const { return task_ != MotorTask::none; }
    [[nodiscard]] double command() const { return command_; } ///< counts from its zero
    [[nodiscard]] double actual() const { return actual_; }
    [[nodiscard]] double velocity() const { return velocity_; }                 ///< actual, counts a cycle
    [[nodiscard]] double command_velocity() const { return command_velocity_; } ///< counts/s
    [[nodiscard]] double following_error() const { return closed_ ? command_ - actual_ : 0.0; }
    [[nodiscard]] double output() const { return output_; }
    [[nodiscard]] bool at_both_limits() const { return limits_.at_high && limits_.at_low; }
    [[nodiscard]] bool home_complete() const { return home_complete_; }
    [[nodiscard]] bool in_position() const { return in_position_; }
    [[nodiscard]] bool warning() const { return faults_.warning; }
    [[nodiscard]] bool fatal() const { return faults_.fatal; }
    [[nodiscard]] bool amplifier_fault() const { return faults_.amplifier; }
    double before_jog = 0.0; ///< where J= goes
    [[nodiscard]] std::uint32_t status_word_1(const MotorSettings& settings) const;
    /// Without what concerns the coordinate system.
    [[nodiscard]] std::uint32_t status_word_2() const;

private:
    void begin(MotorTask task, std::vector<Profile::Part> parts);
    void watch_limits(const MotorSettings& settings, const Channel& channel);
    void watch_trigger(const MotorSettings& settings, const Channel& channel);
    void advance_task(double seconds);
    double filter(const MotorSettings& settings, double cycle);
    void watch_errors(const MotorSettings& settings, const Channel& channel);
    void watch_position(const MotorSettings& settings);
    void shift(double way);

    struct LimitState {
        bool at_high = false, at_low = false;
        bool stopped = false; ///< by one of them
    };
    struct Faults {
        bool warning = false, fatal = false; ///< by the following error
        bool amplifier = false;
    };
    /// Of a search: its trigger stops the motion.
    struct Trigger {
        double past = 0.0;    ///< counts from it to the end
        bool missing = false; ///< the last search has not found it
    };

    Profile profile_;
    MotorTask task_ = MotorTask::none;
    bool closed_ = false;
    std::optional<double> open_output_;
    double origin_ = 0.0; ///< of positions, encoder counts
    double command_ = 0.0, command_velocity_ = 0.0, last_command_velocity_ = 0.0;
    double actual_ = 0.0, velocity_ = 0.0;
    double integral_ = 0.0, output_ = 0.0;
    bool saturated_ = false;
    bool home_complete_ = false;
    bool followed_ = false; ///< a program has it
    bool in_position_ = false;
    LimitState limits_;
    Faults faults_;
    Trigger trigger_;
    int quiet_scans_ = 0;
    Event event_ = Event::none;
};

} // namespace millwright::pmac::card
