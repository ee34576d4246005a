#include "core/grid/weight_mix.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/geometry/surface_point.h"
#include "core/grid/weight.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::grid {

namespace {

constexpr int mix_samples_per_cell = 2; // samples of the raster in a cell of the uniform grid
constexpr double error_exponent = 0.7;  // of the error density, as in ErrorWeightSettings

/// A raster over the parameters, fine enough for the cells of a grid.
Field raster_of(int nu, int nv) {
    return Field::constant(mix_samples_per_cell * (nu - 1) + 1, mix_samples_per_cell * (nv - 1) + 1, 0.0);
}

std::vector<Vec2> raster_places(const Field& raster, int nu, int nv) {
    std::vector<Vec2> places;
    places.reserve(raster.values.size());
    for (int i = 0; i < raster.rows; ++i) {
        for (int j = 0; j < raster.columns; ++j) {
            places.push_back(raster.place(i, j).cwiseProduct(Vec2(nu - 1, nv - 1)));
        }
    }
    return places;
}

/// The raster as a weight whose slope is continuous.
WeightPtr weight_of(const Field& raster, int nu, int nv) {
    class Spread final : public Weight { // from solver coordinates of the grid to those of the raster
    public:
        Spread(WeightPtr on_raster, Vec2 scale)
            : on_raster_(std::move(on_raster)), scale_(std::move(scale)) {}
        void values(std::span<const Vec2> at, std::span<double> w) const override {
            on_raster_->values(scaled(at), w);
        }
        void gradients(std::span<const Vec2> at, std::span<Vec2> gradient) const override {
            on_raster_->gradients(scaled(at), gradient);
            for (Vec2& slope : gradient) {
                slope = slope.cwiseProduct(scale_).eval();
            }
        }

    private:
        [[nodiscard]] std::vector<Vec2> scaled(std::span<const Vec2> at) const {
            std::vector<Vec2> there(at.begin(), at.end());
            for (Vec2& p : there) {
                p = p.cwiseProduct(scale_).eval();
            }
            return there;
        }

        WeightPtr on_raster_;
        Vec2 scale_;
    };
    const Vec2 scale(static_cast<double>(raster.rows - 1) / (nu - 1),
                     static_cast<double>(raster.columns - 1) / (nv - 1));
    return std::make_shared<Spread>(weight_on(Grid::uniform(raster.rows, raster.columns), raster.values),
                                    scale);
}

void divide_by_largest(std::vector<double>& values) {
    const double largest = *std::ranges::max_element(values);
    if (largest > 0.0) {
        for (double& value : values) {
            value /= largest;
        }
    }
}

double combined_weight(Combination how, double so_far, double share_of_value) {
    switch (how) {
    case Combination::product:
        return so_far * (1.0 + share_of_value);
    case Combination::largest:
        return std::max(so_far, share_of_value);
    case Combination::sum:
        break;
    }
    return so_far + share_of_value;
}

/// Distance from the middle of the brush, as a share of its radius, to how much of its strength is left.
double fading(double share_of_radius, double hardness) {
    if (share_of_radius >= 1.0) {
        return 0.0;
    }
    if (share_of_radius <= hardness) {
        return 1.0;
    }
    const double t = (1.0 - share_of_radius) / (1.0 - hardness);
    return t * t * (3.0 - 2.0 * t);
}

/// As fine as anyone paints, and short in a file.
double in_steps(double value) {
    constexpr double steps = 1000.0;
    return std::round(value * steps) / steps;
}

void expects_valid_mix(const MixSettings& settings) {
    expects(settings.error >= 0.0 && settings.curvature >= 0.0 && settings.painted >= 0.0 &&
                settings.expression >= 0.0,
            "shares are not negative");
    expects(settings.low > 0.0 && settings.high >= settings.low && std::isfinite(settings.high),
            "the range of a weight is positive and in order");
    expects(settings.smoothing_passes >= 0, "passes are not negative");
}

} // namespace

Field Field::constant(int rows, int columns, double value) {
    expects(rows >= 2 && columns >= 2, "a field has at least 2 x 2 values");
    return {rows,
            columns,
            std::vector<double>(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns), value)};
}

double Field::at(const Vec2& uv) const {
    const auto place_in = [](double share, int count) { return std::clamp(share, 0.0, 1.0) * (count - 1); };
    const double x = place_in(uv.x(), rows);
    const double y = place_in(uv.y(), columns);
    const int i = std::min(static_cast<int>(x), rows - 2);
    const int j = std::min(static_cast<int>(y), columns - 2);
    return mix(mix(values[index(i, j)], values[index(i, j + 1)], y - j),
               mix(values[index(i + 1, j)], values[index(i + 1, j + 1)], y - j),
               x - i);
}

