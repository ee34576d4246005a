// The same surface by other control points: of a higher degree, or as two patches.
// Source: Farin, Curves and Surfaces for CAGD, ch. 4.1 (subdivision), 6.10 (degree elevation), 13 (rational).
#pragma once

#include "core/geometry/bezier_patch.h"

#include <utility>

namespace millwright::geometry {

/// The same surface with a net of `degree_u` x `degree_v`, not below those it has, up to `max_degree`. Throws
/// Defect for others.
[[nodiscard]] BezierPatch elevated(const BezierPatch& patch, int degree_u, int degree_v);

/// A direction of the parameters.
enum class Parameter { u, v };

/// What lies before and behind the line where the parameter is `at`, each over [0,1]^2 again; of the same
/// degrees. Throws Defect unless 0 < at < 1.
[[nodiscard]] std::pair<BezierPatch, BezierPatch>
split(const BezierPatch& patch, Parameter parameter, double at);

} // namespace millwright::geometry
