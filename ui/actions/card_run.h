// How far the arm's card is with a program that it was sent from here: by the lines that the driver knows to
// be executed, and between them by the plan and the time that went by.
#pragma once

#include "core/machine/driver_status.h"

#include <optional>
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
    /// `seconds` went by since it was last told.
    void follow(const machine::DriverStatus& status, double seconds);
    /// Nothing while none of these programs is under way.
    [[nodiscard]] const std::optional<CardPlace>& place() const { return place_; }

private:
    [[nodiscard]] CardPlace place_by(const machine::DriverStatus& status) const;

    std::optional<CardPlan> plan_; ///< of what is under way
    bool seen_ = false;            ///< it was told to be
    double waited_ = 0.0;          ///< s for that
    double elapsed_ = 0.0;         ///< s in motion, as far as the lines agree
    std::optional<CardPlace> place_;
};

} // namespace millwright::actions
