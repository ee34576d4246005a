// A program that is typed line by line. While a buffer of the card is open nobody is heard and the guard is
// off, so the lines wait here from OPEN on, and CLOSE sends all of them.
#pragma once

#include <string>
#include <vector>

namespace millwright::pmac::internal {

class TypedBuffer {
public:
    /// Keeps `lines` where they begin with OPEN and leave the buffer open, or one is open already and they do
    /// not close it. Lines that only ask, stop or kill are never kept. Another OPEN begins anew.
    [[nodiscard]] bool keeps(const std::vector<std::string>& lines);
    /// What is to be sent now in place of `lines`, which were not kept.
    [[nodiscard]] std::vector<std::string> completed(const std::vector<std::string>& lines) const;
    /// After that: forgets what was kept, unless `lines` only ask, stop or kill.
    void sent(const std::vector<std::string>& lines);
    void clear() { kept_.clear(); }

    [[nodiscard]] const std::vector<std::string>& kept() const { return kept_; }

private:
    std::vector<std::string> kept_; ///< from OPEN on
};

} // namespace millwright::pmac::internal
