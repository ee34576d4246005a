#include "core/cordic_control/mcs51.h"

#include "core/base/error.h"

#include <bit>
#include <cstddef>
#include <utility>

namespace millwright::cordic {

namespace {

constexpr std::size_t mcs51_memory = 0x10000;

constexpr unsigned half_carry_flag = 0x40;
constexpr unsigned overflow_flag = 0x04;

} // namespace

std::string_view to_text(Mcs51Stop stop) {
    switch (stop) {
    case Mcs51Stop::reserved:
        return "the byte 0xa5 is not an instruction";
    case Mcs51Stop::interrupts:
        return "interrupts were enabled, which is not supported";
    case Mcs51Stop::timer:
        return "a timer was started, which is not supported";
    case Mcs51Stop::serial:
        return "the serial port was written, which is not supported";
    case Mcs51Stop::idle:
        return "idle or power-down mode was requested, which is not supported";
    case Mcs51Stop::none:
        break;
    }
    return "none";
}

Mcs51::Mcs51(std::vector<std::uint8_t> code) : code_(std::move(code)), xdata_(mcs51_memory) {
    expects(code_.size() <= mcs51_memory, "code of an MCS-51 is at most 64 KiB");
    code_.resize(mcs51_memory);
    sfr_[internal::sfr_sp - 0x80] = 7;
    for (const unsigned port : {0x80U, 0x90U, 0xa0U, 0xb0U}) {
        sfr_[port - 0x80U] = 0xff;
    }
}

std::uint8_t Mcs51::fetch() {
    return code_[pc_++];
}

std::uint8_t Mcs51::direct(std::uint8_t address) const {
    switch (address) {
    case internal::sfr_a:
        return a_;
    case internal::sfr_psw: // with the parity of A
        return static_cast<std::uint8_t>((psw_ & 0xfeU) | (static_cast<unsigned>(std::popcount(a_)) & 1U));
    default:
        return address < 0x80 ? iram_[address] : sfr_[address - 0x80U];
    }
}

void Mcs51::set_direct(std::uint8_t address, std::uint8_t value) {
    if (address < 0x80) {
        iram_[address] = value;
        return;
    }
    constexpr unsigned run_bits = 0x50; // TR1, TR0
    if (address == internal::sfr_a) {
        a_ = value;
    } else if (address == internal::sfr_psw) {
        psw_ = value;
    } else if (address == internal::sfr_sbuf) {
        stop_ = Mcs51Stop::serial;
    } else if (address == internal::sfr_ie && (value & 0x80U) != 0) {
        stop_ = Mcs51Stop::interrupts;
    } else if (address == internal::sfr_tcon && (value & run_bits) != 0) {
        stop_ = Mcs51Stop::timer;
    } else if (address == internal::sfr_pcon && (value & 0x03U) != 0) {
        stop_ = Mcs51Stop::idle;
    }
    sfr_[address - 0x80U] = value;
}

bool Mcs51::bit(std::uint8_t address) const {
    const unsigned byte = address < 0x80 ? 0x20U + (address >> 3U) : address & 0xf8U;
    return (direct(internal::low_byte(byte)) >> (address & 7U) & 1U) != 0;
}

void Mcs51::set_bit(std::uint8_t address, bool on) {
    const std::uint8_t byte = internal::low_byte(address < 0x80 ? 0x20U + (address >> 3U) : address & 0xf8U);
    const unsigned mask = 1U << (address & 7U);
    set_direct(byte, internal::low_byte(on ? direct(byte) | mask : direct(byte) & ~mask));
}

std::uint8_t& Mcs51::bank_register(int n) {
    return iram_[(psw_ & 0x18U) + static_cast<unsigned>(n)];
}

std::uint16_t Mcs51::dptr() const {
    return static_cast<std::uint16_t>(direct(internal::sfr_dph) << 8U | direct(internal::sfr_dpl));
}

void Mcs51::push(std::uint8_t value) {
    const std::uint8_t to = ++sfr_[internal::sfr_sp - 0x80U];
    iram_[to] = value;
}

std::uint8_t Mcs51::pop() {
    return iram_[sfr_[internal::sfr_sp - 0x80U]--];
}

void Mcs51::call(std::uint16_t target) {
    push(internal::low_byte(pc_));
    push(internal::low_byte(pc_ >> 8U));
    pc_ = target;
}

void Mcs51::jump_if(bool condition, std::uint8_t offset) {
    if (condition) {
        pc_ = static_cast<std::uint16_t>(pc_ + static_cast<std::int8_t>(offset));
    }
}

void Mcs51::add(std::uint8_t value, bool with_carry) {
    const unsigned in = with_carry && carry() ? 1U : 0U;
    const unsigned sum = a_ + value + in;
    const bool half = (a_ & 0x0fU) + (value & 0x0fU) + in > 0x0fU;
    const bool into_sign = (a_ & 0x7fU) + (value & 0x7fU) + in > 0x7fU;
    psw_ =
        internal::low_byte((psw_ & ~(0x80U | half_carry_flag | overflow_flag)) | (sum > 0xffU ? 0x80U : 0U) |
                           (half ? half_carry_flag : 0U) | (into_sign != (sum > 0xffU) ? overflow_flag : 0U));
    a_ = internal::low_byte(sum);
}

void Mcs51::subtract(std::uint8_t value) {
    const int in = carry() ? 1 : 0;
    const int rest = a_ - value - in;
    const bool half = (a_ & 0x0f) - (value & 0x0f) - in < 0;
    const bool from_sign = (a_ & 0x7f) - (value & 0x7f) - in < 0;
    psw_ = internal::low_byte((psw_ & ~(0x80U | half_carry_flag | overflow_flag)) | (rest < 0 ? 0x80U : 0U) |
                              (half ? half_carry_flag : 0U) | (from_sign != (rest < 0) ? overflow_flag : 0U));
    a_ = internal::low_byte(static_cast<unsigned>(rest));
}

void Mcs51::decimal_adjust() {
    unsigned sum = a_;
    bool over = carry();
    if ((sum & 0x0fU) > 9U || (psw_ & half_carry_flag) != 0) {
        sum += 0x06U;
        over = over || sum > 0xffU;
        sum &= 0xffU;
    }
    if ((sum >> 4U) > 9U || over) {
        sum += 0x60U;
        over = over || sum > 0xffU;
    }
    set_carry(over);
    a_ = internal::low_byte(sum);
}

void Mcs51::step() {
    if (stop_ != Mcs51Stop::none) {
        return;
    }
    const std::uint8_t op = fetch();
    ++cycles_;
    if ((op & 0x0fU) < 4) {
        control(op);
    } else {
        operate(op);
    }
}

std::uint8_t Mcs51::source(int column) {
    switch (column) {
    case 4:
        return fetch();
    case 5:
        return direct(fetch());
    case 6:
    case 7:
        return iram_[bank_register(column - 6)];
    default:
        return bank_register(column - 8);
    }
}

void Mcs51::change(int column, std::uint8_t address, std::uint8_t value) {
    switch (column) {
    case 4:
        a_ = value;
        break;
    case 5:
        set_direct(address, value);
        break;
    case 6:
    case 7:
        iram_[bank_register(column - 6)] = value;
        break;
    default:
        bank_register(column - 8) = value;
    }
}

void Mcs51::divide() {
    cycles_ += 3;
    const std::uint8_t b = direct(internal::sfr_b);
    psw_ = internal::low_byte((psw_ & ~(0x80U | overflow_flag)) | (b == 0 ? overflow_flag : 0U));
    if (b != 0) {
        set_direct(internal::sfr_b, internal::low_byte(a_ % b));
        a_ = internal::low_byte(a_ / b);
    }
}

void Mcs51::multiply() {
    cycles_ += 3;
    const unsigned product = static_cast<unsigned>(a_) * direct(internal::sfr_b);
    psw_ = internal::low_byte((psw_ & ~(0x80U | overflow_flag)) | (product > 0xffU ? overflow_flag : 0U));
    a_ = internal::low_byte(product);
    set_direct(internal::sfr_b, internal::low_byte(product >> 8U));
}

template <class Change> std::uint8_t Mcs51::changed(int column, const Change& change_of) {
    const std::uint8_t address = column == 5 ? fetch() : std::uint8_t{0};
    const std::uint8_t old = column == 4 ? a_ : column == 5 ? direct(address) : source(column);
    const std::uint8_t value = change_of(old);
    change(column, address, value);
    return value;
}

void Mcs51::operate(std::uint8_t op) {
    const int column = op & 0x0f;
    switch (op >> 4) {
    case 0x0: // INC
        (void)changed(column, [](std::uint8_t old) { return internal::low_byte(old + 1U); });
        return;
    case 0x1: // DEC
        (void)changed(column, [](std::uint8_t old) { return internal::low_byte(old - 1U); });
        return;
    case 0x2: // ADD, ADDC
    case 0x3:
        return add(source(column), (op >> 4) == 3);
    case 0x4: // ORL
        a_ |= source(column);
        return;
    case 0x5: // ANL
        a_ &= source(column);
        return;
    case 0x6: // XRL
        a_ ^= source(column);
        return;
    case 0x7: { // MOV x, #
        cycles_ += column == 5 ? 1 : 0;
        const std::uint8_t address = column == 5 ? fetch() : std::uint8_t{0};
        return change(column, address, fetch());
    }
    case 0x8: { // MOV direct, x; DIV AB
        if (column == 4) {
            return divide();
        }
        ++cycles_;
        const std::uint8_t value = source(column); // of MOV direct, direct the source comes first
        return set_direct(fetch(), value);
    }
    default:
        return operate_on_a(op);
    }
}

void Mcs51::operate_on_a(std::uint8_t op) {
    const int column = op & 0x0f;
    switch (op >> 4) {
    case 0x9: // SUBB
        return subtract(source(column));
    case 0xa: // MOV x, direct; MUL AB
        if (column == 4) {
            return multiply();
        }
        if (column == 5) {
            stop_ = Mcs51Stop::reserved;
            return;
        }
        ++cycles_;
        return change(column, 0, direct(fetch()));
    case 0xb: { // CJNE: A with # or direct, others with #
        ++cycles_;
        const std::uint8_t left = column <= 5 ? a_ : source(column);
        const std::uint8_t right = column == 5 ? direct(fetch()) : fetch();
        set_carry(left < right);
        return jump_if(left != right, fetch());
    }
    case 0xc: // XCH; SWAP
        if (column == 4) {
            a_ = internal::low_byte(static_cast<unsigned>(a_) << 4U | a_ >> 4U);
            return;
        }
        (void)changed(column, [&](std::uint8_t old) { return std::exchange(a_, old); });
        return;
    case 0xd: // DJNZ; XCHD; DA
        if (column == 4) {
            return decimal_adjust();
        }
        if (column == 6 || column == 7) {
            (void)changed(column, [&](std::uint8_t old) {
                const std::uint8_t mine = a_;
                a_ = internal::low_byte((mine & 0xf0U) | (old & 0x0fU));
                return internal::low_byte((old & 0xf0U) | (mine & 0x0fU));
            });
            return;
        }
        ++cycles_;
        {
            const std::uint8_t left =
                changed(column, [](std::uint8_t old) { return internal::low_byte(old - 1U); });
            return jump_if(left != 0, fetch());
        }
    case 0xe: // MOV A, x; CLR A
        a_ = column == 4 ? std::uint8_t{0} : source(column);
        return;
    default: // MOV x, A; CPL A
        if (column == 4) {
            a_ = internal::low_byte(~static_cast<unsigned>(a_));
            return;
        }
        change(column, column == 5 ? fetch() : std::uint8_t{0}, a_);
    }
}

} // namespace millwright::cordic
