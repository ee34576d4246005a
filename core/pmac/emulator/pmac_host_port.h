// The eleven registers of an emulated PMAC on the ISA bus, and its interrupt to the computer: after Delta
// Tau, PMAC User Manual, and Saengsasri, Nittayachin 1996 (KMITL). docs/reference/pmac.md.
#pragma once

#include "core/links/host_port_link.h"
#include "core/pmac/emulator/pmac_emulator.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace millwright::pmac {

class PmacHostPort final : public links::PortRegisters {
public:
    /// Alone carries the characters of `card`, which must outlive it.
    explicit PmacHostPort(PmacEmulator& card);
    PmacHostPort(const PmacHostPort&) = delete;
    PmacHostPort& operator=(const PmacHostPort&) = delete;
    ~PmacHostPort() override;

    [[nodiscard]] std::string name() const override { return "isa:0x210"; }
    void open() override {}
    void close() noexcept override {}
    /// 0 interrupt control, 1 command vector, 2 status, 3 interrupt vector, 5 to 7 data, 8 and 9 the
    /// interrupt controller, 10 its acknowledge; the others read as all ones.
    [[nodiscard]] std::uint8_t read(int offset) override;
    /// A character written to 7 while the card is not ready for it takes the place of the one before.
    void write(int offset, std::uint8_t value) override;

    /// Lets time pass for the card, which takes at most one waiting character meanwhile.
    void advance(double seconds);
    /// It asks the computer for an interrupt.
    [[nodiscard]] bool interrupts() const;

private:
    class Body;
    std::unique_ptr<Body> body_;
};

} // namespace millwright::pmac
