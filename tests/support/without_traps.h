// Numbers that are none, on purpose: floating-point traps of the checked build are off for a test that hands
// them in.
#pragma once

#include <cfenv>

namespace millwright::test {

class WithoutTraps {
public:
    WithoutTraps() { std::feholdexcept(&before_); }
    WithoutTraps(const WithoutTraps&) = delete;
    WithoutTraps& operator=(const WithoutTraps&) = delete;
    ~WithoutTraps() { std::fesetenv(&before_); }

private:
    std::fenv_t before_{};
};

} // namespace millwright::test
