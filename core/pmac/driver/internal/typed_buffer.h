// A program that is typed line by line. While a buffer of the card is open, the driver cannot stop the motors
// and the guard is off, so the lines wait here from OPEN on, and CLOSE sends all of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace millwright::pmac::internal {

/// Its lines are parts of `split_at_buffer_words`.
class TypedBuffer {
public:
    /// How many of `lines` are to be sent now; the others wait for CLOSE. Lines that only ask, stop or kill
    /// never wait.
    [[nodiscard]] std::size_t count_to_send(const std::vector<std::string>& lines) const;
    /// What is to be sent in place of `lines`, all of which are to be sent now.
    [[nodiscard]] std::vector<std::string> completed(const std::vector<std::string>& lines) const;
    /// After that: forgets what was kept, unless `lines` only ask, stop or kill.
    void sent(const std::vector<std::string>& lines);
    /// Adds lines that wait.
    void keep(const std::vector<std::string>& lines);
    void clear() { kept_.clear(); }

    [[nodiscard]] const std::vector<std::string>& kept() const { return kept_; }

private:
    std::vector<std::string> kept_; ///< from OPEN on
};

} // namespace millwright::pmac::internal
