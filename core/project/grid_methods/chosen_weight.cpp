#include "core/project/grid_methods/chosen_weight.h"

#include "core/base/error.h"
#include "core/grid/expression_weight.h"

#include <utility>

namespace millwright::project {

namespace {

using PatchPtr = std::shared_ptr<const geometry::ParametricSurface>;

grid::WeightPtr
weight_of_formula(const GridInput& input, const PatchPtr& patch, const grid::WeightPtr& error) {
    try {
        return grid::expression_weight(input.elliptic.expression, input.nu, input.nv, {patch, error});
    } catch (const Error& fault) {
        Diagnostic found = fault.diagnostic();
        found.message = "grid/elliptic/expression, character " + std::to_string(found.place.column) + ": " +
                        found.message;
        found.place = {}; // it counts in the formula, not in a file
        throw Error(std::move(found));
    }
}

grid::WeightPtr mixed_weight_of(const GridInput& input, const PatchPtr& patch, const grid::WeightPtr& error) {
    const grid::MixSettings& mix = input.elliptic.mix;
    grid::MixedReasons reasons;
    reasons.error = error;
    if (mix.curvature > 0.0) {
        reasons.curvature = grid::curvature_weight(*patch, input.nu, input.nv);
    }
    if (mix.painted > 0.0) {
        reasons.painted = input.elliptic.painted
                              ? grid::field_weight(*input.elliptic.painted, input.nu, input.nv)
                              : grid::constant_weight(0.0);
    }
    if (mix.expression > 0.0) {
        reasons.expression = weight_of_formula(input, patch, error);
    }
    return grid::mixed_weight(reasons, mix, input.nu, input.nv);
}

} // namespace

bool needs_error(const EllipticInput& input) {
    const auto formula_needs_it = [&] { return grid::speaks_of_error(input.expression); };
    switch (input.weight) {
    case WeightSource::error:
        return true;
    case WeightSource::expression:
        return formula_needs_it();
    case WeightSource::mixed:
        return input.mix.error > 0.0 || (input.mix.expression > 0.0 && formula_needs_it());
    case WeightSource::w1:
    case WeightSource::w2:
    case WeightSource::w3:
    case WeightSource::w4:
        break;
    }
    return false;
}

grid::WeightPtr chosen_weight(const GridInput& input,
                              const geometry::ParametricSurface& patch,
                              const grid::WeightPtr& error) {
    if (needs_error(input.elliptic) && error == nullptr) {
        return nullptr;
    }
    const auto shared = [&] { return patch.shared(); };
    switch (input.elliptic.weight) {
    case WeightSource::error:
        return error;
    case WeightSource::expression:
        return weight_of_formula(input, shared(), error);
    case WeightSource::mixed:
        return mixed_weight_of(input, shared(), error);
    case WeightSource::w1:
        return grid::weight_w1();
    case WeightSource::w2:
        return grid::weight_w2(input.nu);
    case WeightSource::w3:
        return grid::weight_w3(input.nu, input.nv);
    case WeightSource::w4:
        return grid::weight_w4();
    }
    return nullptr;
}

grid::WeightPtr region_weight(const GridInput& input, const geometry::ParametricSurface& patch) {
    return input.elliptic.region.everywhere()
               ? nullptr
               : grid::field_weight(grid::share_of(input.elliptic.region, patch), input.nu, input.nv);
}

bool paint_weight(EllipticInput& input,
                  const geometry::ParametricSurface& patch,
                  const Vec2& from,
                  const Vec2& to,
                  const grid::Brush& brush) {
    if (!input.painted) {
        input.painted = grid::Field::constant(fresh_painted, fresh_painted, 0.0);
    }
    return from == to ? grid::dab(*input.painted, patch, from, brush)
                      : grid::stroke(*input.painted, patch, from, to, brush);
}

void let_paint_count(EllipticInput& input) {
    if (input.weight == WeightSource::expression) {
        input.mix.error = 0.0;
        input.mix.expression = std::max(input.mix.expression, 1.0);
    }
    input.weight = WeightSource::mixed;
    if (!(input.mix.painted > 0.0)) {
        input.mix.painted = 1.0;
    }
}

} // namespace millwright::project
