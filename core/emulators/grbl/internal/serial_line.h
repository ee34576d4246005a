// The serial line into an emulated Grbl: when a byte has arrived, and which bytes are lost while the
// processor has its interrupts off. s.
#pragma once

#include <vector>

namespace millwright::emulators::internal {

class SerialLine {
public:
    /// When a byte that is sent at `now` has arrived: bytes follow each other at 115,200 baud.
    [[nodiscard]] double arrival(double now);
    /// Interrupts are off from `begin`, for each of `pauses` in turn, and on for a moment between two pauses.
    void interrupts_off(double begin, const std::vector<double>& pauses);
    /// False: the byte that arrives then is lost, because the UART holds two bytes that have not been
    /// fetched. To be asked once per byte, in the order of arrival.
    [[nodiscard]] bool takes(double arrival);

private:
    struct Pause {
        double end = 0.0;
        int held = 0; ///< bytes in the UART
    };

    double last_arrival_ = 0.0;
    double begin_ = 0.0; ///< of the pauses
    std::vector<Pause> pauses_;
};

} // namespace millwright::emulators::internal
