// A coordinate system of a PMAC: which motors are which axes, the motion program that runs in it, its time
// base. Axes in their own units, motors in counts, s.
#pragma once

#include "core/pmac/emulator/internal/path.h"
#include "core/pmac/emulator/internal/stored_program.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::pmac::card {

class Card;

/// #n->kX+o: a motor's place as a sum of axes.
struct AxisDefinition {
    std::array<double, axis_count> factors{};
    double offset = 0.0;
    std::string text; ///< as it is reported
    [[nodiscard]] bool exists() const { return !text.empty(); }
};

class CoordinateSystem {
public:
    static constexpr int motors = 8;

    CoordinateSystem(Card& card, int number) : card_(&card), number_(number) {}

    // On-line commands; codes are those of the manual, 0: accepted.
    [[nodiscard]] int define(int motor, const AxisDefinition& definition);
    void undefine();
    [[nodiscard]] int point_to(int program, double label);
    [[nodiscard]] int run(bool one_step);
    void hold();
    void quit();
    void abort();
    /// What abort() does, without closing the loops of killed motors.
    void halt();
    void set_percent(double percent) { percent_ = percent; }
    void zero_axes();
    void modal(const Statement& statement); ///< ABS, INC, FRAX
    /// Forgets programs and definitions, as after a reset to the factory's settings.
    void reset(bool definitions);

    /// A servo cycle, before the motors'.
    void advance(double cycle);
    /// The program's calculations: at most so many statements.
    void calculate(int statements);

    [[nodiscard]] const AxisDefinition& definition(int motor) const {
        return definitions_[static_cast<std::size_t>(motor)];
    }
    [[nodiscard]] bool running() const { return running_; }
    [[nodiscard]] bool held() const { return running_ && hold_ && !(rate_ > 0.0); }
    [[nodiscard]] double percent() const { return percent_; }
    [[nodiscard]] double time_base() const { return rate_; }
    [[nodiscard]] int program() const { return at_.program; }
    [[nodiscard]] int label_line() const { return std::max(at_.statement, 0); }
    [[nodiscard]] std::uint32_t status_word_1() const;
    [[nodiscard]] std::uint32_t status_word_2() const;
    [[nodiscard]] std::int64_t moves() const { return moves_; } ///< that were begun, ever
    [[nodiscard]] const Axes& target() const { return target_; }

private:
    struct Place {
        int program = 0;
        int statement = 0; ///< -1: the program has no such label
    };
    /// Of the program's statements, ahead of the motion.
    enum class Calculation { stopped, going_on, at_end };
    enum class RunError {
        none,
        run_time,
        radius ///< which is a run-time error, too
    };
    enum class CenterMode { incremental, absolute };
    enum class Mode { linear, rapid, clockwise, counter_clockwise };
    enum class Next { go_on, wait, end };

    // coordinate_system.cpp
    [[nodiscard]] int refusal() const;
    [[nodiscard]] Axes axes_now() const;
    void drive_motors(double cycle);
    void finish();
    void slew();
    [[nodiscard]] bool searches_ended();
    [[nodiscard]] bool dwelling() const { return dwell_ > 0.0; }
    [[nodiscard]] bool calculating() const { return calculation_ == Calculation::going_on; }

    // interpreter.cpp
    Next execute(const Statement& statement);
    Next jump(const Statement& statement);
    Next jump_far(const Statement& statement);
    Next wait_then(const Statement& statement);
    Next service(const Statement& statement);
    void set_modal(const Statement& statement);
    void fail(); ///< of the program; ends it
    Next go_to_label(int program, double label, bool come_back);

    // moves.cpp
    Next move(const Statement& statement);
    [[nodiscard]] bool shape_arc(const Statement& statement, Move& made);
    void time_move(Move& made) const;
    void time_rapid(Move& made) const;
    [[nodiscard]] bool is_segmented() const;
    void keep_to_limits(Move& made) const;
    [[nodiscard]] double motor_way(const Move& move, int motor) const;
    [[nodiscard]] double speed_before(int motor) const;
    [[nodiscard]] double change_time(const Move& move, int motor, double time) const;
    [[nodiscard]] double stop_time(const Move& made) const;
    void add(Move made);
    [[nodiscard]] Ramp program_ramp() const;
    [[nodiscard]] double i(int of_system) const; ///< I187 and so on, of this system

    Card* card_;
    int number_; ///< from 0
    std::array<AxisDefinition, motors> definitions_;

    Place at_{.program = 0, .statement = -1};
    std::vector<Place> calls_;
    bool running_ = false, stepping_ = false, in_block_ = false, hold_ = false, gave_up_blending_ = false;
    Calculation calculation_ = Calculation::stopped;
    RunError run_error_ = RunError::none; ///< of the current or last run
    double percent_ = 100.0, rate_ = 1.0; ///< time base wanted, %, and now, as a fraction
    double dwell_ = 0.0;
    unsigned homing_ = 0; ///< motors for whose searches the program waits, a bit each
    std::array<double, motors> halted_{};

    Mode mode_ = Mode::linear;
    std::array<bool, axis_count> incremental_{};
    CenterMode center_ = CenterMode::incremental; ///< of I J K
    std::array<bool, axis_count> feeds_{true, true, true};
    std::optional<double> feed_;                ///< axis units each time unit of Ix90; nothing: `time_`
    std::optional<double> time_;                ///< ms
    std::optional<double> ramp_time_, s_curve_; ///< ms
    Vec3 normal_{0.0, 0.0, -1.0};
    Axes target_{}, place_offset_{};
    Path path_;
    std::array<double, motors> speeds_{}; ///< of the last move, counts/s
    std::array<double, motors> sent_{};   ///< where the motors were sent last
    std::int64_t moves_ = 0;
};

} // namespace millwright::pmac::card