WeightPtr mixed_weight(const MixedReasons& reasons, const MixSettings& settings, int nu, int nv) {
    expects_valid_mix(settings);
    Field raster = raster_of(nu, nv);
    const std::vector<Vec2> places = raster_places(raster, nu, nv);
    std::ranges::fill(raster.values, settings.combination == Combination::product ? 1.0 : 0.0);
    std::vector<double> found(places.size());
    const auto add = [&](const WeightPtr& reason, double share, bool is_error) {
        if (!(share > 0.0)) {
            return;
        }
        expects(reason != nullptr, "every contribution with a share is given");
        reason->values(places, found);
        if (is_error) {
            divide_by_largest(found);
        }
        for (std::size_t k = 0; k < found.size(); ++k) {
            const double value = is_error ? std::pow(std::max(0.0, found[k]), error_exponent) : found[k];
            raster.values[k] = combined_weight(settings.combination, raster.values[k], share * value);
        }
    };
    add(reasons.error, settings.error, true);
    add(reasons.curvature, settings.curvature, false);
    add(reasons.painted, settings.painted, false);
    add(reasons.expression, settings.expression, false);
    for (int pass = 0; pass < settings.smoothing_passes; ++pass) {
        raster.values = nine_point_average(raster.values, raster.rows, raster.columns);
    }
    for (double& w : raster.values) {
        w = std::clamp(w, settings.low, settings.high);
    }
    return weight_of(raster, nu, nv);
}

WeightPtr curvature_weight(const geometry::ParametricSurface& patch, int nu, int nv) {
    Field raster = raster_of(nu, nv);
    double largest = 0.0;
    for (int i = 0; i < raster.rows; ++i) {
        for (int j = 0; j < raster.columns; ++j) {
            const Vec2 uv = raster.place(i, j);
            const auto bent = geometry::principal_curvatures(patch.derivatives(uv.x(), uv.y()));
            double& here = raster.values[raster.index(i, j)];
            here = bent ? std::hypot(bent->k1, bent->k2) : std::numeric_limits<double>::infinity();
            largest = std::isfinite(here) ? std::max(largest, here) : largest;
        }
    }
    for (double& here : raster.values) {
        here = largest > 0.0 ? std::min(here, largest) / largest : 0.0;
    }
    return weight_of(raster, nu, nv);
}

WeightPtr field_weight(const Field& field, int nu, int nv) {
    expects(std::ssize(field.values) == static_cast<std::ptrdiff_t>(field.rows) * field.columns &&
                field.rows >= 2 && field.columns >= 2,
            "a field has rows x columns values");
    return weight_of(field, nu, nv);
}

bool dab(Field& field, const geometry::ParametricSurface& patch, const Vec2& uv, const Brush& brush) {
    expects(brush.radius_mm > 0.0 && brush.hardness >= 0.0 && brush.hardness <= 1.0,
            "a brush has a positive radius and a hardness from 0 to 1");
    const Vec3 middle = patch.position(uv.x(), uv.y());
    bool changed = false;
    for (int i = 0; i < field.rows; ++i) {
        for (int j = 0; j < field.columns; ++j) {
            const Vec2 there = field.place(i, j);
            const double away = (patch.position(there.x(), there.y()) - middle).norm();
            const double share = brush.strength * fading(away / brush.radius_mm, brush.hardness);
            double& value = field.values[field.index(i, j)];
            const double painted = share > 0.0 ? in_steps(mix(value, brush.value, share)) : value;
            changed = changed || !exactly_equal(painted, value);
            value = painted;
        }
    }
    return changed;
}

bool stroke(Field& field,
            const geometry::ParametricSurface& patch,
            const Vec2& from,
            const Vec2& to,
            const Brush& brush) {
    const double length = (patch.position(to.x(), to.y()) - patch.position(from.x(), from.y())).norm();
    constexpr double dabs_per_radius = 4.0;
    constexpr double most_dabs = 1000.0;
    const int dabs =
        static_cast<int>(std::clamp(std::ceil(dabs_per_radius * length / brush.radius_mm), 1.0, most_dabs));
    bool changed = false;
    for (int k = 1; k <= dabs; ++k) {
        const double t = static_cast<double>(k) / dabs;
        changed = dab(field, patch, Vec2((1.0 - t) * from + t * to), brush) || changed;
    }
    return changed;
}

} // namespace millwright::grid
