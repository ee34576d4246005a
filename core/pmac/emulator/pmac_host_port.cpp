#include "core/pmac/emulator/pmac_host_port.h"

#include "core/pmac/emulator/internal/interrupt_controller.h"

#include <array>
#include <string_view>

namespace millwright::pmac {

namespace {

enum Register {
    interrupt_control,
    command_vector,
    card_status,
    interrupt_vector,
    data_high = 5,
    data_middle,
    data_low,
    controller_0,
    controller_1,
    acknowledge
};

constexpr std::uint8_t readable = 1, writable = 2;
constexpr int compare_input = 5; // EQU1

} // namespace

class PmacHostPort::Body {
public:
    explicit Body(PmacEmulator& card) : card_(card) {}

    [[nodiscard]] std::uint8_t read(int offset) {
        switch (offset) {
        case interrupt_control:
        case command_vector:
        case interrupt_vector:
            return kept_[static_cast<std::size_t>(offset)];
        case card_status:
            return static_cast<std::uint8_t>((from_card_.empty() ? 0 : readable) | (to_card_ ? 0 : writable));
        case data_high:
        case data_middle:
            return 0; // the card's own, in which it tells no characters
        case data_low:
            return next_character();
        case controller_0:
        case controller_1:
            return interrupts_.read(offset - controller_0);
        default:
            return links::no_card;
        }
    }

    void write(int offset, std::uint8_t value) {
        switch (offset) {
        case interrupt_control:
        case command_vector:
        case interrupt_vector:
            kept_[static_cast<std::size_t>(offset)] = value;
            break;
        case data_low:
            to_card_ = static_cast<char>(value);
            break;
        case controller_0:
        case controller_1:
            interrupts_.write(offset - controller_0, value);
            break;
        case acknowledge:
            if (const auto vector = interrupts_.acknowledge()) {
                kept_[interrupt_vector] = *vector;
            } else { // what is written while nothing is pending is a command word
                interrupts_.write(0, value);
            }
            break;
        default:
            break;
        }
    }

    void advance(double seconds) {
        if (to_card_) {
            card_.receive(std::string_view(&*to_card_, 1));
            to_card_.reset();
        }
        card_.advance(seconds);
        from_card_ += card_.take_output();
        if (card_.take_compare_pulses() > 0) {
            interrupts_.request(compare_input);
        }
    }

    [[nodiscard]] bool interrupts() const { return interrupts_.pending().has_value(); }

private:
    std::uint8_t next_character() {
        if (!from_card_.empty()) {
            last_ = static_cast<std::uint8_t>(from_card_.front());
            from_card_.erase(0, 1);
        }
        return last_;
    }

    PmacEmulator& card_;
    card::InterruptController interrupts_;
    std::array<std::uint8_t, 4> kept_{};
    std::optional<char> to_card_;
    std::string from_card_;
    std::uint8_t last_ = 0;
};

PmacHostPort::PmacHostPort(PmacEmulator& card) : body_(std::make_unique<Body>(card)) {}

PmacHostPort::~PmacHostPort() = default;

std::uint8_t PmacHostPort::read(int offset) {
    return body_->read(offset);
}

void PmacHostPort::write(int offset, std::uint8_t value) {
    body_->write(offset, value);
}

void PmacHostPort::advance(double seconds) {
    body_->advance(seconds);
}

bool PmacHostPort::interrupts() const {
    return body_->interrupts();
}

} // namespace millwright::pmac
