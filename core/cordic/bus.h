// The interface unit: cycles of an MCS-51-like bus (16-bit address, 8-bit data on the same pins), with a
// program ROM, a dual-port RAM and the motion controller's port behind an address decoder. Thesis
// sections 2.4 and 2.6.
//
// The ROM may have up to 256 pages of 32 KB, of which a counter beside the address bus selects one; the
// instruction PAGE counts it up (the thesis's own test system has a port for a page of memory, appendix A).
//
// A cycle is one clock with ALE and the address, then one clock with the strobe (PSEN for the program, RD for
// data, WR for data and the motion controller) and the data, and a clock more for each wait state.
#pragma once

#include <cstdint>
#include <vector>

namespace millwright::cordic {

inline constexpr std::uint16_t ram_begin = 0x8000; ///< below: program ROM
inline constexpr std::uint32_t last_address = 0xffff;
inline constexpr int rom_size = ram_begin; ///< of one page
inline constexpr int most_pages = 256;
inline constexpr std::uint16_t port_begin = 0xc000; ///< from here: the motion controller
inline constexpr std::uint8_t command_port = 0x80;  ///< behind port_begin: opcode and parameter of a command

enum class Device : std::uint8_t { rom, ram, port };

/// The address decoder.
[[nodiscard]] constexpr Device device_at(std::uint16_t address) {
    if (address < ram_begin) {
        return Device::rom;
    }
    return address < port_begin ? Device::ram : Device::port;
}

/// Whether `size` bytes from `address` on begin in one device and end in another; those behind the last
/// address are in none.
[[nodiscard]] constexpr bool crosses_memories(std::uint16_t address, int size) {
    const std::uint32_t last = address + static_cast<std::uint32_t>(size) - 1;
    return last <= last_address && device_at(address) != device_at(static_cast<std::uint16_t>(last));
}

/// What lies behind the bus. The RAM's other port is the host's: it reads and writes `ram` between clocks.
struct Memory {
    std::vector<std::uint8_t> rom = std::vector<std::uint8_t>(ram_begin, 0xff); ///< whole pages
    std::vector<std::uint8_t> ram = std::vector<std::uint8_t>(port_begin - ram_begin, 0xff);
    std::vector<std::uint8_t> port =
        std::vector<std::uint8_t>(0x10000 - port_begin, 0xff); ///< as last written

    [[nodiscard]] int pages() const { return static_cast<int>(rom.size()) / rom_size; }
    /// `page` counts for the ROM alone.
    [[nodiscard]] std::uint8_t read(std::uint16_t address, std::uint8_t page = 0) const;
    /// Nothing writes into a ROM: false.
    bool write(std::uint16_t address, std::uint8_t data);

    friend bool operator==(const Memory&, const Memory&) = default;
};

/// The pins in one clock. ALE is active high; PSEN, RD and WR are active low on the chip and true here when
/// active.
struct BusPins {
    bool ale = false;
    bool psen = false;
    bool rd = false;
    bool wr = false;
    std::uint16_t address = 0;
    std::uint8_t data = 0; ///< on the multiplexed pins: the address's low byte with ALE, else the data

    friend bool operator==(const BusPins&, const BusPins&) = default;
};

enum class BusCycle : std::uint8_t {
    none,
    fetch, ///< of the program, with PSEN
    read,  ///< of data, with RD
    write
};

struct BusState {
    BusCycle cycle = BusCycle::none; ///< that is under way after its address clock
    int waits_left = 0;
    std::uint16_t address = 0;
    std::uint8_t page = 0; ///< of the program ROM
    std::uint8_t data = 0; ///< last byte read, or byte being written
    BusPins pins;

    friend bool operator==(const BusState&, const BusState&) = default;
};

/// Whether the cycle goes on behind this clock.
[[nodiscard]] constexpr bool is_busy(const BusState& bus) {
    return bus.cycle != BusCycle::none && bus.waits_left > 0;
}

/// CE of the interface unit: whether this clock is one of a cycle, from its address to its last strobe.
[[nodiscard]] constexpr bool in_cycle(const BusState& bus) {
    return bus.pins.ale || bus.pins.psen || bus.pins.rd || bus.pins.wr;
}

/// R/W of the interface unit: whether this clock is one of a write cycle, its address clock included.
[[nodiscard]] constexpr bool is_write(const BusState& bus) {
    return bus.cycle == BusCycle::write || bus.pins.wr;
}

/// The address clock of a cycle.
void begin_cycle(BusState& bus, BusCycle cycle, std::uint16_t address, std::uint8_t data, int wait_states);

/// Any other clock: the strobe of a cycle that is under way, else nothing. False if a write met a ROM.
bool go_on(BusState& bus, Memory& memory);

} // namespace millwright::cordic
