// Arithmetic that may divide by zero, or make an infinity or a NaN, on its way to a value that is then looked
// at.
#pragma once

#include <cfenv>

namespace millwright {

/// No traps and no flags of floating point as long as it lives, on this thread.
class QuietFloats {
public:
    QuietFloats() { std::feholdexcept(&before_); }
    ~QuietFloats() { std::fesetenv(&before_); }
    QuietFloats(const QuietFloats&) = delete;
    QuietFloats& operator=(const QuietFloats&) = delete;

private:
    std::fenv_t before_{};
};

} // namespace millwright
