#include "core/cordic/image.h"

#include "core/base/error.h"
#include "core/cordic/instruction.h"
#include "core/cordic/line_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace millwright::cordic {
namespace {

constexpr std::array<std::uint8_t, 4> magic = {'M', 'W', 'C', 'P'};
constexpr std::uint8_t version = 2;
constexpr std::uint8_t version_without_settings = 1;
constexpr const char* make_it = "write it with millwright cordic asm";

// Where what stands in the head of a file.
constexpr std::size_t version_at = 4;
constexpr std::size_t kind_at = 5;
constexpr std::size_t format_at = 6; // integer bits, fraction bits
constexpr std::size_t length_at = 8; // in 4 bytes
constexpr std::size_t iterations_at = 12;
constexpr std::size_t rounding_at = 13;
constexpr std::size_t sense_at = 14;
constexpr std::size_t zero_at = 15;
constexpr std::size_t head_size = 16;

[[noreturn]] void fail(const std::filesystem::path& file, std::size_t byte, std::string message) {
    throw Error(Diagnostic{{file, 0, 0, static_cast<std::int64_t>(byte)}, std::move(message), make_it});
}

/// The head of an image file, byte by byte.
class Head {
public:
    Head(std::span<const std::uint8_t> bytes, const std::filesystem::path& file)
        : bytes_(bytes), file_(file) {
        if (bytes.size() <= version_at || !std::ranges::equal(bytes.first(magic.size()), magic)) {
            fail(file, 0, "not a program of the CORDIC processor");
        }
        if (bytes[version_at] == version_without_settings) {
            fail(
                file,
                version_at,
                "the program file has version 1, which does not state the steps and rounding it is made for");
        }
        if (bytes[version_at] != version) {
            fail(file,
                 version_at,
                 fmt::format("version {} of the program file is not supported", bytes[version_at]));
        }
        if (bytes.size() < head_size) {
            fail(file, bytes.size(), "the header of the program file is incomplete");
        }
    }

    [[nodiscard]] NumberFormat format() const {
        switch (at<NumberKind>(kind_at, NumberKind::fixed, "number type")) {
        case NumberKind::binary64:
            return binary64;
        case NumberKind::binary32:
            return binary32;
        case NumberKind::fixed:
            break;
        }
        try {
            return fixed_format(bytes_[format_at], bytes_[format_at + 1]);
        } catch (const Error& error) {
            fail(file_, format_at, error.diagnostic().message);
        }
    }
    [[nodiscard]] MadeFor made_for() const {
        const int iterations = bytes_[iterations_at];
        if (iterations > most_steps) {
            fail(file_,
                 iterations_at,
                 fmt::format("{} iterations are too many, at most {} are possible", iterations, most_steps));
        }
        return {iterations,
                at<Rounding>(rounding_at, Rounding::nearest_even, "rounding"),
                at<SignOfZero>(zero_at, SignOfZero::zero, "sign of zero"),
                at<ArcSense>(sense_at, ArcSense::thesis, "direction of G02")};
    }
    [[nodiscard]] std::span<const std::uint8_t> code() const {
        const std::span<const std::uint8_t> code = bytes_.subspan(head_size);
        const Word announced = little_endian(bytes_.subspan(length_at, 4));
        if (announced != code.size()) {
            fail(file_,
                 length_at,
                 fmt::format("{} bytes of code are declared, but the file has {}", announced, code.size()));
        }
        if (code.size() > most_code) {
            fail(file_,
                 length_at,
                 fmt::format("the program has {} bytes of code, but the program ROM holds {}",
                             code.size(),
                             most_code));
        }
        return code;
    }

private:
    std::span<const std::uint8_t> bytes_;
    const std::filesystem::path& file_;

    template <class Enumeration>
    [[nodiscard]] Enumeration at(std::size_t byte, Enumeration last, const char* what) const {
        if (bytes_[byte] > static_cast<std::uint8_t>(last)) {
            fail(file_, byte, fmt::format("{} {} is not supported", what, bytes_[byte]));
        }
        return static_cast<Enumeration>(bytes_[byte]);
    }
};

constexpr std::array<std::string_view, 2> senses = {"iso", "thesis"};
constexpr std::array<std::string_view, 2> zeros = {"positive", "matlab"};

std::size_t index_in(const std::array<std::string_view, 2>& names, std::string_view text, const char* what) {
    const auto* const found = std::ranges::find(names, text);
    if (found == names.end()) {
        throw Error(fmt::format("\"{}\" is not a valid {}", text, what),
                    {},
                    fmt::format("use {} or {}", names[0], names[1]));
    }
    return static_cast<std::size_t>(found - names.begin());
}

} // namespace

ArcSense parse_arc_sense(std::string_view text) {
    return static_cast<ArcSense>(index_in(senses, text, "direction of G02"));
}

std::string_view to_text(ArcSense sense) {
    return senses[static_cast<std::size_t>(sense)];
}

SignOfZero parse_sign_of_zero(std::string_view text) {
    return static_cast<SignOfZero>(index_in(zeros, text, "sign of zero"));
}

std::string_view to_text(SignOfZero zero) {
    return zeros[static_cast<std::size_t>(zero)];
}

int parse_iterations(std::string_view text) {
    long long count = 0;
    if (text == "thesis") {
        return 0;
    }
    if (!read_number(text, count) || count < 1 || count > most_steps) {
        throw Error(fmt::format("\"{}\" is not a valid number of iterations", text),
                    {},
                    fmt::format("use 1 to {}, or thesis for its 29 steps", most_steps));
    }
    return static_cast<int>(count);
}

Sequence sequence_of(const MadeFor& made_for) {
    return made_for.iterations == 0 ? thesis_sequence()
                                    : classic_sequence(CoordinateSystem::circular, made_for.iterations);
}

std::vector<std::uint8_t> to_bytes(const Image& image) {
    std::vector<std::uint8_t> bytes(head_size);
    std::ranges::copy(magic, bytes.begin());
    bytes[version_at] = version;
    bytes[kind_at] = static_cast<std::uint8_t>(image.format.kind);
    bytes[format_at] = static_cast<std::uint8_t>(image.format.integer_bits);
    bytes[format_at + 1] = static_cast<std::uint8_t>(image.format.fraction_bits);
    for (unsigned byte = 0; byte < 4; ++byte) {
        bytes[length_at + byte] = static_cast<std::uint8_t>(image.code.size() >> (8 * byte));
    }
    bytes[iterations_at] = static_cast<std::uint8_t>(image.made_for.iterations);
    bytes[rounding_at] = static_cast<std::uint8_t>(image.made_for.rounding);
    bytes[sense_at] = static_cast<std::uint8_t>(image.made_for.sense);
    bytes[zero_at] = static_cast<std::uint8_t>(image.made_for.zero);
    bytes.insert(bytes.end(), image.code.begin(), image.code.end());
    return bytes;
}

Image parse_image(std::span<const std::uint8_t> bytes, const std::filesystem::path& file) {
    const Head head(bytes, file);
    const std::span<const std::uint8_t> code = head.code();
    return {head.format(), {code.begin(), code.end()}, head.made_for()};
}

} // namespace millwright::cordic
