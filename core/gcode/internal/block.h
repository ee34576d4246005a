// One line of a program, read: its words by letter, its codes by modal group.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace millwright::gcode::internal {

/// G-codes are counted in tenths: 382 is G38.2.
enum : int { no_code = -1 };

/// Of LinuxCNC: codes of one group exclude each other on a line.
enum class GGroup : std::uint8_t {
    non_modal = 0,
    motion = 1,
    plane = 2,
    distance = 3,
    arc_distance = 4,
    feed_mode = 5,
    units = 6,
    cutter_compensation = 7,
    tool_length = 8,
    retract = 10,
    coordinate_system = 12,
    path_control = 13,
    spindle_mode = 14,
    lathe_diameter = 15
};

enum class MGroup : std::uint8_t {
    stopping = 4,
    input_output = 5,
    tool_change = 6,
    spindle = 7,
    coolant = 8,
    overrides = 9,
    user = 10
};

inline constexpr std::size_t g_group_count = 16;
inline constexpr std::size_t m_group_count = 11;

/// A bit a letter; `A` is bit 0.
[[nodiscard]] constexpr std::uint32_t word_bit(char letter) {
    return 1U << static_cast<unsigned>(letter - 'A');
}

constexpr std::uint32_t words_of(std::string_view letters) {
    std::uint32_t bits = 0;
    for (const char letter : letters) {
        bits |= word_bit(letter);
    }
    return bits;
}

inline constexpr std::uint32_t axis_words = words_of("XYZABCUVW");

struct Block {
    std::uint32_t words = 0; ///< which of `value` were given
    std::uint32_t g_groups = 0;
    std::uint32_t m_groups = 0;
    int motion = no_code; ///< the motion to make, given or modal
    int m_count = 0;
    bool polar_radius = false, polar_angle = false;
    bool all_spindles = false;        ///< $-1
    int spindle_column = 0;           ///< of $; 0: none
    double radius = 0.0, angle = 0.0; ///< polar coordinates @ and ^
    std::string_view comment;         ///< the last one that is not after a semicolon
    bool has_comment = false;
    std::array<double, 26> value{};
    std::array<int, 26> column{}; ///< where each word begins
    std::array<int, g_group_count> g{};
    std::array<int, g_group_count> g_column{};
    std::array<int, m_group_count> m{};
    std::array<int, m_group_count> m_column{};

    /// Ready for the next line; what the bits do not name is left as it is.
    void clear() {
        words = 0;
        g_groups = 0;
        m_groups = 0;
        motion = no_code;
        m_count = 0;
        polar_radius = polar_angle = false;
        all_spindles = false;
        spindle_column = 0;
        has_comment = false;
    }

    [[nodiscard]] bool has(char letter) const { return (words & word_bit(letter)) != 0; }
    [[nodiscard]] bool has_any(std::uint32_t letters) const { return (words & letters) != 0; }
    [[nodiscard]] double operator[](char letter) const {
        return value[static_cast<std::size_t>(letter - 'A')];
    }
    /// The value of a word, or `otherwise` where it is not given.
    [[nodiscard]] double value_or(char letter, double otherwise) const {
        return has(letter) ? (*this)[letter] : otherwise;
    }
    /// Where `letter` stands, or the line's first column.
    [[nodiscard]] int column_of(char letter) const {
        return has(letter) ? column[static_cast<std::size_t>(letter - 'A')] : 1;
    }
    void set(char letter, double number, int where) {
        const auto n = static_cast<std::size_t>(letter - 'A');
        words |= word_bit(letter);
        value[n] = number;
        column[n] = where;
    }

    [[nodiscard]] int code(GGroup group) const {
        const auto n = static_cast<std::size_t>(group);
        return ((g_groups >> n) & 1U) != 0 ? g[n] : no_code;
    }
    [[nodiscard]] int code(MGroup group) const {
        const auto n = static_cast<std::size_t>(group);
        return ((m_groups >> n) & 1U) != 0 ? m[n] : no_code;
    }
    [[nodiscard]] int column_of(GGroup group) const {
        return code(group) == no_code ? 1 : g_column[static_cast<std::size_t>(group)];
    }
    [[nodiscard]] int column_of(MGroup group) const {
        return code(group) == no_code ? 1 : m_column[static_cast<std::size_t>(group)];
    }
    [[nodiscard]] bool polar() const { return polar_radius || polar_angle; }
    [[nodiscard]] bool moves_axes() const { return has_any(axis_words) || polar(); }
};

} // namespace millwright::gcode::internal
