// A speed by positions a tenth of a second or more apart: by the last two, which are twenty milliseconds
// apart, it would swing with the moment at which a busy computer comes to read an answer.
#pragma once

#include <optional>

namespace millwright::pmac::internal {

class SteadySpeed {
public:
    static constexpr double window = 0.1; ///< s, at least, as soon as there was that much

    void see(double counts, double now) {
        const Mark here{counts, now};
        if (!next_) {
            from_ = next_ = here;
        } else if (now - next_->at >= window) {
            from_ = next_;
            next_ = here;
        }
        const double time = now - from_->at;
        speed_ = time > 0.0 ? (counts - from_->counts) / time : 0.0;
    }
    /// It stands, and what it did before is no longer of interest.
    void stand(double counts, double now) {
        from_ = next_ = Mark{counts, now};
        speed_ = 0.0;
    }
    [[nodiscard]] double counts_per_s() const { return speed_; }

private:
    struct Mark {
        double counts, at;
    };
    std::optional<Mark> from_, next_;
    double speed_ = 0.0;
};

} // namespace millwright::pmac::internal
