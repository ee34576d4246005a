#include "core/cordic/bus.h"

namespace millwright::cordic {

std::uint8_t Memory::read(std::uint16_t address, std::uint8_t page) const {
    switch (device_at(address)) {
    case Device::rom:
        return rom[static_cast<std::size_t>(page) * rom_size + address];
    case Device::ram:
        return ram[static_cast<std::size_t>(address - ram_begin)];
    case Device::port:
        break;
    }
    return port[static_cast<std::size_t>(address - port_begin)];
}

bool Memory::write(std::uint16_t address, std::uint8_t data) {
    switch (device_at(address)) {
    case Device::rom:
        return false;
    case Device::ram:
        ram[static_cast<std::size_t>(address - ram_begin)] = data;
        return true;
    case Device::port:
        break;
    }
    port[static_cast<std::size_t>(address - port_begin)] = data;
    return true;
}

void begin_cycle(BusState& bus, BusCycle cycle, std::uint16_t address, std::uint8_t data, int wait_states) {
    bus.cycle = cycle;
    bus.waits_left = wait_states;
    bus.address = address;
    bus.data = data;
    bus.pins = {.ale = true, .address = address, .data = static_cast<std::uint8_t>(address)};
}

bool go_on(BusState& bus, Memory& memory) {
    if (bus.cycle == BusCycle::none) {
        bus.pins = {.address = bus.pins.address, .data = bus.pins.data};
        return true;
    }
    const bool writes = bus.cycle == BusCycle::write;
    const bool last = bus.waits_left == 0;
    bool done = true;
    if (last && writes) {
        done = memory.write(bus.address, bus.data);
    } else if (last) {
        bus.data = memory.read(bus.address, bus.page);
    }
    bus.pins = {.psen = bus.cycle == BusCycle::fetch,
                .rd = bus.cycle == BusCycle::read,
                .wr = writes,
                .address = bus.address,
                .data = bus.data};
    if (last) {
        bus.cycle = BusCycle::none;
    } else {
        --bus.waits_left;
    }
    return done;
}

} // namespace millwright::cordic
