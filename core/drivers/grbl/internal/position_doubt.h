// Whether the position that a controller reports can still be that of its machine. Grbl counts the steps it
// sends: cut off in motion or switched off, it goes on counting from wherever it is, and says nothing.
#pragma once

#include <string>
#include <string_view>

namespace millwright::drivers::grbl {

class PositionDoubt {
public:
    /// `why`: a part of a sentence, as "the controller was reset". The last reason is the one that is shown.
    /// `lost`: something has happened that costs the position; false: it has not been confirmed so far.
    void arise(std::string why, bool lost = true);
    /// A person has given these axes a zero where the tool stands. All of `machine_axes` end the doubt.
    void zeroed(std::string_view axes, std::string_view machine_axes);
    /// A person says that the machine is where the controller says.
    void confirm();
    /// The machine was homed.
    void homed() {
        *this = {};
        homed_ = true;
    }
    /// Whether it was homed since this link began or its position was in doubt: homing it again gives it the
    /// same zero.
    [[nodiscard]] bool was_homed() const { return homed_; }

    /// Empty: the position is not in doubt.
    [[nodiscard]] const std::string& why() const { return why_; }
    [[nodiscard]] bool lost() const { return lost_; }
    /// Why it was in doubt before a person confirmed it; empty: no confirmation was needed.
    [[nodiscard]] const std::string& confirmed() const { return confirmed_; }

private:
    std::string why_, zeroed_, confirmed_;
    bool lost_ = false;
    bool homed_ = false;

    void end();
};

/// Letters of the axes that get their zero by this line, which is without blanks and in capitals: those of
/// `machine_axes` in a G92 or G10 L20.
[[nodiscard]] std::string axes_zeroed_by(std::string_view line, std::string_view machine_axes);

} // namespace millwright::drivers::grbl
