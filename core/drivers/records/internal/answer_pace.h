// Whether an answer can be that to the record under way. A table that answers each record when it is there
// does not answer one long before; one that answers what it has taken tells nothing by the time. Which of the
// two it is, its first records tell. Times s.
#pragma once

namespace millwright::drivers::records {

class AnswerPace {
public:
    /// Whether an answer `after` the record, whose way takes `way` at its speed, can be its own.
    [[nodiscard]] bool fits(double way, double after);

private:
    int when_there_ = 0;           ///< records that were answered no earlier than that
    bool sometimes_early_ = false; ///< then time tells nothing
};

} // namespace millwright::drivers::records
