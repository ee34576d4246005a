#include "core/grid/region.h"

#include "core/base/error.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace millwright::grid {

namespace {

constexpr int region_raster =
    129; // places a side: a cell of the field is finer than a border that people draw
constexpr int chords_per_side = 16; // of the outline on the surface

bool on_edge(const Vec2& a, const Vec2& b, const Vec2& p) {
    constexpr double rounding = 1e-9; // of a parameter
    const Vec2 way = b - a;
    const double length = way.squaredNorm();
    const double along = length > 0.0 ? std::clamp((p - a).dot(way) / length, 0.0, 1.0) : 0.0;
    return (a + along * way - p).squaredNorm() <= rounding * rounding;
}

/// What lies on the outline is inside, on whichever side.
bool inside_outline(const std::vector<Vec2>& outline, const Vec2& p) {
    bool in = false;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec2& a = outline[k];
        const Vec2& b = outline[(k + 1) % outline.size()];
        if (on_edge(a, b, p)) {
            return true;
        }
        if ((a.y() > p.y()) != (b.y() > p.y()) &&
            p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
            in = !in;
        }
    }
    return in;
}

/// The outline on the surface, closed.
std::vector<Vec3> chords_of(const std::vector<Vec2>& outline, const geometry::ParametricSurface& patch) {
    std::vector<Vec3> chords;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec2& a = outline[k];
        const Vec2& b = outline[(k + 1) % outline.size()];
        for (int n = 0; n < chords_per_side; ++n) {
            const Vec2 uv = a + static_cast<double>(n) / chords_per_side * (b - a);
            chords.push_back(patch.position(uv.x(), uv.y()));
        }
    }
    chords.push_back(chords.front());
    return chords;
}

double distance_from(const std::vector<Vec3>& chords, const Vec3& point) {
    double squared = std::numeric_limits<double>::infinity();
    for (std::size_t n = 1; n < chords.size(); ++n) {
        const Vec3 way = chords[n] - chords[n - 1];
        const double length = way.squaredNorm();
        const double along =
            length > 0.0 ? std::clamp((point - chords[n - 1]).dot(way) / length, 0.0, 1.0) : 0.0;
        squared = std::min(squared, (chords[n - 1] + along * way - point).squaredNorm());
    }
    return std::sqrt(squared);
}

/// 1 at no distance, 0 from the border on, level at both ends.
double faded(double distance, double border_mm) {
    if (distance >= border_mm) {
        return 0.0;
    }
    const double t = 1.0 - distance / border_mm;
    return t * t * (3.0 - 2.0 * t);
}

class Within final : public Weight {
public:
    Within(WeightPtr weight, WeightPtr share, double outside)
        : weight_(std::move(weight)), share_(std::move(share)), outside_(outside) {}

    void values(std::span<const Vec2> at, std::span<double> w) const override {
        weight_->values(at, w);
        std::vector<double> share(at.size());
        share_->values(at, share);
        for (std::size_t k = 0; k < at.size(); ++k) {
            w[k] = counts_whole(share[k]) ? w[k] : outside_ + share[k] * (w[k] - outside_);
        }
    }
    void gradients(std::span<const Vec2> at, std::span<Vec2> gradient) const override {
        std::vector<double> w(at.size());
        std::vector<double> share(at.size());
        std::vector<Vec2> slope(at.size());
        weight_->values(at, w);
        share_->values(at, share);
        share_->gradients(at, slope);
        weight_->gradients(at, gradient);
        for (std::size_t k = 0; k < at.size(); ++k) {
            if (!counts_whole(share[k])) {
                gradient[k] = Vec2(share[k] * gradient[k] + (w[k] - outside_) * slope[k]);
            }
        }
    }

private:
    /// Then the weight is itself to the last bit, and a region of the whole surface adapts as none does.
    /// Where every place of the field is 1, the share between them is 1 but for rounding.
    static bool counts_whole(double share) {
        constexpr double rounding = 1e-12;
        return std::abs(share - 1.0) <= rounding;
    }

    WeightPtr weight_;
    WeightPtr share_;
    double outside_;
};

} // namespace

Field share_of(const Region& region, const geometry::ParametricSurface& patch) {
    expects(std::ssize(region.outline) >= fewest_corners && region.border_mm >= 0.0,
            "an outline has at least three corners, and its blend width is not negative");
    Field field = Field::constant(region_raster, region_raster, 0.0);
    const std::vector<Vec3> chords = chords_of(region.outline, patch);
    parallel_for(field.rows, 1, [&](std::ptrdiff_t row) {
        const auto i = static_cast<int>(row);
        for (int j = 0; j < field.columns; ++j) {
            const Vec2 uv = field.place(i, j);
            field.values[field.index(i, j)] =
                inside_outline(region.outline, uv)
                    ? 1.0
                    : faded(distance_from(chords, patch.position(uv.x(), uv.y())), region.border_mm);
        }
    });
    return field;
}

WeightPtr within(WeightPtr weight, WeightPtr share, double outside) {
    return std::make_shared<Within>(std::move(weight), std::move(share), outside);
}

} // namespace millwright::grid
