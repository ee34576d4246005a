// Jumps, bits, external memory and the data pointer: the instructions of the columns 0 to 3.
#include "core/base/error.h"
#include "core/cordic_control/mcs51.h"

#include <cstddef>

namespace millwright::cordic {

std::uint16_t Mcs51::far() {
    const unsigned high = fetch();
    return static_cast<std::uint16_t>(high << 8U | fetch());
}

void Mcs51::control(std::uint8_t op) {
    if ((op & 0x1fU) == 0x01 || (op & 0x1fU) == 0x11) { // AJMP, ACALL
        ++cycles_;
        const unsigned low = fetch();
        const auto target = static_cast<std::uint16_t>((pc_ & 0xf800U) | (op & 0xe0U) << 3U | low);
        if ((op & 0x10U) != 0) {
            call(target);
        } else {
            pc_ = target;
        }
        return;
    }
    switch (op) {
    case 0x00: // NOP
        return;
    case 0x10:   // JBC
    case 0x20:   // JB
    case 0x30: { // JNB
        ++cycles_;
        const std::uint8_t address = fetch();
        const std::uint8_t offset = fetch();
        const bool on = bit(address);
        if (op == 0x10 && on) {
            set_bit(address, false);
        }
        return jump_if(on == (op != 0x30), offset);
    }
    case 0x40: // JC
    case 0x50: // JNC
        ++cycles_;
        return jump_if(carry() == (op == 0x40), fetch());
    case 0x60: // JZ
    case 0x70: // JNZ
        ++cycles_;
        return jump_if((a_ == 0) == (op == 0x60), fetch());
    case 0x80: // SJMP
        ++cycles_;
        return jump_if(true, fetch());
    case 0x02: // LJMP
        ++cycles_;
        pc_ = far();
        return;
    case 0x12: // LCALL
        ++cycles_;
        return call(far());
    case 0x22:   // RET
    case 0x32: { // RETI
        ++cycles_;
        const unsigned high = pop();
        pc_ = static_cast<std::uint16_t>(high << 8U | pop());
        return;
    }
    case 0x73: // JMP @A+DPTR
        ++cycles_;
        pc_ = static_cast<std::uint16_t>(dptr() + a_);
        return;
    default:
        return move(op);
    }
}

void Mcs51::move(std::uint8_t op) {
    switch (op) {
    case 0x90: { // MOV DPTR
        ++cycles_;
        const std::uint16_t value = far();
        set_direct(internal::sfr_dph, internal::low_byte(value >> 8U));
        return set_direct(internal::sfr_dpl, internal::low_byte(value));
    }
    case 0x83: // MOVC A, @A+PC
        ++cycles_;
        a_ = code_[static_cast<std::uint16_t>(pc_ + a_)];
        return;
    case 0x93: // MOVC A, @A+DPTR
        ++cycles_;
        a_ = code_[static_cast<std::uint16_t>(dptr() + a_)];
        return;
    case 0xa3: { // INC DPTR
        ++cycles_;
        const auto next = static_cast<std::uint16_t>(dptr() + 1);
        set_direct(internal::sfr_dph, internal::low_byte(next >> 8U));
        return set_direct(internal::sfr_dpl, internal::low_byte(next));
    }
    case 0xc0: // PUSH
        ++cycles_;
        return push(direct(fetch()));
    case 0xd0: { // POP
        ++cycles_;
        const std::uint8_t address = fetch();
        return set_direct(address, pop());
    }
    case 0xe0: // MOVX A, @DPTR
        ++cycles_;
        a_ = xdata_[dptr()];
        return;
    case 0xf0: // MOVX @DPTR, A
        ++cycles_;
        xdata_[dptr()] = a_;
        return;
    case 0xe2: // MOVX A, @Ri: P2 is the page
    case 0xe3:
        ++cycles_;
        a_ = xdata_[static_cast<std::size_t>(direct(0xa0)) << 8U | bank_register(op & 1)];
        return;
    case 0xf2: // MOVX @Ri, A
    case 0xf3:
        ++cycles_;
        xdata_[static_cast<std::size_t>(direct(0xa0)) << 8U | bank_register(op & 1)] = a_;
        return;
    default:
        return special(op);
    }
}

void Mcs51::special(std::uint8_t op) {
    const auto logic = [&](std::uint8_t old, std::uint8_t with) {
        const unsigned row = op >> 4U; // 4 ORL, 5 ANL, 6 XRL
        return internal::low_byte(row == 4 ? old | with : row == 5 ? old & with : old ^ with);
    };
    const unsigned a = a_;
    const unsigned c = carry() ? 1U : 0U;
    switch (op) {
    case 0x42: // ORL, ANL, XRL direct, A
    case 0x52:
    case 0x62: {
        const std::uint8_t address = fetch();
        return set_direct(address, logic(direct(address), a_));
    }
    case 0x43: // ORL, ANL, XRL direct, #
    case 0x53:
    case 0x63: {
        ++cycles_;
        const std::uint8_t address = fetch();
        const std::uint8_t with = fetch();
        return set_direct(address, logic(direct(address), with));
    }
    case 0xb2: { // CPL bit
        const std::uint8_t address = fetch();
        return set_bit(address, !bit(address));
    }
    case 0xc2: // CLR bit
        return set_bit(fetch(), false);
    case 0xd2: // SETB bit
        return set_bit(fetch(), true);
    case 0xb3: // CPL C
        return set_carry(!carry());
    case 0xc3: // CLR C
        return set_carry(false);
    case 0xd3: // SETB C
        return set_carry(true);
    case 0x03: // RR
        a_ = internal::low_byte(a >> 1U | a << 7U);
        return;
    case 0x13: // RRC
        a_ = internal::low_byte(a >> 1U | c << 7U);
        return set_carry((a & 1U) != 0);
    case 0x23: // RL
        a_ = internal::low_byte(a << 1U | a >> 7U);
        return;
    case 0x33: // RLC
        a_ = internal::low_byte(a << 1U | c);
        return set_carry((a & 0x80U) != 0);
    default:
        return move_bits(op);
    }
}

void Mcs51::move_bits(std::uint8_t op) {
    switch (op) {
    case 0x72: // ORL C, bit
        ++cycles_;
        return set_carry(bit(fetch()) || carry());
    case 0xa0: // ORL C, /bit
        ++cycles_;
        return set_carry(!bit(fetch()) || carry());
    case 0x82: // ANL C, bit
        ++cycles_;
        return set_carry(bit(fetch()) && carry());
    case 0xb0: // ANL C, /bit
        ++cycles_;
        return set_carry(!bit(fetch()) && carry());
    case 0x92: // MOV bit, C
        ++cycles_;
        return set_bit(fetch(), carry());
    case 0xa2: // MOV C, bit
        return set_carry(bit(fetch()));
    default:
        expects(false, "every instruction of an MCS-51 is known");
    }
}

} // namespace millwright::cordic
