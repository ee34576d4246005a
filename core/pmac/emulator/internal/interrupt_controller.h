// The 8259 interrupt controller on a PMAC, as far as the host programs it: after Intel's data sheet. Edge
// triggered, one controller, fixed priorities. With the automatic end of interrupt what was in service can be
// read until the next acknowledge, since the routine of Saengsasri, Nittayachin 1996 (KMITL) reads it there.
#pragma once

#include <cstdint>
#include <optional>

namespace millwright::pmac::card {

class InterruptController {
public:
    /// Command words at its two addresses.
    void write(int address, std::uint8_t value);
    /// Address 0: the requests, or those in service, as chosen; address 1: the mask.
    [[nodiscard]] std::uint8_t read(int address) const;
    /// A rising edge on an input from 0.
    void request(int input);
    /// What it asks its processor for: an input that is not masked, the lowest first.
    [[nodiscard]] std::optional<int> pending() const;
    /// The acknowledge pulses: the vector of what is in service from now on; nothing if nothing is pending.
    std::optional<std::uint8_t> acknowledge();

private:
    enum class Expects { nothing, vector, cascade, mode };

    void begin(std::uint8_t value);

    Expects expects_ = Expects::nothing;
    bool ready_ = false, single_ = true, needs_mode_ = false, ends_by_itself_ = false, shows_service_ = false;
    std::uint8_t requests_ = 0, service_ = 0, mask_ = 0xFF, vector_ = 0;
};

} // namespace millwright::pmac::card
