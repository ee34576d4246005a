#include "core/exchange/grid_surface.h"

#include "core/base/error.h"
#include "core/geometry/bezier_patch.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace millwright::exchange {

namespace {

using geometry::ControlNet;

/// One coordinate of all points, [rows x columns].
using Coordinates = std::array<Eigen::MatrixXd, 3>;

/// How a curve through points at parameters is made: knots, and where its spans are.
struct SplineBasis {
    int degree = 1;
    std::vector<double> parameters; ///< of the points, 0 ... 1
    std::vector<double> knots;      ///< clamped

    [[nodiscard]] int span_count() const { return static_cast<int>(parameters.size()) - degree; }
    /// Of the knots, the last one that begins span `n`.
    [[nodiscard]] int knot_of(int n) const { return degree + n; }
};

double knot(const SplineBasis& basis, int n) {
    return basis.knots[static_cast<std::size_t>(n)];
}

/// What the blossom of a span is of its degree + 1 control points, at `degree` arguments.
Eigen::RowVectorXd blossom(const SplineBasis& basis, int span, const std::vector<double>& arguments) {
    const int p = basis.degree;
    const int s = basis.knot_of(span);
    Eigen::MatrixXd shares = Eigen::MatrixXd::Identity(p + 1, p + 1); // row j: of the j-th point
    for (int r = 1; r <= p; ++r) {
        const double t = arguments[static_cast<std::size_t>(r - 1)];
        for (int j = p; j >= r; --j) {
            const double low = knot(basis, j + s - p);
            const double share = (t - low) / (knot(basis, j + 1 + s - r) - low);
            shares.row(j) = ((1.0 - share) * shares.row(j - 1) + share * shares.row(j)).eval();
        }
    }
    return shares.row(p);
}

/// A9.3: shares of the chord length along each curve, averaged over the curves that have one. `step`: the
/// length between points n and n + 1 of a curve.
template <class Step> std::vector<double> averaged_parameters(int points, int curves, const Step& step) {
    std::vector<double> sum(static_cast<std::size_t>(points), 0.0);
    int counted_curves = 0;
    for (int curve = 0; curve < curves; ++curve) {
        std::vector<double> along(static_cast<std::size_t>(points), 0.0);
        for (int n = 1; n < points; ++n) {
            along[static_cast<std::size_t>(n)] = along[static_cast<std::size_t>(n - 1)] + step(curve, n - 1);
        }
        if (!(along.back() > 0.0)) {
            continue; // all in one place: the pole of a cap
        }
        ++counted_curves;
        for (std::size_t n = 0; n < along.size(); ++n) {
            sum[n] += along[n] / along.back();
        }
    }
    for (double& value : sum) {
        value /= std::max(counted_curves, 1);
    }
    sum.front() = 0.0;
    sum.back() = counted_curves > 0 ? 1.0 : 0.0;
    return sum;
}

/// Equation 9.8: knots are averages of as many parameters as the degree.
SplineBasis basis_over(std::vector<double> parameters) {
    const int points = static_cast<int>(parameters.size());
    SplineBasis basis;
    basis.degree = points <= most_points_of_one_span ? points - 1 : 3;
    basis.knots.assign(static_cast<std::size_t>(basis.degree) + 1, 0.0);
    for (int j = 1; j < points - basis.degree; ++j) {
        double sum = 0.0;
        for (int i = j; i < j + basis.degree; ++i) {
            sum += parameters[static_cast<std::size_t>(i)];
        }
        basis.knots.push_back(sum / basis.degree);
    }
    basis.knots.insert(basis.knots.end(), static_cast<std::size_t>(basis.degree) + 1, 1.0);
    basis.parameters = std::move(parameters);
    return basis;
}

int span_at(const SplineBasis& basis, double parameter) {
    int span = 0;
    while (span + 1 < basis.span_count() && parameter >= knot(basis, basis.knot_of(span + 1))) {
        ++span;
    }
    return span;
}

/// The basis functions at the parameters of the points, [points x points].
Eigen::MatrixXd collocation(const SplineBasis& basis) {
    const auto points = static_cast<Eigen::Index>(basis.parameters.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(points, points);
    for (Eigen::Index n = 0; n < points; ++n) {
        const double at = basis.parameters[static_cast<std::size_t>(n)];
        const int span = span_at(basis, at);
        matrix.block(n, span, 1, basis.degree + 1) =
            blossom(basis, span, std::vector<double>(static_cast<std::size_t>(basis.degree), at));
    }
    return matrix;
}

/// The Bezier points of a span of its degree + 1 control points, [degree + 1 x degree + 1].
Eigen::MatrixXd bezier_of_span(const SplineBasis& basis, int span) {
    const int p = basis.degree;
    const double begin = knot(basis, basis.knot_of(span)), end = knot(basis, basis.knot_of(span) + 1);
    Eigen::MatrixXd matrix(p + 1, p + 1);
    for (int k = 0; k <= p; ++k) {
        std::vector<double> arguments(static_cast<std::size_t>(p), begin);
        std::fill_n(arguments.begin(), k, end);
        matrix.row(k) = blossom(basis, span, arguments);
    }
    return matrix;
}

/// The control points whose curve or surface goes through `points`; once more with what rounding has left.
Coordinates control_points(const SplineBasis& u, const SplineBasis& v, const Coordinates& points) {
    const Eigen::MatrixXd nu = collocation(u), nv = collocation(v);
    const Eigen::PartialPivLU<Eigen::MatrixXd> of_u(nu), of_v(nv);
    const auto solved = [&](const Eigen::MatrixXd& right) -> Eigen::MatrixXd {
        const Eigen::MatrixXd half = of_u.solve(right);
        return of_v.solve(half.transpose()).transpose();
    };
    Coordinates net;
    for (std::size_t axis = 0; axis < net.size(); ++axis) {
        net[axis] = solved(points[axis]);
        const Eigen::MatrixXd left = points[axis] - nu * net[axis] * nv.transpose();
        net[axis] += solved(left);
    }
    return net;
}

Coordinates coordinates_of(const PointGrid& grid) {
    Coordinates result;
    for (std::size_t axis = 0; axis < result.size(); ++axis) {
        result[axis].resize(grid.rows, grid.columns);
        for (int i = 0; i < grid.rows; ++i) {
            for (int j = 0; j < grid.columns; ++j) {
                result[axis](i, j) = grid.at(i, j)[static_cast<Eigen::Index>(axis)];
            }
        }
    }
    return result;
}

/// Sum of the normals of the meshes between the points; its length is no measure.
Vec3 mean_normal(const PointGrid& grid) {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i + 1 < grid.rows; ++i) {
        for (int j = 0; j + 1 < grid.columns; ++j) {
            sum += (grid.at(i + 1, j + 1) - grid.at(i, j)).cross(grid.at(i, j + 1) - grid.at(i + 1, j));
        }
    }
    return sum;
}

/// Turns the rows round where S_u x S_v would look the other way.
void face_along(PointGrid& grid, const std::optional<Vec3>& along) {
    constexpr double upright = 1e-6; // cosine
    const Vec3 normal = mean_normal(grid);
    const auto looks = [&](const Vec3& way) { return normal.dot(way) / std::max(normal.norm(), 1e-300); };
    double side = 0.0;
    for (const Vec3& way : {Vec3(Vec3::UnitZ()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitX())}) {
        side = std::abs(side) > upright ? side : looks(along.value_or(way));
    }
    if (side >= 0.0) {
        return;
    }
    for (int row = 0; row < grid.rows; ++row) {
        const std::ptrdiff_t begin = std::ptrdiff_t{row} * grid.columns;
        std::reverse(grid.points.begin() + begin, grid.points.begin() + begin + grid.columns);
        std::reverse(grid.lines.begin() + begin, grid.lines.begin() + begin + grid.columns);
    }
}

SplineBasis basis_across(const PointGrid& grid) {
    return basis_over(averaged_parameters(grid.rows, grid.columns, [&](int column, int row) {
        return (grid.at(row + 1, column) - grid.at(row, column)).norm();
    }));
}

SplineBasis basis_along(const PointGrid& grid) {
    return basis_over(averaged_parameters(grid.columns, grid.rows, [&](int row, int column) {
        return (grid.at(row, column + 1) - grid.at(row, column)).norm();
    }));
}

geometry::BezierPatch patch_of(
    const Coordinates& net, const Eigen::MatrixXd& of_u, const Eigen::MatrixXd& of_v, int row, int column) {
    ControlNet result = ControlNet::sized(static_cast<int>(of_u.rows()), static_cast<int>(of_v.rows()));
    for (std::size_t axis = 0; axis < net.size(); ++axis) {
        const Eigen::MatrixXd points =
            of_u * net[axis].block(row, column, of_u.cols(), of_v.cols()) * of_v.transpose();
        for (int i = 0; i < result.rows; ++i) {
            for (int j = 0; j < result.columns; ++j) {
                result.point(i, j)[static_cast<Eigen::Index>(axis)] = points(i, j);
            }
        }
    }
    return geometry::BezierPatch(std::move(result));
}

std::vector<Eigen::MatrixXd> beziers_of(const SplineBasis& basis) {
    std::vector<Eigen::MatrixXd> result;
    for (int span = 0; span < basis.span_count(); ++span) {
        result.push_back(bezier_of_span(basis, span));
    }
    return result;
}

/// The span that a parameter is in, and the share of it that is behind.
double place_on(const SplineBasis& basis, double parameter) {
    const int span = span_at(basis, parameter);
    const double begin = knot(basis, basis.knot_of(span)), end = knot(basis, basis.knot_of(span) + 1);
    return span + (parameter - begin) / (end - begin);
}

std::vector<Vec2> places_on(const SplineBasis& u, const SplineBasis& v) {
    std::vector<Vec2> places;
    for (const double at_u : u.parameters) {
        for (const double at_v : v.parameters) {
            places.emplace_back(place_on(u, at_u), place_on(v, at_v));
        }
    }
    return places;
}

void check_places(const SplineBasis& u, const SplineBasis& v) {
    for (const auto& [basis, name] : {std::pair(&u, "column"), std::pair(&v, "row")}) {
        for (std::size_t n = 1; n < basis->parameters.size(); ++n) {
            if (!(basis->parameters[n] > basis->parameters[n - 1])) {
                throw Error(
                    fmt::format("in every {0}, points {1} and {2} coincide: no surface can pass through them",
                                name,
                                n,
                                n + 1));
            }
        }
    }
    if (std::ptrdiff_t{u.span_count()} * v.span_count() > most_cad_patches) {
        throw Error(fmt::format("{} x {} patches are too many, at most {} are possible",
                                u.span_count(),
                                v.span_count(),
                                most_cad_patches),
                    {},
                    "leave out rows, or fit the points as a cloud");
    }
}

/// All spans as one surface.
geometry::BsplineNet bspline_of(const SplineBasis& u, const SplineBasis& v, const Coordinates& net) {
    geometry::BsplineNet result;
    result.degree_u = u.degree;
    result.degree_v = v.degree;
    result.knots_u = u.knots;
    result.knots_v = v.knots;
    result.rows = static_cast<int>(u.parameters.size());
    result.columns = static_cast<int>(v.parameters.size());
    for (int i = 0; i < result.rows; ++i) {
        for (int j = 0; j < result.columns; ++j) {
            result.points.emplace_back(net[0](i, j), net[1](i, j), net[2](i, j));
        }
    }
    result.weights.assign(result.points.size(), 1.0);
    return result;
}

Box3 box_of_patches(const CadFace& face) {
    constexpr int steps = 4;
    Box3 box;
    for (const geometry::BezierPatch& patch : face.patches) {
        for (int n = 0; n < (steps + 1) * (steps + 1); ++n) {
            box.extend(patch.position(static_cast<double>(n / (steps + 1)) / steps,
                                      static_cast<double>(n % (steps + 1)) / steps));
        }
    }
    return box;
}

} // namespace

