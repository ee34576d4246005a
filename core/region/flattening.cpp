#include "core/region/flattening.h"

#include "core/base/error.h"
#include "core/region/internal/side_welding.h"
#include "core/region/internal/square_boundary.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::region {

std::string_view name_of(FlatteningMethod method) {
    switch (method) {
    case FlatteningMethod::own_parameters:
        return "own parameters";
    case FlatteningMethod::harmonic:
        return "harmonic";
    case FlatteningMethod::mean_value:
        return "mean value";
    case FlatteningMethod::conformal:
        return "conformal";
    }
    throw Defect("no such way to flatten");
}

SheetCorners corners_near(const FaceMesh& mesh, const std::array<Vec3, 4>& places) {
    SheetCorners corners{};
    for (std::size_t k = 0; k < 4; ++k) {
        expects(is_finite(places[k]), "a corner is a finite place");
        const auto away = [&](int n) {
            return (mesh.points[static_cast<std::size_t>(n)] - places[k]).norm();
        };
        const auto nearest = std::ranges::min_element(mesh.boundary, {}, away);
        corners[k] = static_cast<int>(nearest - mesh.boundary.begin());
    }
    const int first = corners[0], count = static_cast<int>(mesh.boundary.size());
    std::ranges::sort(corners, {}, [&](int n) { return (n - first + count) % count; });
    if (const auto twice = std::ranges::adjacent_find(corners); twice != corners.end()) {
        const int point = mesh.boundary[static_cast<std::size_t>(*twice)];
        throw Error("two corners are the same point of the boundary, at " +
                        place_text(mesh.points[static_cast<std::size_t>(point)]),
                    {},
                    "move one of them along the boundary");
    }
    return corners;
}

Flattening harmonic(const FaceMesh& mesh, const SheetCorners& corners) {
    const InnerSolver solver(mesh, cotangent_matrix(mesh), true);
    return onto_square(mesh, solver, corners, FlatteningMethod::harmonic);
}

Flattening mean_value(const FaceMesh& mesh, const SheetCorners& corners) {
    const InnerSolver solver(mesh, mean_value_matrix(mesh), false);
    return onto_square(mesh, solver, corners, FlatteningMethod::mean_value);
}

Flattening flattened(std::span<const ExactFace> faces,
                     const FaceMesh& mesh,
                     const std::optional<SheetCorners>& corners,
                     const Progress& progress) {
    if (!corners) {
        if (auto own = own_parameters(faces, mesh); own && own->injective()) {
            return std::move(*own);
        }
    }
    const SheetCorners chosen = corners ? *corners : proposed_corners(mesh, progress.part(0.0, 0.8));
    progress.check();
    Flattening best = harmonic(mesh, chosen);
    if (!best.injective()) {
        progress.check();
        best = mean_value(mesh, chosen);
    }
    if (!best.injective()) {
        throw Error(
            fmt::format("the faces fold in {} places when they are spread out on a square, the first at {}",
                        best.folds.size(),
                        place_text(best.folds.front())),
            {},
            "choose other corners, or fewer faces");
    }
    return best;
}

} // namespace millwright::region
