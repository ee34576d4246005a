#include "core/exchange/internal/polygon_soup.h"

#include "core/base/counted.h"
#include "core/exchange/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace millwright::exchange {

namespace {

constexpr std::ptrdiff_t most_corners = 1000; // of one face

/// Newell's sum: normal to a polygon that need not be flat.
Vec3 normal_of(const std::vector<Vec3>& points, std::span<const int> corners) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < corners.size(); ++n) {
        const Vec3& a = points[static_cast<std::size_t>(corners[n])];
        const Vec3& b = points[static_cast<std::size_t>(corners[(n + 1) % corners.size()])];
        sum += a.cross(b);
    }
    return sum;
}

class Ears {
public:
    Ears(const std::vector<Vec3>& points, std::span<const int> corners)
        : points_(points), left_(corners.begin(), corners.end()), normal_(normal_of(points, corners)) {}

    /// Two triangles fewer than corners, whatever the polygon.
    [[nodiscard]] std::vector<std::array<int, 3>> triangles() {
        std::vector<std::array<int, 3>> result;
        while (left_.size() > 3) {
            std::size_t ear = 0;
            while (ear + 1 < left_.size() && !is_ear(ear)) {
                ++ear;
            }
            result.push_back({before(ear), left_[ear], after(ear)});
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
        }
        result.push_back({left_[0], left_[1], left_[2]});
        return result;
    }

private:
    [[nodiscard]] int before(std::size_t n) const { return left_[(n + left_.size() - 1) % left_.size()]; }
    [[nodiscard]] int after(std::size_t n) const { return left_[(n + 1) % left_.size()]; }
    [[nodiscard]] const Vec3& at(int corner) const { return points_[static_cast<std::size_t>(corner)]; }
    /// Above 0 where a, b, c turn to the left.
    [[nodiscard]] double turn(const Vec3& a, const Vec3& b, const Vec3& c) const {
        return (b - a).cross(c - a).dot(normal_);
    }
    [[nodiscard]] bool is_ear(std::size_t n) const {
        const Vec3& a = at(before(n));
        const Vec3& b = at(left_[n]);
        const Vec3& c = at(after(n));
        if (!(turn(a, b, c) > 0.0)) {
            return false;
        }
        return std::ranges::none_of(left_, [&](int other) {
            const Vec3& p = at(other);
            const bool own = other == before(n) || other == left_[n] || other == after(n);
            return !own && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
        });
    }

    const std::vector<Vec3>& points_;
    std::vector<int> left_;
    Vec3 normal_;
};

} // namespace

void PolygonSoup::add_point(const Vec3& point, int line) {
    const Vec3 scaled = unit_ * point;
    constexpr double farthest = 1e12; // mm: areas of such triangles are still finite
    if (!is_finite(scaled) || !(scaled.cwiseAbs().maxCoeff() <= farthest)) {
        fail("a corner is not a finite number, or more than a million kilometres away", line);
    }
    mesh_.points.push_back(scaled);
}

void PolygonSoup::add_face(std::span<const int> corners, int line) {
    if (corners.size() < 3) {
        fail(fmt::format("a face has only {}", counted(corners.size(), "corner")), line);
    }
    if (std::ssize(corners) > most_corners) {
        fail(fmt::format("a face has more than {} corners", most_corners), line);
    }
    for (const int corner : corners) {
        if (corner < 0 || corner >= point_count()) {
            fail(
                fmt::format("a face refers to point {}, but there are only {} points", corner, point_count()),
                line);
        }
    }
    if (corners.size() == 3) {
        mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
    } else {
        const auto cut = Ears(mesh_.points, corners).triangles();
        mesh_.triangles.insert(mesh_.triangles.end(), cut.begin(), cut.end());
    }
    if (std::ssize(mesh_.triangles) > most_mesh_triangles) {
        fail(fmt::format("more than {} triangles", most_mesh_triangles),
             line,
             "reduce the mesh in the program that made the file");
    }
}

void PolygonSoup::fail(std::string message, int line, std::string hint) const {
    throw Error(Diagnostic{Place{.file = file_, .line = line}, std::move(message), std::move(hint)});
}

} // namespace millwright::exchange
