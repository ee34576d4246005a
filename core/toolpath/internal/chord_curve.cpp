#include "core/toolpath/internal/chord_curve.h"

#include "core/base/error.h"

#include <algorithm>
#include <utility>

namespace millwright::toolpath {

ChordCurve::ChordCurve(std::vector<Vec3> points, std::vector<Vec3> normals)
    : points_(std::move(points)), normals_(std::move(normals)) {
    expects(points_.size() >= 2 && points_.size() == normals_.size(), "a curve has two points or more");
    const std::size_t chords = points_.size() - 1;
    packs_.resize((chords + lanes - 1) / lanes);
    for (std::size_t n = 0; n < packs_.size() * lanes; ++n) {
        Pack& pack = packs_[n / lanes];
        const auto lane = static_cast<std::ptrdiff_t>(n % lanes);
        const Vec3& start = points_[std::min(n, chords)];
        const Vec3 span = points_[std::min(n + 1, chords)] - start;
        const double squared = span.squaredNorm();
        for (int k = 0; k < 3; ++k) {
            pack.start[static_cast<std::size_t>(k)][lane] = start[k];
            pack.span[static_cast<std::size_t>(k)][lane] = span[k];
        }
        pack.inverse_square[lane] = squared > 0.0 ? 1.0 / squared : 0.0;
    }
}

ChordCurve::Nearest ChordCurve::nearest(const Vec3& p) const {
    double least = std::numeric_limits<double>::infinity();
    std::size_t chord = 0;
    for (std::size_t n = 0; n < packs_.size(); ++n) {
        const auto& [start, span, inverse_square] = packs_[n];
        const Lanes x = p.x() - start[0];
        const Lanes y = p.y() - start[1];
        const Lanes z = p.z() - start[2];
        const Lanes s =
            ((x * span[0] + y * span[1] + z * span[2]) * inverse_square).cwiseMax(0.0).cwiseMin(1.0);
        const Lanes squared =
            (x - s * span[0]).square() + (y - s * span[1]).square() + (z - s * span[2]).square();
        if (const double in_pack = squared.minCoeff(); in_pack < least) {
            least = in_pack;
            const auto lane = std::ranges::find(squared, in_pack) - squared.begin();
            chord = n * lanes + static_cast<std::size_t>(lane);
        }
    }
    return least < std::numeric_limits<double>::infinity() ? on_chord(chord, p) : Nearest{};
}

ChordCurve::Nearest ChordCurve::on_chord(std::size_t chord, const Vec3& p) const {
    const std::size_t last = points_.size() - 2;
    const std::size_t n = std::min(chord, last);
    const Vec3& a = points_[n];
    const Vec3 ab = points_[n + 1] - a;
    const double square = ab.squaredNorm();
    const double s = square > 0.0 ? std::clamp((p - a).dot(ab) / square, 0.0, 1.0) : 0.0;
    const Vec3 point = a + s * ab;
    return {(point - p).squaredNorm(), point, (1.0 - s) * normals_[n] + s * normals_[n + 1], n, s};
}

double ChordCurve::squared_beside(const Vec3& p, std::size_t chord) const {
    const std::size_t last = points_.size() - 2;
    std::size_t here = std::min(chord, last);
    double least = on_chord(here, p).squared;
    const auto walk = [&](auto may_go, auto next) {
        while (may_go()) {
            const double there = on_chord(next(), p).squared;
            if (!(there < least)) {
                break;
            }
            least = there;
            here = next();
        }
    };
    walk([&] { return here < last; }, [&] { return here + 1; });
    walk([&] { return here > 0; }, [&] { return here - 1; });
    return least;
}

Vec3 ChordCurve::at(double t) const {
    const double chords = static_cast<double>(points_.size() - 1);
    const auto n = std::min(static_cast<std::size_t>(t * chords), points_.size() - 2);
    const double inside = t * chords - static_cast<double>(n);
    return (1.0 - inside) * points_[n] + inside * points_[n + 1];
}

double ChordCurve::length() const {
    double sum = 0.0;
    for (std::size_t n = 1; n < points_.size(); ++n) {
        sum += (points_[n] - points_[n - 1]).norm();
    }
    return sum;
}

} // namespace millwright::toolpath
