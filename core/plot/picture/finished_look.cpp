#include "core/plot/picture/finished_look.h"

#include "core/base/numbers.h"
#include "core/base/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace millwright::plot {
namespace {

/// Where the tool cuts, its width included.
Extents cut_extents(const CutPath& path, const ToolTips& tips) {
    constexpr double thinnest = 0.05; // of a point, so that its picture is not empty
    std::optional<Extents> box;
    double deepest = 0.0;
    double rim = thinnest;
    for (const CutPoint& point : path) {
        if (point.at.z() > 0.0) {
            continue;
        }
        const Vec2 at = point.at.head<2>();
        if (!box) {
            box = Extents{at, at};
        }
        box->lower = box->lower.cwiseMin(at);
        box->upper = box->upper.cwiseMax(at);
        deepest = std::max(deepest, -point.at.z());
        rim = std::max(rim, mouth_radius(tips.of(point.tool), -point.at.z()));
    }
    if (!(deepest > 0.0)) {
        throw Error("the path does not cut anything");
    }
    return {box->lower - Vec2(rim, rim), box->upper + Vec2(rim, rim)};
}

/// Some rows of the field, cut by the whole path.
class Band {
public:
    Band(HeightField& field, const Vec2& corner, int first, int last)
        : field_(field), corner_(corner), first_(first), last_(last) {}

    void cut(const Vec3& from, const Vec3& to, const ToolTip& tip) {
        const double reach = std::max(radius(tip), 0.75 * field_.pitch);
        const double top = corner_.y() + field_.y_of_row(first_) + reach;
        const double bottom = corner_.y() + field_.y_of_row(last_) - reach;
        const bool beside = std::min(from.y(), to.y()) > top || std::max(from.y(), to.y()) < bottom;
        if (beside || std::min(from.z(), to.z()) >= 0.0) {
            return;
        }
        const double steps = std::ceil((to - from).norm() / (field_.pitch / 2.0));
        for (double n = 0.0; n <= steps; n += 1.0) {
            stamp(from + n / std::max(steps, 1.0) * (to - from), tip);
        }
    }

private:
    void stamp(const Vec3& at, const ToolTip& tip) {
        if (at.z() >= 0.0) {
            return;
        }
        const double column = (at.x() - corner_.x()) / field_.pitch;
        const double row = field_.rows - 1 - (at.y() - corner_.y()) / field_.pitch;
        const double reach = std::max(mouth_radius(tip, -at.z()) / field_.pitch, 0.75);
        const int top = std::max(first_, static_cast<int>(std::ceil(row - reach)));
        const int bottom = std::min(last_, static_cast<int>(std::floor(row + reach)));
        const int left = std::max(0, static_cast<int>(std::ceil(column - reach)));
        const int right = std::min(field_.columns - 1, static_cast<int>(std::floor(column + reach)));
        for (int i = top; i <= bottom; ++i) {
            for (int j = left; j <= right; ++j) {
                float& z = field_.z[static_cast<std::size_t>(i) * static_cast<std::size_t>(field_.columns) +
                                    static_cast<std::size_t>(j)];
                if (static_cast<double>(z) <= at.z()) {
                    continue;
                }
                const double distance = std::sqrt(square(i - row) + square(j - column)) * field_.pitch;
                // A tip thinner than a square still cuts the square that it is in.
                const bool inside = distance <= 0.75 * field_.pitch && radius(tip) < field_.pitch;
                const double up = inside ? 0.0 : rise(tip, distance);
                z = std::min(z, static_cast<float>(at.z() + up));
            }
        }
    }

    HeightField& field_;
    Vec2 corner_;
    int first_;
    int last_;
};

std::uint8_t level(double brightness) {
    constexpr double most = 255.0;
    return static_cast<std::uint8_t>(std::lround(most * std::clamp(brightness, 0.0, 1.0)));
}

/// IEC 61966-2-1: as a picture says how much light there is, 0 to 1.
double srgb(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

GrayImage image_like(const HeightField& field) {
    return {field.columns, field.rows, std::vector<std::uint8_t>(field.z.size())};
}

} // namespace

const ToolTip& ToolTips::of(int tool) const {
    const auto other = others.find(tool);
    return other == others.end() ? usual : other->second;
}

HeightField finished(const CutPath& path, const ToolTip& tip, int longest_side, const Progress& progress) {
    return finished_by(path, {tip, {}}, longest_side, progress);
}

HeightField
finished_by(const CutPath& path, const ToolTips& tips, int longest_side, const Progress& progress) {
    constexpr int most = 10'000;
    if (longest_side < 1 || longest_side > most) {
        throw Error(fmt::format("the picture has {} pixels, but must have 1 to {}", longest_side, most));
    }
    const auto [lower, upper] = cut_extents(path, tips);
    const Vec2 size = upper - lower;
    HeightField field;
    field.pitch = size.maxCoeff() / longest_side;
    field.columns = std::max(1, static_cast<int>(std::lround(size.x() / field.pitch)));
    field.rows = std::max(1, static_cast<int>(std::lround(size.y() / field.pitch)));
    field.z.assign(static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows), 0.0F);
    field.corner = lower + Vec2(field.pitch, field.pitch) / 2.0;
    constexpr int band_rows = 64;
    const int bands = (field.rows + band_rows - 1) / band_rows;
    parallel_for(bands, 1, [&](std::ptrdiff_t n) {
        const int first = static_cast<int>(n) * band_rows;
        Band band(field, field.corner, first, std::min(first + band_rows, field.rows) - 1);
        constexpr std::size_t often = 10'000;
        for (std::size_t k = 1; k < path.size(); ++k) {
            if (k % often == 0) {
                progress.check();
            }
            band.cut(path[k - 1].at, path[k].at, tips.of(path[k].tool));
        }
    });
    return field;
}

GrayImage shaded(const HeightField& field, double thickness) {
    const Vec3 light = Vec3(-1.0, 1.0, 2.0).normalized();
    constexpr double ambient = 0.25;
    GrayImage image = image_like(field);
    const auto z = [&](int i, int j) {
        const int row = std::clamp(i, 0, field.rows - 1);
        const int column = std::clamp(j, 0, field.columns - 1);
        return static_cast<double>(field.row(row)[static_cast<std::size_t>(column)]);
    };
    std::size_t n = 0;
    for (int i = 0; i < field.rows; ++i) {
        for (int j = 0; j < field.columns; ++j, ++n) {
            const double dx = (z(i, j + 1) - z(i, j - 1)) / (2.0 * field.pitch);
            const double dy = (z(i - 1, j) - z(i + 1, j)) / (2.0 * field.pitch);
            const double facing = std::max(0.0, Vec3(-dx, -dy, 1.0).normalized().dot(light));
            image.pixels[n] = z(i, j) <= -thickness ? level(1.0) : level(ambient + (1.0 - ambient) * facing);
        }
    }
    return image;
}

GrayImage against_light(const HeightField& field, double thickness, double half_depth) {
    if (!(thickness > 0.0 && half_depth > 0.0) || !std::isfinite(thickness + half_depth)) {
        throw Error(
            fmt::format("a plate of {} mm in a material that halves the light every {} mm is not possible",
                        thickness,
                        half_depth));
    }
    GrayImage image = image_like(field);
    std::ranges::transform(field.z, image.pixels.begin(), [&](float z) {
        const double left = std::max(0.0, thickness + static_cast<double>(z));
        return level(srgb(std::exp2(-left / half_depth)));
    });
    return image;
}

} // namespace millwright::plot
