#include "core/pmac/emulator/pmac_emulator.h"

#include "core/base/error.h"
#include "core/pmac/emulator/internal/port.h"

#include <algorithm>
#include <utility>

namespace millwright::pmac {

using card::Card;
using card::Channel;

class PmacEmulator::Body {
public:
    explicit Body(const PmacEmulatorOptions& options) : card(options.plants, options.channels), port(card) {}

    void each_channel(const auto& act) {
        for (int n = 0; n < card.channel_count(); ++n) {
            act(card.channel(n));
        }
    }

    Card card;
    card::Port port;
};

PmacEmulator::PmacEmulator(PmacEmulatorOptions options) {
    if (options.channels != 4 && options.channels != 8) {
        throw Error("a PMAC must have 4 or 8 channels");
    }
    body_ = std::make_unique<Body>(options);
}

PmacEmulator::~PmacEmulator() = default;

void PmacEmulator::receive(std::string_view bytes) {
    body_->port.receive(bytes);
}

void PmacEmulator::advance(double seconds) {
    constexpr double look = 1e-3; // how often what programs say and ask is served
    for (double left = seconds; left > 0.0; left -= look) {
        body_->card.advance(std::min(left, look));
        body_->port.serve_programs();
    }
}

std::string PmacEmulator::take_output() {
    return body_->port.take_output();
}

bool PmacEmulator::moving() const {
    return body_->card.moving();
}

void PmacEmulator::raise_alarm() {
    body_->each_channel([](Channel& channel) { channel.fault = true; });
}

void PmacEmulator::emergency_stop() {
    body_->each_channel([](Channel& channel) { channel.powered = false; });
}

void PmacEmulator::power_cycle() {
    body_->card.reset(false);
    body_->port.reset();
}

void PmacEmulator::clear_faults() {
    body_->each_channel([](Channel& channel) {
        channel.fault = false;
        channel.powered = true;
    });
}

void PmacEmulator::unplug_encoder(int channel, bool out) {
    body_->card.channel(channel - 1).unplugged = out;
}

double PmacEmulator::time() const {
    return body_->card.time();
}

double PmacEmulator::position(int motor) const {
    return body_->card.motor(motor - 1).actual() + body_->card.bias(motor - 1);
}

double PmacEmulator::command(int motor) const {
    return body_->card.motor(motor - 1).command() + body_->card.bias(motor - 1);
}

double PmacEmulator::speed(int channel) const {
    return body_->card.channel(channel - 1).velocity();
}

double PmacEmulator::output(int motor) const {
    return body_->card.motor(motor - 1).output();
}

bool PmacEmulator::enabled(int motor) const {
    return body_->card.motor(motor - 1).enabled();
}

bool PmacEmulator::program_runs(int system) const {
    return body_->card.system(system - 1).running();
}

std::int64_t PmacEmulator::moves(int system) const {
    return body_->card.system(system - 1).moves();
}

double PmacEmulator::last_motion() const {
    return body_->card.last_motion();
}

double PmacEmulator::variable(char kind, int index) const {
    return body_->card.value(kind, index);
}

std::uint16_t PmacEmulator::shared_16(int offset) const {
    return body_->card.memory().host_16(offset);
}

void PmacEmulator::set_shared_16(int offset, std::uint16_t value) {
    body_->card.memory().set_host_16(offset, value);
}

std::int32_t PmacEmulator::shared_32(int offset) const {
    return body_->card.memory().host_32(offset);
}

void PmacEmulator::set_shared_32(int offset, std::int32_t value) {
    body_->card.memory().set_host_32(offset, value);
}

int PmacEmulator::take_compare_pulses() {
    return body_->card.take_compare_pulses();
}

} // namespace millwright::pmac
