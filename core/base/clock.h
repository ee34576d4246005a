// Time as an argument, so that tests need no real one.
#pragma once

namespace millwright {

class Clock {
public:
    virtual ~Clock() = default;
    /// Seconds from a fixed moment, never falling. From any thread.
    [[nodiscard]] virtual double now() const = 0;
    /// Lets `seconds` pass for the calling thread.
    virtual void wait(double seconds) = 0;
};

/// The computer's steady clock.
class SteadyClock final : public Clock {
public:
    [[nodiscard]] double now() const override;
    void wait(double seconds) override;
};

} // namespace millwright
