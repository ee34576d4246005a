// An MCS-51 micro-controller: all of its instructions with their clocks, to count what the thesis's
// comparison program takes (its appendix A). A machine cycle is 12 clocks as on the 8051 itself. Timers,
// serial port and interrupts are not built in: a program that starts one of them stops, and says so.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace millwright::cordic {
namespace internal {

// Addresses of the special function registers of an MCS-51 that mean something to the model.

inline constexpr std::uint8_t sfr_sp = 0x81;
inline constexpr std::uint8_t sfr_dpl = 0x82;
inline constexpr std::uint8_t sfr_dph = 0x83;
inline constexpr std::uint8_t sfr_pcon = 0x87;
inline constexpr std::uint8_t sfr_tcon = 0x88;
inline constexpr std::uint8_t sfr_sbuf = 0x99;
inline constexpr std::uint8_t sfr_ie = 0xa8;
inline constexpr std::uint8_t sfr_psw = 0xd0;
inline constexpr std::uint8_t sfr_a = 0xe0;
inline constexpr std::uint8_t sfr_b = 0xf0;

[[nodiscard]] constexpr std::uint8_t low_byte(unsigned value) {
    return static_cast<std::uint8_t>(value & 0xffU);
}

} // namespace internal

enum class Mcs51Stop : std::uint8_t {
    none,
    reserved,   ///< byte 0xa5, which is no instruction
    interrupts, ///< EA was set
    timer,      ///< TR0 or TR1 was set
    serial,     ///< something was written to SBUF
    idle        ///< PCON ordered idle or power-down
};

[[nodiscard]] std::string_view to_text(Mcs51Stop stop);

class Mcs51 {
public:
    static constexpr int clocks_per_cycle = 12;

    /// `code` from address 0, at most 64 KiB. External memory is `xdata`, 64 KiB of zeros.
    explicit Mcs51(std::vector<std::uint8_t> code);

    /// One instruction.
    void step();

    [[nodiscard]] std::int64_t clocks() const { return clocks_per_cycle * cycles_; }
    [[nodiscard]] std::uint16_t pc() const { return pc_; }
    [[nodiscard]] Mcs51Stop stop() const { return stop_; }
    /// Internal memory: what is addressed directly below 0x80, indirectly above.
    [[nodiscard]] std::uint8_t internal(std::uint8_t address) const { return iram_[address]; }
    /// A special function register, 0x80 to 0xff.
    [[nodiscard]] std::uint8_t sfr(std::uint8_t address) const { return direct(address); }
    [[nodiscard]] std::vector<std::uint8_t>& xdata() { return xdata_; }
    [[nodiscard]] const std::vector<std::uint8_t>& xdata() const { return xdata_; }
    /// A port pin: bit `n` of P1.
    [[nodiscard]] bool p1(int n) const { return (sfr(p1_address) >> n & 1) != 0; }

private:
    static constexpr std::uint8_t p1_address = 0x90;

    [[nodiscard]] std::uint8_t fetch();
    [[nodiscard]] std::uint8_t direct(std::uint8_t address) const;
    void set_direct(std::uint8_t address, std::uint8_t value);
    [[nodiscard]] bool bit(std::uint8_t address) const;
    void set_bit(std::uint8_t address, bool on);
    [[nodiscard]] std::uint8_t& bank_register(int n);
    [[nodiscard]] std::uint16_t dptr() const;
    void push(std::uint8_t value);
    [[nodiscard]] std::uint8_t pop();
    void call(std::uint16_t target);
    void jump_if(bool condition, std::uint8_t offset);
    void add(std::uint8_t value, bool with_carry);
    void subtract(std::uint8_t value);
    [[nodiscard]] bool carry() const { return (psw_ & 0x80U) != 0; }
    void set_carry(bool on) { psw_ = static_cast<std::uint8_t>((psw_ & 0x7fU) | (on ? 0x80U : 0U)); }

    void control(std::uint8_t op);                 ///< low nibble 0 to 3: branches
    void move(std::uint8_t op);                    ///< and DPTR, stack, tables, external memory
    void move_bits(std::uint8_t op);               ///< and bits into the carry and back
    [[nodiscard]] std::uint16_t far();             ///< two bytes of the program, high byte first
    void special(std::uint8_t op);                 ///< and direct logic, bits, rotations of A
    [[nodiscard]] std::uint8_t source(int column); ///< operand of a column: #, direct, @Ri, Rn
    void change(int column, std::uint8_t address, std::uint8_t value);
    /// Where the operand is, for what reads and writes it: A in column 4. Returns the new value.
    template <class Change> std::uint8_t changed(int column, const Change& change_of);
    void operate(std::uint8_t op);      ///< low nibble 4 to 15
    void operate_on_a(std::uint8_t op); ///< of these, the rows from 9
    void divide();
    void multiply();
    void decimal_adjust();

    std::vector<std::uint8_t> code_;
    std::vector<std::uint8_t> xdata_;
    std::array<std::uint8_t, 256> iram_{};
    std::array<std::uint8_t, 128> sfr_{};
    std::uint8_t a_ = 0;
    std::uint8_t psw_ = 0;
    std::uint16_t pc_ = 0;
    std::int64_t cycles_ = 0;
    Mcs51Stop stop_ = Mcs51Stop::none;
};

} // namespace millwright::cordic
