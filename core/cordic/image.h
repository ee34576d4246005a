// A program of the processor as a file holds it: its bytes, the number format that they are in, and the
// arithmetic that the program counts on. The layout is ours: docs/reference/cordic.md#image-files.
#pragma once

#include "core/cordic/kernel.h"
#include "core/cordic/number_format.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace millwright::cordic {

/// Which way G02 turns.
enum class ArcSense : std::uint8_t {
    iso,   ///< clockwise, as ISO 6983 says
    thesis ///< counter-clockwise, as the thesis's model does
};

/// "iso" or "thesis". Throws Error that quotes the text.
[[nodiscard]] ArcSense parse_arc_sense(std::string_view text);
[[nodiscard]] std::string_view to_text(ArcSense sense);

/// "positive" or "matlab". Throws Error that quotes the text.
[[nodiscard]] SignOfZero parse_sign_of_zero(std::string_view text);
[[nodiscard]] std::string_view to_text(SignOfZero zero);

/// 1 to most_steps, or "thesis", which is 0. Throws Error that quotes the text.
[[nodiscard]] int parse_iterations(std::string_view text);

/// With what a program is to be executed: arcs are divided as their rotations come out, so that others than
/// these lead them beside their places.
struct MadeFor {
    int iterations = 0; ///< of the classic sequence, up to most_steps; 0: the thesis's 29 steps
    Rounding rounding = Rounding::truncate;
    SignOfZero zero = SignOfZero::positive;
    ArcSense sense = ArcSense::iso;

    friend bool operator==(const MadeFor&, const MadeFor&) = default;
};

/// The sequence of so many iterations.
[[nodiscard]] Sequence sequence_of(const MadeFor& made_for);

/// A program as it lies in memory from address 0.
struct Image {
    NumberFormat format;
    std::vector<std::uint8_t> code{};
    MadeFor made_for{};

    friend bool operator==(const Image&, const Image&) = default;
};

/// The bytes of an image file.
[[nodiscard]] std::vector<std::uint8_t> to_bytes(const Image& image);

/// Reads an image file. Throws Error with file and byte for anything but a whole and valid one of the present
/// version; its instructions are not looked at.
[[nodiscard]] Image parse_image(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

} // namespace millwright::cordic
