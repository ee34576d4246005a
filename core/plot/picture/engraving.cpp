#include "core/plot/picture/engraving.h"

#include "core/base/units.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/internal/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::plot {
namespace {

using internal::check_above_zero;

constexpr double most_dots = 1e7;

void check_dots(double count, double pitch) {
    if (!(count <= most_dots)) {
        throw Error(fmt::format("dots {} mm apart would make more than 10 million dots", pitch));
    }
}

/// Darkness of pixels, 0 to 1, seen in mm from the lower left corner of the picture.
class Darkness {
public:
    Darkness(const Picture& picture, double pixel) : picture_(picture), pixel_(pixel) {}

    [[nodiscard]] double width() const { return picture_.width * pixel_; }
    [[nodiscard]] double height() const { return picture_.height * pixel_; }

    /// Mean over the pixels whose middles are in the square around `at`, or of the pixel there.
    [[nodiscard]] double around(const Vec2& at, double side) const {
        const double column = at.x() / pixel_;
        const double row = picture_.height - at.y() / pixel_;
        const double half = side / pixel_ / 2.0;
        const auto range = [](double middle, double reach, int count) {
            const int first = static_cast<int>(std::ceil(middle - reach - 0.5));
            const int last = static_cast<int>(std::ceil(middle + reach - 0.5)) - 1;
            const int nearest = static_cast<int>(std::floor(middle));
            return first > last
                       ? std::pair(std::clamp(nearest, 0, count - 1), std::clamp(nearest, 0, count - 1))
                       : std::pair(std::clamp(first, 0, count - 1), std::clamp(last, 0, count - 1));
        };
        const auto [left, right] = range(column, half, picture_.width);
        const auto [top, bottom] = range(row, half, picture_.height);
        double sum = 0.0;
        for (int i = top; i <= bottom; ++i) {
            for (int j = left; j <= right; ++j) {
                sum += white - picture_.at(i, j);
            }
        }
        return sum / white / ((bottom - top + 1.0) * (right - left + 1.0));
    }

private:
    const Picture& picture_;
    double pixel_;
};

/// One row of dots, and the errors that it leaves to the next one; both have a place on either side.
struct DitherRow {
    std::vector<double> errors;
    std::vector<double> next;
};

} // namespace

Strokes dithered(const Picture& picture, double pixel, const DitherSettings& settings, int pen) {
    check_above_zero("the pitch", settings.pitch);
    check_above_zero("the pixel width", pixel);
    const Darkness darkness(picture, pixel);
    const double across = std::max(1.0, std::floor(darkness.width() / settings.pitch + 1e-9));
    const double down = std::max(1.0, std::floor(darkness.height() / settings.pitch + 1e-9));
    check_dots(across * down, settings.pitch);
    const int columns = static_cast<int>(across);
    const int rows = static_cast<int>(down);
    const auto width = static_cast<std::size_t>(columns) + 2;
    DitherRow row{std::vector<double>(width), std::vector<double>(width)};
    Strokes strokes;
    for (int i = 0; i < rows; ++i) {
        const int step = i % 2 == 0 ? 1 : -1;
        bool beside = false; // the dot before is the neighbour
        for (int n = 0; n < columns; ++n) {
            const int j = step > 0 ? n : columns - 1 - n;
            const Vec2 at((j + 0.5) * settings.pitch, (rows - 1 - i + 0.5) * settings.pitch);
            const auto place = static_cast<std::size_t>(j + 1);
            const double wanted = darkness.around(at, settings.pitch) + row.errors[place];
            const bool dot = wanted >= 0.5;
            const double left_over = wanted - (dot ? 1.0 : 0.0);
            const auto ahead = static_cast<std::size_t>(j + 1 + step);
            const auto behind = static_cast<std::size_t>(j + 1 - step);
            row.errors[ahead] += left_over * 7.0 / 16.0;
            row.next[behind] += left_over * 3.0 / 16.0;
            row.next[place] += left_over * 5.0 / 16.0;
            row.next[ahead] += left_over * 1.0 / 16.0;
            if (dot && settings.join && beside) {
                strokes.back().points.push_back(at);
            } else if (dot) {
                strokes.push_back({.pen = pen, .points = {at}});
            }
            beside = dot;
        }
        row.errors.swap(row.next);
        std::ranges::fill(row.next, 0.0);
    }
    return strokes;
}

CutPath halftone(const Picture& picture, double pixel, const HalftoneSettings& settings) {
    check_above_zero("the pitch", settings.pitch);
    check_above_zero("the pixel width", pixel);
    check_above_zero("the plunge rate", settings.plunging);
    check_above_zero("a safe height", settings.safe_height);
    if (settings.tip.kind != TipKind::v && settings.tip.kind != TipKind::ball) {
        throw Error(fmt::format("{} can only make holes of one width", to_text(settings.tip)),
                    {},
                    "use a V or ball tool for dots of several sizes");
    }
    const Darkness darkness(picture, pixel);
    const Vec2 middle(darkness.width() / 2.0, darkness.height() / 2.0);
    const double reach = std::ceil(middle.norm() / settings.pitch);
    check_dots(4.0 * reach * reach, settings.pitch);
    const int count = static_cast<int>(reach);
    const Vec2 along = settings.pitch * Vec2(std::cos(settings.angle), std::sin(settings.angle));
    const Vec2 across(-along.y(), along.x());
    CutPath path;
    for (int row = count; row >= -count; --row) {
        for (int n = -count; n <= count; ++n) {
            const int column = (row + count) % 2 == 0 ? n : -n;
            const Vec2 at = middle + column * along + row * across;
            const bool inside =
                at.x() >= 0.0 && at.y() >= 0.0 && at.x() <= darkness.width() && at.y() <= darkness.height();
            expect_not_too_long(path.size());
            const double dark = inside ? darkness.around(at, settings.pitch) : 0.0;
            if (!(dark > 0.0)) {
                continue;
            }
            const double wide = std::min(settings.pitch * std::sqrt(dark / pi), radius(settings.tip));
            path.push_back({.at = {at.x(), at.y(), settings.safe_height}});
            path.push_back({.at = {at.x(), at.y(), -rise(settings.tip, wide)},
                            .speed = settings.plunging,
                            .move = CutMove::plunge});
            path.push_back({.at = {at.x(), at.y(), settings.safe_height}, .move = CutMove::retract});
        }
    }
    return path;
}

} // namespace millwright::plot
