#include "core/emulators/grbl/grbl_emulator.h"

#include "core/base/error.h"
#include "core/emulators/grbl/internal/emulated_controller.h"

#include <algorithm>
#include <utility>

namespace millwright::emulators {

class GrblEmulator::Body final : public internal::EmulatedController {
public:
    using EmulatedController::EmulatedController;
};

namespace {

GrblEmulatorOptions checked(GrblEmulatorOptions options) {
    constexpr std::size_t most_axes = 6;
    const std::string& axes = options.axes;
    std::string sorted = axes;
    std::ranges::sort(sorted);
    const bool known = axes.starts_with("XYZ") && axes.size() <= most_axes &&
                       std::ranges::adjacent_find(sorted) == sorted.end() &&
                       axes.find_first_not_of("XYZABCUVW") == std::string::npos;
    if (!known) {
        throw Error("this controller type does not support the axes '" + axes + "'",
                    {},
                    "use XYZ, followed by up to three of A B C U V W");
    }
    return options;
}

} // namespace

GrblEmulator::GrblEmulator(GrblEmulatorOptions options)
    : body_(std::make_unique<Body>(checked(std::move(options)))) {}

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
    const internal::Axes& at = body_->position();
    return {at[0], at[1], at[2]};
}

double GrblEmulator::axis_position(char letter) const {
    const std::size_t axis = body_->build().axes.find(letter);
    expects(axis != std::string::npos, "the machine has the axis");
    return body_->position()[axis];
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

} // namespace millwright::emulators
