// Addresses of the special function registers of an MCS-51 that mean something to the model.
#pragma once

#include <cstdint>

namespace millwright::cordic::internal {

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

} // namespace millwright::cordic::internal
