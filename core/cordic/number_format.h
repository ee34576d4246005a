// What the processor computes with: IEEE binary64, IEEE binary32, or two's-complement fixed point.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace millwright::cordic {

/// What becomes of the bits that a right shift drops.
enum class Rounding : std::uint8_t {
    truncate, ///< towards minus infinity: the plain arithmetic shift
    toward_zero,
    nearest,      ///< halves up: one more adder input in hardware
    nearest_even, ///< halves to the even neighbour
};

enum class NumberKind : std::uint8_t { binary64, binary32, fixed };

inline constexpr int least_word = 8;
inline constexpr int largest_word = 64;

/// A number format. Fixed point qI.F has I bits before the point, the sign among them, and F behind it.
struct NumberFormat {
    NumberKind kind = NumberKind::binary64;
    int integer_bits = 0;  ///< fixed: 1 to 63
    int fraction_bits = 0; ///< fixed: 0 to 62
    Rounding rounding = Rounding::truncate;

    /// Bits of a word.
    [[nodiscard]] constexpr int word() const {
        if (kind == NumberKind::fixed) {
            return integer_bits + fraction_bits;
        }
        return kind == NumberKind::binary64 ? 64 : 32;
    }

    friend bool operator==(const NumberFormat&, const NumberFormat&) = default;
};

[[nodiscard]] constexpr bool is_fixed(const NumberFormat& format) {
    return format.kind == NumberKind::fixed;
}

inline constexpr NumberFormat binary64{};
inline constexpr NumberFormat binary32{.kind = NumberKind::binary32};

/// The same numbers, rounded in that way.
[[nodiscard]] constexpr NumberFormat with_rounding(NumberFormat format, Rounding rounding) {
    format.rounding = rounding;
    return format;
}

/// qI.F. Throws Error unless the word has 8 to 64 bits, I is at least 1 and F at most 62.
[[nodiscard]] NumberFormat
fixed_format(int integer_bits, int fraction_bits, Rounding rounding = Rounding::truncate);

/// "f64", "f32" or "q2.22". Throws Error that quotes the text.
[[nodiscard]] NumberFormat parse_number_format(std::string_view text);

/// The name that parse_number_format reads.
[[nodiscard]] std::string to_text(const NumberFormat& format);

/// "truncate", "toward-zero", "nearest" or "nearest-even". Throws Error that quotes the text.
[[nodiscard]] Rounding parse_rounding(std::string_view text);
[[nodiscard]] std::string_view to_text(Rounding rounding);

/// One unit in the last place of a number of size 1.
[[nodiscard]] double resolution(const NumberFormat& format);

/// The word as `bits` bits hold it: shorter words are computed with copies of their sign in front.
[[nodiscard]] constexpr std::uint64_t lowest_bits(std::uint64_t word, int bits) {
    return bits < 64 ? word & ((std::uint64_t{1} << bits) - 1) : word;
}

} // namespace millwright::cordic
