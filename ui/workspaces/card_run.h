// How far the arm's card is with a program that it was sent from here: by the lines that the driver knows to
// be executed, and within them by where its motors are on the planned way; where that tells nothing, by the
// time that went by.
#pragma once

#include "core/drivers/driver_status.h"

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::actions {

/// What is known of a program before it runs.
struct CardPlan {
    int lines = 0;
    double duration = 0.0;    ///< s; 0: not known
    std::vector<double> ends; ///< of each line when it has ended, s; empty: not known
};

/// Where a program is.
struct CardPlace {
    int line = 0, lines = 0; ///< from 1
    bool sending = false;    ///< the lines go to the card, and nothing moves yet
    double time = 0.0;       ///< s of the plan
    double duration = 0.0;   ///< s; 0: not known, and neither is time
    double share = 0.0;      ///< of the time, or else of the lines; at most 1
};

class CardRun {
public:
    void begin(CardPlan plan);
    /// Of the program that was begun: where the driver's axes are at a time of the plan, as
    /// DriverStatus::position.
    void know_way(std::function<kinematics::AxisPositions(double)> at) { at_ = std::move(at); }
    /// `seconds` went by since the last report.
    void follow(const drivers::DriverStatus& status, double seconds);
    /// Nothing while none of these programs is under way.
    [[nodiscard]] const std::optional<CardPlace>& place() const { return place_; }
    /// Where the last one was when it was stopped, or when the link was lost; nothing after a good end.
    [[nodiscard]] const std::optional<CardPlace>& broken_off() const { return broken_off_; }

private:
    void go_on(const drivers::DriverStatus& status, double seconds);
    [[nodiscard]] double time_by_place(const drivers::DriverStatus& status, double to, double guess) const;
    [[nodiscard]] CardPlace place_by(const drivers::DriverStatus& status) const;

    std::optional<CardPlan> plan_;                        ///< of what is under way
    std::function<kinematics::AxisPositions(double)> at_; ///< empty: not known
    bool seen_ = false;                                   ///< it was reported as under way
    double waited_ = 0.0;                                 ///< s for that
    double elapsed_ = 0.0;                                ///< s of the plan
    std::optional<CardPlace> place_, broken_off_;
};

} // namespace millwright::actions
