#include "core/grid/weight.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/grid/internal/parallel_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace millwright::grid {

namespace {

/// A weight given by two functions of one point.
template <class Value, class Gradient> class PointwiseWeight final : public Weight {
public:
    PointwiseWeight(Value value, Gradient gradient) : value_(value), gradient_(gradient) {}

    void values(std::span<const Vec2> at, std::span<double> w) const override {
        std::ranges::transform(at, w.begin(), value_);
    }
    void gradients(std::span<const Vec2> at, std::span<Vec2> gradient) const override {
        std::ranges::transform(at, gradient.begin(), gradient_);
    }

private:
    Value value_;
    Gradient gradient_;
};

template <class Value, class Gradient> WeightPtr formula(Value value, Gradient gradient) {
    return std::make_shared<PointwiseWeight<Value, Gradient>>(value, gradient);
}

} // namespace

WeightPtr constant_weight(double value) {
    return formula([value](const Vec2&) { return value; }, [](const Vec2&) -> Vec2 { return Vec2::Zero(); });
}

WeightPtr ring_weight(const Ring& ring) {
    const auto value = [ring](const Vec2& p) {
        return std::exp(-std::abs(ring.radius_squared - (p - ring.centre).squaredNorm())) + 0.01;
    };
    const auto gradient = [ring](const Vec2& p) -> Vec2 {
        const double inside = ring.radius_squared - (p - ring.centre).squaredNorm();
        const double falls = inside < 0.0 ? 1.0 : -1.0;
        return -2.0 * falls * std::exp(-std::abs(inside)) * (p - ring.centre);
    };
    return formula(value, gradient);
}

WeightPtr weight_w1() {
    return ring_weight({});
}

WeightPtr weight_w1_on(int side) {
    expects(side >= 2, "a grid has at least 2 x 2 nodes");
    const double scale = 24.0 / (side - 1);
    const WeightPtr w1 = weight_w1();
    const auto value = [w1, scale](const Vec2& p) {
        const Vec2 at = scale * p;
        double w = 0.0;
        w1->values({&at, 1}, {&w, 1});
        return w;
    };
    const auto gradient = [w1, scale](const Vec2& p) -> Vec2 {
        const Vec2 at = scale * p;
        Vec2 found = Vec2::Zero();
        w1->gradients({&at, 1}, {&found, 1});
        return scale * found;
    };
    return formula(value, gradient);
}

WeightPtr weight_w2(int rows) {
    return ring_weight({.centre = {10.0, 10.0}, .radius_squared = 1.0 * rows});
}

WeightPtr weight_w3(int rows, int columns) {
    return ring_weight({.centre = Vec2(rows, columns), .radius_squared = 25.0});
}

WeightPtr weight_w4() {
    constexpr double k = 2.0 * pi / 25.0;
    constexpr double amplitude = 1.0 / 1000.0;
    const auto value = [](const Vec2& p) { return amplitude * std::sin(k * p.x()) * std::sin(k * p.y()); };
    const auto gradient = [](const Vec2& p) -> Vec2 {
        return amplitude * k *
               Vec2(std::cos(k * p.x()) * std::sin(k * p.y()), std::sin(k * p.x()) * std::cos(k * p.y()));
    };
    return formula(value, gradient);
}

WeightPtr weight_w5(double scale) {
    expects(scale > 0.0, "the scale of a weight is positive");
    const auto value = [scale](const Vec2& p) { return std::exp((p / scale).squaredNorm()); };
    const auto gradient = [scale, value](const Vec2& p) -> Vec2 {
        return 2.0 * value(p) / square(scale) * p;
    };
    return formula(value, gradient);
}

std::vector<double> weight_at_nodes(const Weight& weight, const NodeArray& nodes) {
    std::vector<double> w(nodes.nodes.size());
    for_pieces(w.size(), [&](std::size_t first, std::size_t count) {
        weight.values(std::span(nodes.nodes).subspan(first, count), std::span(w).subspan(first, count));
    });
    return w;
}

int count_not_positive(const Weight& weight, const NodeArray& nodes) {
    const std::vector<double> w = weight_at_nodes(weight, nodes);
    return static_cast<int>(std::ranges::count_if(w, [](double value) { return !(value > 0.0); }));
}

