#include "core/geometry/surface_bounds.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/geometry/bezier_patch.h"
#include "core/geometry/patch_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace millwright::geometry {

namespace {

using HeightNet = Eigen::ArrayXXd;

/// A part of the patch over a rectangle of its parameters, seen along the direction only.
struct Piece {
    HeightNet weighted; ///< heights times weights
    HeightNet weights;
    Vec2 corner = Vec2::Zero();
    Vec2 size = Vec2::Ones();
    double bound = 0.0; ///< no point of it is higher: of the control points none is

    [[nodiscard]] HeightNet heights() const { return weighted / weights; }
};

Piece whole(const BezierPatch& patch, const Vec3& direction) {
    const ControlNet& net = patch.net();
    Piece piece{HeightNet(net.rows, net.columns), HeightNet(net.rows, net.columns)};
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            piece.weights(i, j) = net.weight(i, j);
            piece.weighted(i, j) = net.weight(i, j) * net.point(i, j).dot(direction);
        }
    }
    piece.bound = piece.heights().maxCoeff();
    return piece;
}

/// Both halves of each column of the net, by de Casteljau.
std::pair<HeightNet, HeightNet> halves(HeightNet net) {
    HeightNet first(net.rows(), net.cols());
    const Eigen::Index last = net.rows() - 1;
    for (Eigen::Index k = 0; k <= last; ++k) {
        first.row(k) = net.row(0);
        for (Eigen::Index i = 0; i < last - k; ++i) {
            net.row(i) = 0.5 * (net.row(i) + net.row(i + 1));
        }
    }
    return {std::move(first), std::move(net)};
}

std::pair<HeightNet, HeightNet> halves(const HeightNet& net, int axis) {
    if (axis == 0) {
        return halves(net);
    }
    auto [first, second] = halves(HeightNet(net.transpose()));
    return {first.transpose(), second.transpose()};
}

std::array<Piece, 2> halves(const Piece& piece, int axis) {
    auto [low, high] = halves(piece.weighted, axis);
    auto [low_weights, high_weights] = halves(piece.weights, axis);
    Vec2 size = piece.size;
    size[axis] *= 0.5;
    Vec2 middle = piece.corner;
    middle[axis] += size[axis];
    std::array<Piece, 2> result{Piece{std::move(low), std::move(low_weights), piece.corner, size},
                                Piece{std::move(high), std::move(high_weights), middle, size}};
    for (Piece& half : result) {
        half.bound = half.heights().maxCoeff();
    }
    return result;
}

double largest_bend(const HeightNet& heights) {
    const Eigen::Index inner = heights.rows() - 2;
    return inner < 1
               ? 0.0
               : (heights.topRows(inner) - 2.0 * heights.middleRows(1, inner) + heights.bottomRows(inner))
                     .abs()
                     .maxCoeff();
}

/// A patch that is bent in neither direction is highest at a corner.
int more_bent_axis(const Piece& piece) {
    const HeightNet heights = piece.heights();
    return largest_bend(heights) >= largest_bend(heights.transpose()) ? 0 : 1;
}

/// The corners are points of the patch.
void raise(FarthestPoint& best, const Piece& piece) {
    for (const int i : {0, 1}) {
        for (const int j : {0, 1}) {
            const Eigen::Index row = i * (piece.weights.rows() - 1);
            const Eigen::Index column = j * (piece.weights.cols() - 1);
            const double height = piece.weighted(row, column) / piece.weights(row, column);
            if (height > best.along) {
                best = {piece.corner + Vec2(i, j).cwiseProduct(piece.size), height};
            }
        }
    }
}

struct LowerBound {
    bool operator()(const Piece& a, const Piece& b) const { return a.bound < b.bound; }
};

} // namespace

// Branch and bound: what may be higher than the highest point found is halved.
FarthestPoint farthest_point(const BezierPatch& patch, const Vec3& direction) {
    constexpr double tolerance = 1e-9; // of the extent of the net
    constexpr int most_halvings = 5'000;
    Piece all = whole(patch, direction);
    const HeightNet heights = all.heights();
    const double near = tolerance * (heights.maxCoeff() - heights.minCoeff());
    FarthestPoint best{Vec2::Zero(), -std::numeric_limits<double>::infinity()};
    raise(best, all);
    std::priority_queue<Piece, std::vector<Piece>, LowerBound> open;
    open.push(std::move(all));
    for (int n = 0; n < most_halvings && !open.empty() && open.top().bound > best.along + near; ++n) {
        const Piece piece = open.top();
        open.pop();
        for (Piece& half : halves(piece, more_bent_axis(piece))) {
            raise(best, half);
            if (half.bound > best.along + near) {
                open.push(std::move(half));
            }
        }
    }
    return best;
}

namespace {

/// No point of the net's hull is nearer: by its box, and by the plane across the way to its middle.
double least_distance(const ControlNet& net, const Box3& box, const Vec3& point) {
    const Vec3 way = box.center() - point;
    const double length = way.norm();
    if (!(length > 0.0)) {
        return 0.0;
    }
    double along = infinity;
    for (const Vec3& control : net.points) {
        along = std::min(along, (control - point).dot(way) / length);
    }
    return std::max(along, box.exteriorDistance(point));
}

/// The four corners of a net are on the surface.
double nearest_corner(const ControlNet& net, const Vec3& point) {
    double nearest = infinity;
    for (const int i : {0, net.rows - 1}) {
        for (const int j : {0, net.columns - 1}) {
            nearest = std::min(nearest, (net.point(i, j) - point).norm());
        }
    }
    return nearest;
}

struct PatchPart {
    double at_least;
    int splits; ///< how often it was split
    BezierPatch patch;

    /// The part with the least bound is the first of a heap.
    friend bool operator<(const PatchPart& a, const PatchPart& b) { return a.at_least > b.at_least; }
};

} // namespace

DistanceBounds distance_bounds(
    const ParametricSurface& surface, const Vec3& point, double found, double tolerance, int most_splits) {
    expects(is_finite(point) && std::isfinite(found) && tolerance > 0.0, "a distance is bounded of a point");
    std::priority_queue<PatchPart> open;
    double at_most = found;
    const auto add = [&](BezierPatch part, int splits) {
        at_most = std::min(at_most, nearest_corner(part.net(), point));
        const double at_least = least_distance(part.net(), part.control_box(), point);
        open.push({at_least, splits, std::move(part)});
    };
    for (SurfacePiece& piece : surface.pieces()) {
        add(std::move(piece.patch), 0);
    }
    for (int n = 0; n < most_splits && open.top().at_least < at_most - tolerance; ++n) {
        const PatchPart part = open.top();
        open.pop();
        auto [first, second] = split(part.patch, part.splits % 2 == 0 ? Parameter::u : Parameter::v, 0.5);
        add(std::move(first), part.splits + 1);
        add(std::move(second), part.splits + 1);
    }
    return {std::clamp(open.top().at_least, 0.0, at_most), at_most};
}

} // namespace millwright::geometry
