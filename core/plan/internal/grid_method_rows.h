// The rows of the grid methods, each in the file of its method.
#pragma once

#include "core/plan/grid_method.h"

namespace millwright::plan {

extern const GridMethodRow redistribution_row; ///< redistribution_method.cpp
extern const GridMethodRow elliptic_row;       ///< elliptic_methods.cpp
extern const GridMethodRow harmonic_row;       ///< elliptic_methods.cpp
extern const GridMethodRow tracks_row;         ///< track_methods.cpp
extern const GridMethodRow chain_row;          ///< track_methods.cpp

} // namespace millwright::plan
