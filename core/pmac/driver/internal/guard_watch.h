// Whether the guard in the card runs: it counts, and each report tells how far.
#pragma once

namespace millwright::pmac::internal {

class GuardWatch {
public:
    /// `count`: P1003 of a report, which grows with each scan of the guard while the servo counter runs, and
    /// is negative while the guard is disarmed. `armed`: as it was set before that report.
    void see(double count, bool armed) {
        const bool runs = count > count_ || count < count_;
        idle_reports_ = runs && (!armed || count > 0.0) ? 0 : idle_reports_ + 1;
        count_ = count;
    }
    void forget() { idle_reports_ = 0; }
    [[nodiscard]] bool is_disarmed() const { return count_ < 0.0; }
    /// One report may be older than what was sent last, and two may follow each other at once.
    [[nodiscard]] bool runs() const { return idle_reports_ < patience; }

private:
    static constexpr int patience = 3; ///< reports: 60 ms

    double count_ = 0.0;
    int idle_reports_ = 0;
};

inline constexpr const char* guard_is_off = "the motors would not be stopped if the connection is lost: the "
                                            "guard in the card is not running (PLC 31, which needs I5 = 2)";

} // namespace millwright::pmac::internal