namespace {

constexpr int error_samples_per_cell = 2;       // samples of the raster in a uniform cell
constexpr double inside_triangle = -1e-9;       // barycentric, so that an edge belongs to both its triangles
constexpr double shortest_move_squared = 1e-12; // of a uniform cell; shorter ones have no density

/// Values on a uniform raster, blended by quadratic B-splines: never outside the range of its samples.
class RasterWeight final : public Weight {
public:
    RasterWeight(int rows, int columns, std::vector<double> samples)
        : rows_(rows), columns_(columns), samples_(std::move(samples)) {}

    void values(std::span<const Vec2> at, std::span<double> w) const override {
        std::ranges::transform(at, w.begin(), [this](const Vec2& p) { return blend(p, value_of, value_of); });
    }
    void gradients(std::span<const Vec2> at, std::span<Vec2> gradient) const override {
        std::ranges::transform(at, gradient.begin(), [this](const Vec2& p) -> Vec2 {
            return error_samples_per_cell * Vec2(blend(p, slope_of, value_of), blend(p, value_of, slope_of));
        });
    }

private:
    using Three = std::array<double, 3>;

    /// Weights of the samples before, at and after the nearest one, at distance t from it.
    static Three value_of(double t) { return {square(0.5 - t) / 2.0, 0.75 - t * t, square(0.5 + t) / 2.0}; }
    static Three slope_of(double t) { return {t - 0.5, -2.0 * t, t + 0.5}; }

    struct Nearest {
        int index;
        double away;
    };
    static Nearest nearest(double coordinate, int count) {
        const double place =
            std::clamp(coordinate * error_samples_per_cell, 0.0, static_cast<double>(count - 1));
        const int index = static_cast<int>(std::lround(place));
        return {index, place - index};
    }

    [[nodiscard]] double blend(const Vec2& p, Three (*along_x)(double), Three (*along_y)(double)) const {
        const Nearest row = nearest(p.x(), rows_);
        const Nearest column = nearest(p.y(), columns_);
        const Three x = along_x(row.away);
        const Three y = along_y(column.away);
        double sum = 0.0;
        for (int a = -1; a <= 1; ++a) {
            for (int b = -1; b <= 1; ++b) {
                const int i = std::clamp(row.index + a, 0, rows_ - 1);
                const int j = std::clamp(column.index + b, 0, columns_ - 1);
                sum += x[static_cast<std::size_t>(a + 1)] * y[static_cast<std::size_t>(b + 1)] *
                       samples_[static_cast<std::size_t>(i * columns_ + j)];
            }
        }
        return sum;
    }

    int rows_;
    int columns_;
    std::vector<double> samples_;
};

/// A raster that triangles with values at their corners are painted on.
struct Canvas {
    int rows;
    int columns;
    std::vector<double> samples;

    Canvas(int rows_, int columns_, double background)
        : rows(rows_), columns(columns_),
          samples(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_), background) {}
};

struct Painted {
    Vec2 at;
    double value;
};

void paint(Canvas& canvas, const Painted& a, const Painted& b, const Painted& c) {
    const double area = cross(b.at - a.at, c.at - a.at);
    if (!(area > 0.0)) {
        return;
    }
    const Vec2 low = a.at.cwiseMin(b.at).cwiseMin(c.at) * error_samples_per_cell;
    const Vec2 high = a.at.cwiseMax(b.at).cwiseMax(c.at) * error_samples_per_cell;
    const auto first = [](double edge) { return std::max(0, static_cast<int>(std::floor(edge))); };
    const auto last = [](double edge, int count) {
        return std::min(count - 1, static_cast<int>(std::ceil(edge)));
    };
    for (int i = first(low.x()); i <= last(high.x(), canvas.rows); ++i) {
        for (int j = first(low.y()); j <= last(high.y(), canvas.columns); ++j) {
            const Vec2 p = Vec2(i, j) / error_samples_per_cell;
            const double of_b = cross(p - a.at, c.at - a.at) / area;
            const double of_c = cross(b.at - a.at, p - a.at) / area;
            const double of_a = 1.0 - of_b - of_c;
            if (std::min({of_a, of_b, of_c}) >= inside_triangle) {
                const auto k = static_cast<std::size_t>(i * canvas.columns + j);
                const double value = of_a * a.value + of_b * b.value + of_c * c.value;
                canvas.samples[k] = std::clamp(
                    value, std::min({a.value, b.value, c.value}), std::max({a.value, b.value, c.value}));
            }
        }
    }
}

double density_of(const MoveError& move, const Vec2& step) {
    const double h2 = step.squaredNorm();
    return h2 > shortest_move_squared && move.tip > no_error ? move.tip / h2 : 0.0;
}

} // namespace

