#include "core/machine/emulators/grbl/grbl_emulator.h"

#include "core/base/error.h"
#include "core/machine/emulators/grbl/internal/controller.h"

#include <utility>

namespace millwright::machine {

class GrblEmulator::Body final : public emulated::Controller {
public:
    using Controller::Controller;
};

GrblEmulator::GrblEmulator(GrblEmulatorOptions options) : body_(std::make_unique<Body>(std::move(options))) {}

GrblEmulator::~GrblEmulator() = default;

void GrblEmulator::receive(std::string_view bytes) {
    for (const char byte : bytes) {
        body_->receive(static_cast<unsigned char>(byte));
    }
    body_->advance(0.0);
}

void GrblEmulator::advance(double seconds) {
    expects(seconds >= 0.0, "time does not run backwards");
    body_->advance(seconds);
}

std::string GrblEmulator::take_output() {
    return body_->take_output();
}

double GrblEmulator::time() const {
    return body_->time();
}

std::array<double, 3> GrblEmulator::position() const {
    return body_->position();
}

bool GrblEmulator::moving() const {
    return body_->moving();
}

int GrblEmulator::planned_blocks() const {
    return body_->planned_blocks();
}

Truth GrblEmulator::truth() const {
    return body_->truth();
}

void GrblEmulator::hit_limit_switch() {
    body_->hit_limit_switch();
}

void GrblEmulator::raise_alarm() {
    body_->raise_alarm();
}

void GrblEmulator::emergency_stop() {
    constexpr std::string_view soft_reset = "\x18";
    receive(soft_reset);
}

void GrblEmulator::set_door(bool open) {
    body_->set_door(open);
}

void GrblEmulator::break_limit_switches() {
    body_->break_limit_switches();
}

void GrblEmulator::power_cycle() {
    body_->power_on();
}

} // namespace millwright::machine
