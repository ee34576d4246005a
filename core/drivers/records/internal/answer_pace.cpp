#include "core/drivers/records/internal/answer_pace.h"

namespace millwright::drivers::records {

bool AnswerPace::fits(double way, double after) {
    constexpr double shortest_way = 0.2; // of which a wire and a busy computer do not take much
    constexpr double early = 0.25;       // of the way: a table may have an override of its own
    constexpr int enough = 3;
    if (sometimes_early_ || way < shortest_way) {
        return true;
    }
    if (after >= early * way) {
        ++when_there_;
        return true;
    }
    sometimes_early_ = when_there_ < enough;
    return sometimes_early_;
}

} // namespace millwright::drivers::records
