#include "core/toolpath/internal/chord_curve.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <algorithm>
#include <cmath>
#include <numeric>
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
    for (std::size_t n = 0; n < packs_.size(); ++n) {
        const std::size_t from = n * lanes, to = std::min(from + lanes, chords);
        packs_[n].middle = points_[std::midpoint(from, to)];
        double farthest = 0.0;
        for (std::size_t k = from; k <= to; ++k) {
            farthest = std::max(farthest, (points_[k] - packs_[n].middle).squaredNorm());
        }
        packs_[n].radius = std::sqrt(farthest);
    }
}

double ChordCurve::Pack::squared_at_least(const Vec3& p) const {
    constexpr double less = 1.0 - 1e-9; // more than rounding takes away
    const double outside = less * (p - middle).norm() - radius;
    return outside > 0.0 ? square(outside) : 0.0;
}

void ChordCurve::look_in(std::size_t pack, const Vec3& p, double& least, std::size_t& chord) const {
    const Pack& of = packs_[pack];
    const Lanes x = p.x() - of.start[0];
    const Lanes y = p.y() - of.start[1];
    const Lanes z = p.z() - of.start[2];
    const Lanes s =
        ((x * of.span[0] + y * of.span[1] + z * of.span[2]) * of.inverse_square).cwiseMax(0.0).cwiseMin(1.0);
    const Lanes squared =
        (x - s * of.span[0]).square() + (y - s * of.span[1]).square() + (z - s * of.span[2]).square();
    const double in_pack = squared.minCoeff();
    const bool earlier = exactly_equal(in_pack, least) && pack * lanes < chord;
    if (in_pack < least || earlier) {
        const auto lane = std::ranges::find(squared, in_pack) - squared.begin();
        least = in_pack;
        chord = pack * lanes + static_cast<std::size_t>(lane);
    }
}

ChordCurve::Nearest ChordCurve::nearest(const Vec3& p) const {
    // The pack whose ball is nearest first: it mostly rules out the others.
    std::size_t first = 0;
    for (std::size_t n = 1; n < packs_.size(); ++n) {
        if ((p - packs_[n].middle).squaredNorm() < (p - packs_[first].middle).squaredNorm()) {
            first = n;
        }
    }
    double least = infinity;
    std::size_t chord = 0;
    look_in(first, p, least, chord);
    for (std::size_t n = 0; n < packs_.size(); ++n) {
        if (n != first && !(packs_[n].squared_at_least(p) > least)) {
            look_in(n, p, least, chord);
        }
    }
    return least < infinity ? on_chord(chord, p) : Nearest{};
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
