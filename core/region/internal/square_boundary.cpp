#include "core/region/internal/square_boundary.h"

#include "core/base/error.h"
#include "core/region/internal/distortion.h"

#include <array>
#include <vector>

namespace millwright::region {

std::vector<double> boundary_lengths(const FaceMesh& mesh) {
    std::vector<double> lengths{0.0};
    const auto point = [&](std::size_t n) {
        return mesh.points[static_cast<std::size_t>(mesh.boundary[n % mesh.boundary.size()])];
    };
    for (std::size_t n = 0; n < mesh.boundary.size(); ++n) {
        lengths.push_back(lengths.back() + (point(n + 1) - point(n)).norm());
    }
    return lengths;
}

std::vector<Vec2> square_boundary(const std::vector<double>& lengths, const SheetCorners& corners) {
    constexpr std::array<std::array<double, 2>, 4> starts{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const int count = static_cast<int>(lengths.size()) - 1;
    std::vector<Vec2> places(static_cast<std::size_t>(count));
    int run_through = 0;
    for (std::size_t side = 0; side < 4; ++side) {
        const int from = corners[side], to = corners[(side + 1) % 4];
        expects(from >= 0 && from < count && from != to, "a corner is a point of the boundary");
        const int steps = (to - from + count) % count;
        run_through += steps;
        const auto length = [&](int n) {
            const int at = from + n;
            return lengths[static_cast<std::size_t>(at % count)] + (at >= count ? lengths.back() : 0.0);
        };
        const Vec2 start(starts[side][0], starts[side][1]);
        const Vec2 end(starts[(side + 1) % 4][0], starts[(side + 1) % 4][1]);
        for (int n = 0; n < steps; ++n) {
            const double share = (length(n) - length(0)) / (length(steps) - length(0));
            places[static_cast<std::size_t>((from + n) % count)] = start + share * (end - start);
        }
    }
    expects(run_through == count, "the corners follow each other counter-clockwise");
    return places;
}

Flattening onto_square(const FaceMesh& mesh,
                       const InnerSolver& solver,
                       const SheetCorners& corners,
                       FlatteningMethod method) {
    Flattening flat;
    flat.method = method;
    flat.corners = corners;
    flat.places = solver.solve(square_boundary(boundary_lengths(mesh), corners));
    measure(mesh, flat);
    return flat;
}

} // namespace millwright::region
