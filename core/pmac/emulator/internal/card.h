// A PMAC card: variables, memory, motors, coordinate systems, buffers, PLC programs, and its time. What it
// says goes to one port. Counts and s.
#pragma once

#include "core/pmac/emulator/internal/coordinate_system.h"
#include "core/pmac/emulator/internal/memory.h"
#include "core/pmac/emulator/internal/motor.h"
#include "core/pmac/emulator/internal/variables.h"

#include <array>
#include <deque>
#include <map>
#include <string>
#include <vector>

namespace millwright::pmac::card {

constexpr int encoder_table_address = 0x720;

class Card final : public Variables, public Registers {
public:
    static constexpr int motors = 8, systems = 8, plcs = 32;

    /// `channels`: how many are wired, 4 or 8. The others are there for simulated motors alone.
    Card(const std::vector<PmacPlant>& plants, int channels);
    Card(const Card&) = delete;
    Card& operator=(const Card&) = delete;
    ~Card() override = default;

    void advance(double seconds);
    [[nodiscard]] double time() const { return time_; }
    /// $$$: what was saved is in force; with `factory` the card's own settings.
    void reset(bool factory);
    void save() { saved_ = i_.values(); }

    // Variables
    [[nodiscard]] double value(char kind, int index) const override;
    void set(char kind, int index, double value) override;
    [[nodiscard]] IVariables& i_variables() { return i_; }
    [[nodiscard]] double i(int index) const { return i_.value(index); }
    [[nodiscard]] MemoryMap& memory() { return memory_; }

    // Registers that are no memory
    [[nodiscard]] std::optional<std::uint32_t> read(char side, int address) const override;
    bool write(char side, int address, std::uint32_t value) override;

    [[nodiscard]] Motor& motor(int index) { return motors_[static_cast<std::size_t>(index)]; }
    [[nodiscard]] const Motor& motor(int index) const { return motors_[static_cast<std::size_t>(index)]; }
    [[nodiscard]] const MotorSettings& settings(int index) const {
        return settings_[static_cast<std::size_t>(index)];
    }
    [[nodiscard]] Channel& channel(int index) { return channels_[static_cast<std::size_t>(index)]; }
    [[nodiscard]] int channel_count() const { return channel_count_; } ///< wired ones
    [[nodiscard]] CoordinateSystem& system(int index) { return systems_[static_cast<std::size_t>(index)]; }
    [[nodiscard]] const CoordinateSystem& system(int index) const {
        return systems_[static_cast<std::size_t>(index)];
    }
    /// The coordinate system of a motor, from 0; -1: none.
    [[nodiscard]] int system_of(int motor) const;
    /// Counts that are added to a motor's reported place.
    [[nodiscard]] double bias(int motor) const;

    // Buffers
    /// Null if there is none.
    [[nodiscard]] StoredProgram* program(int number);
    /// Lines of a rotary buffer run as they come.
    [[nodiscard]] static int rotary(int system) { return -1 - system; }
    bool rotary_open = false;
    [[nodiscard]] StoredProgram& make_program(int number);
    [[nodiscard]] StoredProgram& plc(int number) { return plc_[static_cast<std::size_t>(number)].program; }
    void enable_plc(int number, bool on);
    [[nodiscard]] bool plc_enabled(int number) const { return plc_[static_cast<std::size_t>(number)].on; }

    // What programs say and ask; the port takes it.
    void send(const std::string& text) { said_.push_back(text); }
    void command(const std::string& text) { asked_.push_back(text); }
    std::deque<std::string>& said() { return said_; }
    std::deque<std::string>& asked() { return asked_; }

    void kill_all();
    void abort_all();
    [[nodiscard]] double cycle() const;
    [[nodiscard]] bool moving() const;
    [[nodiscard]] double last_motion() const { return last_motion_; }
    /// Rises of the compare output of channel 1 since they were last asked for (EQU1).
    [[nodiscard]] int take_compare_pulses() { return std::exchange(compare_pulses_, 0); }
    [[nodiscard]] std::uint32_t status_word_1(int motor) const;
    [[nodiscard]] std::uint32_t status_word_2(int motor) const;

private:
    [[nodiscard]] std::optional<std::uint32_t> output_word(int address) const;
    [[nodiscard]] int wire_of(int motor) const;
    [[nodiscard]] bool is_there(int channel) const;
    struct Plc {
        StoredProgram program{true};
        bool on = false;
        int at = 0;
    };

    void servo_cycle(double cycle);
    void real_time_interrupt();
    void scan(Plc& plc);
    void handle(int motor, Motor::Event event);
    void load_settings();
    [[nodiscard]] bool compare_output() const;

    IVariables i_;
    std::vector<double> saved_;
    std::vector<double> p_, q_;
    MemoryMap memory_;
    std::array<Motor, motors> motors_;
    std::array<MotorSettings, motors> settings_;
    std::array<int, motors> wires_{}; ///< the channel of each motor, -1: none
    int channel_count_;
    std::vector<Channel> channels_;                     ///< wired ones first
    std::array<std::uint32_t, motors> encoder_table_{}; ///< what each entry is made of
    Channel nowhere_;                                   ///< what motors without a channel drive
    std::array<std::uint32_t, motors> flag_words_{};    ///< what was written to the channels' registers
    std::vector<CoordinateSystem> systems_;
    std::map<int, StoredProgram> programs_;
    std::array<Plc, plcs> plc_;
    std::deque<std::string> said_, asked_;
    double time_ = 0.0, pending_ = 0.0;
    std::int64_t cycles_ = 0;
    double last_motion_ = -1.0;
    int compare_pulses_ = 0;
};

} // namespace millwright::pmac::card
