// The four corners with the least distorted harmonic map.
#include "core/base/error.h"
#include "core/region/internal/square_boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace millwright::region {

namespace {

class CornerSearch {
public:
    explicit CornerSearch(const FaceMesh& mesh)
        : mesh_(mesh), lengths_(boundary_lengths(mesh)), solver_(mesh, cotangent_matrix(mesh), true),
          count_(static_cast<int>(mesh.boundary.size())) {}

    SheetCorners run(const Progress& progress) {
        SheetCorners best = sharpest();
        double least = cost(best);
        constexpr int turns = 8; // of evenly placed corners over a quarter of the boundary
        for (int n = 0; n < turns; ++n) {
            progress.check();
            consider(even(static_cast<double>(n) / turns), best, least);
        }
        for (int step = count_ / 16; step >= 1; step /= 2) {
            descend(step, best, least, progress);
        }
        return best;
    }

private:
    /// Places of the boundary in order, none twice.
    [[nodiscard]] bool fits(const SheetCorners& corners) const {
        int sum = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const int gap = (corners[(k + 1) % 4] - corners[k] + count_) % count_;
            if (gap == 0) {
                return false;
            }
            sum += gap;
        }
        return sum == count_;
    }

    [[nodiscard]] double cost(const SheetCorners& corners) const {
        if (!fits(corners)) {
            return std::numeric_limits<double>::infinity();
        }
        const Flattening flat = onto_square(mesh_, solver_, corners, FlatteningMethod::harmonic);
        constexpr double folded = 1e9; // worse than any that does not
        return flat.injective() ? flat.distortion : folded + static_cast<double>(flat.folds.size());
    }

    bool consider(const SheetCorners& corners, SheetCorners& best, double& least) const {
        const double here = cost(corners);
        if (!(here < least)) {
            return false;
        }
        best = corners;
        least = here;
        return true;
    }

    void descend(int step, SheetCorners& best, double& least, const Progress& progress) const {
        constexpr int most_rounds = 8;
        bool better = true;
        for (int round = 0; round < most_rounds && better; ++round) {
            better = false;
            for (std::size_t k = 0; k < 4; ++k) {
                progress.check();
                for (const int sense : {step, count_ - step}) {
                    SheetCorners moved = best;
                    moved[k] = (moved[k] + sense) % count_;
                    better = consider(moved, best, least) || better;
                }
            }
        }
    }

    /// At quarters of the length.
    [[nodiscard]] SheetCorners even(double turn) const {
        SheetCorners corners{};
        for (std::size_t k = 0; k < 4; ++k) {
            const double length = 0.25 * (static_cast<double>(k) + turn) * lengths_.back();
            const auto at = std::ranges::lower_bound(lengths_, length) - lengths_.begin();
            corners[k] = static_cast<int>(at) % count_;
        }
        return corners;
    }

    /// How far the boundary turns at each of its points, rad: pi less the angles of the triangles there.
    [[nodiscard]] std::vector<double> turns() const {
        std::vector<double> angles(mesh_.points.size(), 0.0);
        for (const FaceTriangle& triangle : mesh_.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const auto point = [&](std::size_t n) {
                    return mesh_.points[static_cast<std::size_t>(triangle.corners[n % 3])];
                };
                angles[static_cast<std::size_t>(triangle.corners[k])] +=
                    angle_between(point(k + 1) - point(k), point(k + 2) - point(k));
            }
        }
        std::vector<double> turns;
        for (const int n : mesh_.boundary) {
            turns.push_back(std::numbers::pi - angles[static_cast<std::size_t>(n)]);
        }
        return turns;
    }

    /// The four points where it turns most, not beside each other.
    [[nodiscard]] SheetCorners sharpest() const {
        const double apart = lengths_.back() / 16.0;
        const std::vector<double> turned = turns();
        std::vector<int> order(turned.size());
        for (int n = 0; n < count_; ++n) {
            order[static_cast<std::size_t>(n)] = n;
        }
        std::ranges::stable_sort(order, [&](int a, int b) {
            return turned[static_cast<std::size_t>(a)] > turned[static_cast<std::size_t>(b)];
        });
        std::vector<int> chosen;
        for (const int n : order) {
            const bool near = std::ranges::any_of(chosen, [&](int other) {
                const double way = std::abs(lengths_[static_cast<std::size_t>(n)] -
                                            lengths_[static_cast<std::size_t>(other)]);
                return std::min(way, lengths_.back() - way) < apart;
            });
            if (!near && chosen.size() < 4) {
                chosen.push_back(n);
            }
        }
        if (chosen.size() < 4) {
            return even(0.0);
        }
        std::ranges::sort(chosen);
        return {chosen[0], chosen[1], chosen[2], chosen[3]};
    }

    const FaceMesh& mesh_;
    std::vector<double> lengths_;
    InnerSolver solver_;
    int count_;
};

/// By how many corners to go on, so that the first parameter runs along S_u of the first face.
std::size_t turn_along_first_face(const FaceMesh& mesh, const std::vector<Vec2>& places) {
    Vec2 along = Vec2::Zero(); // where the face's u goes in the square
    for (const FaceTriangle& triangle : mesh.triangles) {
        if (triangle.face != 0) {
            continue;
        }
        const auto n = [&](std::size_t k) { return static_cast<std::size_t>(triangle.corners[k]); };
        const Vec2 a = triangle.parameters[1] - triangle.parameters[0];
        const Vec2 b = triangle.parameters[2] - triangle.parameters[0];
        const Vec2 p = places[n(1)] - places[n(0)], q = places[n(2)] - places[n(0)];
        along += 0.5 * (b.y() * p - a.y() * q);
    }
    if (std::abs(along.x()) >= std::abs(along.y())) {
        return along.x() >= 0.0 ? 0 : 2;
    }
    return along.y() >= 0.0 ? 1 : 3;
}

} // namespace

SheetCorners proposed_corners(const FaceMesh& mesh, const Progress& progress) {
    constexpr std::size_t fewest = 8; // points: corners with something between them
    if (mesh.boundary.size() < fewest) {
        throw Error("the boundary of the faces has too few points to look for corners");
    }
    const SheetCorners found = CornerSearch(mesh).run(progress);
    const std::size_t turn = turn_along_first_face(mesh, harmonic(mesh, found).places);
    SheetCorners turned{};
    for (std::size_t k = 0; k < 4; ++k) {
        turned[k] = found[(k + turn) % 4];
    }
    return turned;
}

} // namespace millwright::region
