#include "core/pmac/emulator/internal/interrupt_controller.h"

namespace millwright::pmac::card {

namespace {

constexpr unsigned first_word = 0x10, needs_fourth = 0x01, is_single = 0x02;          // bits of ICW1
constexpr unsigned automatic_end = 0x02;                                              // of ICW4
constexpr unsigned third_operation = 0x08, choose_register = 0x02, in_service = 0x01; // of OCW3
constexpr unsigned end_of_interrupt = 0x20;                                           // of OCW2
constexpr unsigned vector_bits = 0xF8;
constexpr int inputs = 8;

std::uint8_t bit(int input) {
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(input));
}

} // namespace

void InterruptController::begin(std::uint8_t value) {
    requests_ = service_ = mask_ = 0;
    shows_service_ = ends_by_itself_ = ready_ = false;
    single_ = (value & is_single) != 0;
    needs_mode_ = (value & needs_fourth) != 0;
    expects_ = Expects::vector;
}

void InterruptController::write(int address, std::uint8_t value) {
    if (address == 0 && (value & first_word) != 0) {
        begin(value);
        return;
    }
    if (address == 0) {
        if ((value & third_operation) != 0) {
            shows_service_ = (value & choose_register) != 0 ? (value & in_service) != 0 : shows_service_;
        } else if ((value & end_of_interrupt) != 0) {
            service_ =
                static_cast<std::uint8_t>(service_ & (service_ - 1U)); // the highest, which is the lowest bit
        }
        return;
    }
    const Expects now = expects_;
    if (now == Expects::nothing) {
        mask_ = value;
        return;
    }
    if (now == Expects::vector) {
        vector_ = static_cast<std::uint8_t>(value & vector_bits);
    } else if (now == Expects::mode) {
        ends_by_itself_ = (value & automatic_end) != 0;
    }
    expects_ = now == Expects::vector && !single_    ? Expects::cascade
               : now != Expects::mode && needs_mode_ ? Expects::mode
                                                     : Expects::nothing;
    ready_ = expects_ == Expects::nothing;
}

std::uint8_t InterruptController::read(int address) const {
    return address != 0 ? mask_ : shows_service_ ? service_ : requests_;
}

void InterruptController::request(int input) {
    if (ready_) {
        requests_ = static_cast<std::uint8_t>(requests_ | bit(input));
    }
}

std::optional<int> InterruptController::pending() const {
    for (int input = 0; input < inputs; ++input) {
        if ((service_ & bit(input)) != 0 && !ends_by_itself_) {
            return std::nullopt; // nothing comes before what is in service
        }
        if ((requests_ & static_cast<unsigned>(~mask_) & bit(input)) != 0) {
            return input;
        }
    }
    return std::nullopt;
}

std::optional<std::uint8_t> InterruptController::acknowledge() {
    const std::optional<int> input = pending();
    if (!input) {
        return std::nullopt;
    }
    service_ = ends_by_itself_ ? bit(*input) : static_cast<std::uint8_t>(service_ | bit(*input));
    requests_ = static_cast<std::uint8_t>(requests_ & ~bit(*input));
    return static_cast<std::uint8_t>(vector_ + static_cast<unsigned>(*input));
}

} // namespace millwright::pmac::card
