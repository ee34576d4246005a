// What the numbers and choices of a project say about themselves: one table feeds the project file, the
// fields of the window and the reference page. Numbers are in the unit that people see.
#pragma once

#include "core/project/project.h"

#include <cmath>
#include <span>
#include <string_view>
#include <type_traits>

namespace millwright::project {

/// Reading and writing one number of `Owner`, whatever its type.
template <class Owner> struct NumberField {
    double (*get)(const Owner&);
    void (*set)(Owner&, double);
    bool whole;
};

namespace internal {
template <class Owner, class Number> Owner owner_of(Number Owner::*);
} // namespace internal

/// The field behind a member pointer: field<&GridInput::nu>.
template <auto member>
inline constexpr NumberField<decltype(internal::owner_of(member))> field{
    [](const auto& owner) { return static_cast<double>(owner.*member); },
    [](auto& owner, double value) {
        using Number = std::remove_reference_t<decltype(owner.*member)>;
        owner.*member = static_cast<Number>(std::is_integral_v<Number> ? std::round(value) : value);
    },
    std::is_integral_v<std::remove_reference_t<decltype(decltype(internal::owner_of(member)){}.*member)>>};

/// One number of `Owner`. Its default is what a fresh Owner holds.
template <class Owner> struct NumberSetting {
    std::string_view id;    ///< its field in the project file
    std::string_view label; ///< for people
    std::string_view unit;  ///< empty for a bare number
    std::string_view tip;   ///< what it is and which formula it stands in
    double min = 0.0;
    double max = 0.0;
    int decimals = 0; ///< that make sense to a person
    NumberField<Owner> access;

    [[nodiscard]] bool whole() const { return access.whole; }
    [[nodiscard]] double value(const Owner& owner) const { return access.get(owner); }
    [[nodiscard]] double default_value() const { return value(Owner{}); }
    /// A whole number takes the nearest one. `value` is finite and inside the range.
    void set(Owner& owner, double value) const { access.set(owner, value); }
};

/// Nodes of a grid along u or v: a path of a million moves.
inline constexpr int most_nodes_per_side = 1000;

/// The names are the thesis's letters.
[[nodiscard]] std::span<const NumberSetting<ToolSetInput>> tool_set_numbers();
[[nodiscard]] std::span<const NumberSetting<GridInput>> grid_numbers();
[[nodiscard]] std::span<const NumberSetting<RedistributionInput>> redistribution_numbers();
[[nodiscard]] std::span<const NumberSetting<EllipticInput>> elliptic_numbers();
/// Whether the harmonic map uses the number of `id` too.
[[nodiscard]] bool is_of_harmonic_map(std::string_view id);
[[nodiscard]] std::span<const NumberSetting<grid::Region>> region_numbers();
[[nodiscard]] std::span<const NumberSetting<grid::MixSettings>> mix_numbers();
[[nodiscard]] std::span<const NumberSetting<TracksInput>> tracks_numbers();
[[nodiscard]] std::span<const NumberSetting<ChainInput>> chain_numbers();
[[nodiscard]] std::span<const NumberSetting<ToolpathInput>> toolpath_numbers();
[[nodiscard]] std::span<const NumberSetting<SequencingInput>> sequencing_numbers();
[[nodiscard]] std::span<const NumberSetting<ProgramInput>> program_numbers();

/// One of the values that a choice can have.
template <class Value> struct Choice {
    Value value;
    std::string_view id;    ///< in the project file
    std::string_view label; ///< for people
    std::string_view tip;
};

[[nodiscard]] std::span<const Choice<grid::TrackDirection>> track_directions();
[[nodiscard]] std::span<const Choice<GridMethod>> grid_methods();
[[nodiscard]] std::span<const Choice<WeightSource>> weight_sources();
[[nodiscard]] std::span<const Choice<StrategyInput>> strategies();
[[nodiscard]] std::span<const Choice<toolpath::SequencingGoal>> sequencing_goals();
/// All but the harmonic map, which is a grid method.
[[nodiscard]] std::span<const Choice<grid::EllipticMethod>> elliptic_solvers();
[[nodiscard]] std::span<const Choice<grid::Combination>> combinations();
[[nodiscard]] std::span<const Choice<LinkInput>> links();
[[nodiscard]] std::span<const Choice<kinematics::AngleMode>> angle_modes();

/// The row of `value`; every value has one.
template <class Value> const Choice<Value>& row_of(std::span<const Choice<Value>> choices, Value value) {
    const Choice<Value>* found = &choices.front();
    for (const Choice<Value>& choice : choices) {
        found = choice.value == value ? &choice : found;
    }
    return *found;
}

/// Control points may lie this far from the workpiece's origin along each axis, mm.
inline constexpr double farthest_point_mm = 1e5;

} // namespace millwright::project
