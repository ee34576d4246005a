// One command line after the other on its way to a PMAC, guarded in both directions: before its CR the card
// tells the sum of what it has (^N), and in its answers each line and the command have sums (I4=1). So a
// character that was lost or changed is noticed before a command acts. Needs I3=2, I4=1, I6=1.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace millwright::pmac::internal {

/// Modulo 256, as the card counts.
[[nodiscard]] char checksum(std::string_view text);

class GuardedLine {
public:
    enum class Outcome {
        none,     ///< still on its way, or nothing was sent
        answered, ///< accepted; `lines` is what it said
        refused,  ///< `error` is the card's number, 0 if it gave none
        unsent,   ///< the card was ordered to forget it: it did not come as it was sent
        lost      ///< it is unknown whether the card has done it
    };
    struct Reply {
        Outcome outcome = Outcome::none;
        std::vector<std::string> lines;
        int error = 0;
        bool heard = false; ///< anything that was no guard of the line as it was sent
    };

    /// `patience`: how long an answer may take, s.
    explicit GuardedLine(double patience) : patience_(patience) {}

    [[nodiscard]] bool idle() const { return step_ == Step::idle; }
    /// Throws Defect unless idle. `line` has no CR. `repeats`: it is sent again as long as it does not come
    /// as it is; else the one who asks has to look first whether the card is still the same.
    void send(std::string line, bool repeats, double now);
    void receive(std::string_view bytes, double now);
    /// What became of the line, once.
    [[nodiscard]] Reply poll(double now);
    [[nodiscard]] std::string take_output();
    void forget();
    /// Extends the wait by `seconds`: the card could not be asked in that time.
    void leave_out(double seconds, double now);

private:
    enum class Step { idle, summing, clearing, waiting, refusing, ended };

    void put_line(double now);
    void again(double now);
    void end(Outcome outcome);
    void read_answer();
    void read_refusal();
    void refuse();

    double patience_;
    Step step_ = Step::idle;
    bool repeats_ = true;
    std::string line_, input_, output_;
    Reply reply_;
    double begun_ = 0.0, since_ = 0.0, last_byte_ = 0.0;
};

} // namespace millwright::pmac::internal