GridSurface surface_through(PointGrid grid, const std::optional<Vec3>& along, const Progress& progress) {
    expects(grid.rows >= 2 && grid.columns >= 2 &&
                std::ssize(grid.points) == std::ptrdiff_t{grid.rows} * grid.columns,
            "two rows and columns at least, a point at each place");
    const int most = std::max(grid.rows, grid.columns);
    if (most > most_interpolated_points) {
        throw Error(
            fmt::format("{} points along a row or across the rows are too many, at most {} are possible",
                        most,
                        most_interpolated_points),
            {},
            "leave out points, or fit them as a cloud");
    }
    progress.report(0.0, "computing the surface through the points");
    face_along(grid, along);
    const SplineBasis u = basis_across(grid), v = basis_along(grid);
    check_places(u, v);
    const Coordinates net = control_points(u, v, coordinates_of(grid));
    progress.check();
    const std::vector<Eigen::MatrixXd> of_u = beziers_of(u), of_v = beziers_of(v);
    GridSurface made;
    made.face.rows = u.span_count();
    made.face.columns = v.span_count();
    for (int row = 0; row < made.face.rows; ++row) {
        progress.check();
        for (int column = 0; column < made.face.columns; ++column) {
            made.face.patches.push_back(patch_of(net,
                                                 of_u[static_cast<std::size_t>(row)],
                                                 of_v[static_cast<std::size_t>(column)],
                                                 row,
                                                 column));
        }
    }
    if (made.face.patches.size() > 1) {
        made.face.bspline = bspline_of(u, v, net);
    }
    made.face.box = box_of_patches(made.face);
    made.grid = std::move(grid);
    made.places = places_on(u, v);
    return made;
}

} // namespace millwright::exchange