NodeArray to_solver_coordinates(const NodeArray& parameters) {
    NodeArray array = parameters;
    const Vec2 cells(array.rows - 1, array.columns - 1);
    for (Vec2& p : array.nodes) {
        p = p.cwiseProduct(cells).eval();
    }
    return array;
}

NodeArray to_parameters(const NodeArray& in_solver_coordinates) {
    NodeArray array = in_solver_coordinates;
    const Vec2 cells(array.rows - 1, array.columns - 1);
    for (Vec2& p : array.nodes) {
        p = p.cwiseQuotient(cells).eval();
    }
    return array;
}

std::vector<double>
error_density(const Grid& grid, TrackDirection direction, std::span<const MoveError> moves) {
    const int tracks = grid.track_count(direction);
    const int per_track = grid.nodes_per_track(direction);
    expects(std::ssize(moves) == static_cast<std::ptrdiff_t>(tracks) * (per_track - 1),
            "there is an error for each move inside the tracks");
    const Vec2 cells(grid.nu() - 1, grid.nv() - 1);
    std::vector<double> density(grid.array().nodes.size(), 0.0);
    const auto index = [&](int t, int k) {
        return direction == TrackDirection::along_v ? grid.array().index(t, k) : grid.array().index(k, t);
    };
    for (int t = 0; t < tracks; ++t) {
        for (int k = 0; k + 1 < per_track; ++k) {
            const MoveError& move =
                moves[static_cast<std::size_t>(t) * static_cast<std::size_t>(per_track - 1) +
                      static_cast<std::size_t>(k)];
            const Vec2 step =
                (grid.track_node(direction, t, k + 1) - grid.track_node(direction, t, k)).cwiseProduct(cells);
            const double here = density_of(move, step);
            density[index(t, k)] = std::max(density[index(t, k)], here);
            density[index(t, k + 1)] = std::max(density[index(t, k + 1)], here);
        }
    }
    double worst = 0.0;
    for (const double d : density) {
        worst = std::isfinite(d) ? std::max(worst, d) : worst;
    }
    std::ranges::replace_if(
        density, [](double d) { return !std::isfinite(d); }, worst);
    return density;
}

std::vector<double> nine_point_average(const std::vector<double>& values, int rows, int columns) {
    std::vector<double> smooth(values.size());
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            double sum = 0.0;
            int count = 0;
            for (int a = std::max(0, i - 1); a <= std::min(rows - 1, i + 1); ++a) {
                for (int b = std::max(0, j - 1); b <= std::min(columns - 1, j + 1); ++b) {
                    sum += values[static_cast<std::size_t>(a * columns + b)];
                    ++count;
                }
            }
            smooth[static_cast<std::size_t>(i * columns + j)] = sum / count;
        }
    }
    return smooth;
}

std::vector<double>
scaled_weight(std::vector<double> density, int rows, int columns, const ErrorWeightSettings& settings) {
    const double largest = *std::ranges::max_element(density);
    if (!(largest > 0.0)) {
        return std::vector<double>(density.size(), 1.0);
    }
    for (double& d : density) {
        d = std::pow(d / largest, settings.exponent);
    }
    for (int pass = 0; pass < settings.smoothing_passes; ++pass) {
        density = nine_point_average(density, rows, columns);
    }
    for (double& d : density) {
        d += settings.floor;
    }
    return density;
}

WeightPtr weight_on(const Grid& grid, std::span<const double> w) {
    const NodeArray nodes = to_solver_coordinates(grid.array());
    expects(w.size() == nodes.nodes.size(), "every node has a weight");
    Canvas canvas(error_samples_per_cell * (nodes.rows - 1) + 1,
                  error_samples_per_cell * (nodes.columns - 1) + 1,
                  *std::ranges::min_element(w));
    const auto corner = [&](int i, int j) { return Painted{nodes.at(i, j), w[nodes.index(i, j)]}; };
    for (int i = 0; i + 1 < nodes.rows; ++i) {
        for (int j = 0; j + 1 < nodes.columns; ++j) {
            paint(canvas, corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
            paint(canvas, corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
        }
    }
    return std::make_shared<RasterWeight>(canvas.rows, canvas.columns, std::move(canvas.samples));
}

std::size_t raster_bytes(int rows, int columns) {
    return (static_cast<std::size_t>(rows) * error_samples_per_cell) *
           (static_cast<std::size_t>(columns) * error_samples_per_cell) * sizeof(double);
}

} // namespace millwright::grid
