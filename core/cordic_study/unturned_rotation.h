// A circular rotation takes any z, as the thesis's MATLAB function CORDIC-R does. Beyond the convergence
// range the steps turn the vector by a part of z, and the rest is left.
#pragma once

#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"
#include "core/cordic_study/single_pass.h"

#include <optional>
#include <string>

namespace millwright::cordic {

/// The largest |z| that the steps turn, rad and rounded down to 1e-5, where `input` is a rotation by more;
/// nothing where it is not.
[[nodiscard]] std::optional<double>
exceeded_range(const NumberFormat& format, const Sequence& sequence, const PassInput& input);

/// A sentence without full stop. `range`: what exceeded_range() gave.
[[nodiscard]] std::string unturned_text(const PassInput& input, double range);

} // namespace millwright::cordic
