// A controller with its machine, in this program: takes the bytes of a link and answers as the real one does.
// Without threads and clocks: time is what advance() adds. Used by one thread at a time.
#pragma once

#include <string>
#include <string_view>

namespace millwright::emulators {

class Emulator {
public:
    virtual ~Emulator() = default;

    virtual void receive(std::string_view bytes) = 0;
    /// It has no room for more: whoever sends has to wait.
    [[nodiscard]] virtual bool full() const { return false; }
    /// Lets `seconds` >= 0 pass.
    virtual void advance(double seconds) = 0;
    /// Takes what it has sent.
    [[nodiscard]] virtual std::string take_output() = 0;
    [[nodiscard]] virtual bool moving() const = 0;

    /// What happens to machines: somebody or something stops it at once.
    virtual void raise_alarm() = 0;
    /// Its emergency stop was pressed: an alarm, where the controller knows nothing else.
    virtual void emergency_stop() { raise_alarm(); }
    /// It was switched off and on again, and knows nothing of what came before.
    virtual void power_cycle() = 0;
};

} // namespace millwright::emulators
