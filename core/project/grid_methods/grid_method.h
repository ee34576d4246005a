// The grid methods that a project can choose: each is known by its row, which is in the file of the method.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace millwright::project {

struct GridMethodRow; // grid_method_row.h

extern const GridMethodRow uniform_row;        ///< grid_method_row.cpp
extern const GridMethodRow redistribution_row; ///< redistribution_method.cpp
extern const GridMethodRow elliptic_row;       ///< elliptic_methods.cpp
extern const GridMethodRow harmonic_row;       ///< elliptic_methods.cpp
extern const GridMethodRow tracks_row;         ///< track_methods.cpp
extern const GridMethodRow chain_row;          ///< track_methods.cpp

/// How a grid is made.
struct GridMethod {
    const GridMethodRow* row = &uniform_row;

    /// Those that are treated differently somewhere, or have a button of their own. Another needs no name
    /// here.
    static const GridMethod uniform, redistribution, elliptic, harmonic, tracks, chain;

    friend constexpr bool operator==(const GridMethod&, const GridMethod&) = default;
};
inline constexpr GridMethod GridMethod::uniform{&uniform_row};
inline constexpr GridMethod GridMethod::redistribution{&redistribution_row};
inline constexpr GridMethod GridMethod::elliptic{&elliptic_row};
inline constexpr GridMethod GridMethod::harmonic{&harmonic_row};
inline constexpr GridMethod GridMethod::tracks{&tracks_row};
inline constexpr GridMethod GridMethod::chain{&chain_row};

/// In the order in which people see them.
inline constexpr std::array every_grid_method{GridMethod{&uniform_row},
                                              GridMethod{&redistribution_row},
                                              GridMethod{&elliptic_row},
                                              GridMethod{&harmonic_row},
                                              GridMethod{&tracks_row},
                                              GridMethod{&chain_row}};

/// Of a method of every_grid_method, in it.
[[nodiscard]] inline std::size_t index_of(GridMethod method) {
    return static_cast<std::size_t>(std::ranges::find(every_grid_method, method) - every_grid_method.begin());
}

} // namespace millwright::project
