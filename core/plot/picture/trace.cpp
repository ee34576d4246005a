// The home of potrace's library.
#include "core/plot/picture/trace.h"

#include <fmt/format.h>
#include <potracelib.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <iterator>
#include <memory>
#include <new>

namespace millwright::plot {
namespace {

constexpr double smoothest = 4.0 / 3.0; // alphamax beyond which no corner is left

void check_trace_settings(const TraceSettings& settings) {
    const auto within = [](const char* name, double value, double most) {
        if (!(value >= 0.0 && value <= most)) {
            throw Error(fmt::format("{} is {}, but must be from 0 to {:.4g}", name, value, most));
        }
    };
    constexpr double coarsest = 5.0;
    within("the threshold", settings.threshold, 1.0);
    within("the speckle size", settings.speckle, INT_MAX);
    within("the corner smoothing", settings.corner, smoothest + 1e-3);
    within("the tolerance", settings.tolerance, coarsest);
}

/// One bit per pixel, set where the picture is dark; scan lines from below, as potrace has them.
class BitMap {
public:
    BitMap(const Picture& picture, double threshold) {
        constexpr int bits = sizeof(potrace_word) * CHAR_BIT;
        map_.w = picture.width;
        map_.h = picture.height;
        map_.dy = (picture.width + bits - 1) / bits;
        words_.resize(static_cast<std::size_t>(map_.dy) * static_cast<std::size_t>(map_.h));
        map_.map = words_.data();
        const double darkest_light = threshold * white;
        const std::uint16_t* pixel = picture.gray.data();
        for (int row = picture.height - 1; row >= 0; --row) {
            potrace_word* line = words_.data() + std::ptrdiff_t{row} * map_.dy;
            for (int x = 0; x < picture.width; ++x, ++pixel) {
                const potrace_word dark = *pixel > darkest_light ? 0 : 1;
                line[x / bits] |= dark << (bits - 1 - x % bits);
            }
        }
    }

    [[nodiscard]] const potrace_bitmap_t& map() const { return map_; }

private:
    std::vector<potrace_word> words_;
    potrace_bitmap_t map_ = {};
};

int policy(TurnPolicy turns) {
    switch (turns) {
    case TurnPolicy::connect_black:
        return POTRACE_TURNPOLICY_BLACK;
    case TurnPolicy::connect_white:
        return POTRACE_TURNPOLICY_WHITE;
    case TurnPolicy::left:
        return POTRACE_TURNPOLICY_LEFT;
    case TurnPolicy::right:
        return POTRACE_TURNPOLICY_RIGHT;
    case TurnPolicy::majority:
        return POTRACE_TURNPOLICY_MAJORITY;
    case TurnPolicy::minority:
        break;
    }
    return POTRACE_TURNPOLICY_MINORITY;
}

Vec2 vec(const potrace_dpoint_t& point) {
    return {point.x, point.y};
}

TracedCurve straight_to(const Vec2& from, const Vec2& to) {
    return {from, to, to, true};
}

TracedPath path_of(const potrace_path_t& found) {
    const potrace_curve_t& curve = found.curve;
    TracedPath path;
    path.start = vec(curve.c[curve.n - 1][2]);
    path.hole = found.sign == '-';
    Vec2 at = path.start;
    for (int n = 0; n < curve.n; ++n) {
        const auto& c = curve.c[n];
        if (curve.tag[n] == POTRACE_CORNER) {
            path.curves.push_back(straight_to(at, vec(c[1])));
            path.curves.push_back(straight_to(vec(c[1]), vec(c[2])));
        } else {
            path.curves.push_back({vec(c[0]), vec(c[1]), vec(c[2]), false});
        }
        at = vec(c[2]);
    }
    return path;
}

/// As many chords as keep within the tolerance: the distance is at most n^-2 / 8 of the largest second
/// derivative.
int chords_of(const Vec2& from, const TracedCurve& curve, double tolerance) {
    const double bend = 6.0 * std::max((from - 2.0 * curve.first + curve.second).norm(),
                                       (curve.first - 2.0 * curve.second + curve.end).norm());
    constexpr double most = 10'000.0;
    return curve.straight
               ? 1
               : static_cast<int>(std::clamp(std::ceil(std::sqrt(bend / 8.0 / tolerance)), 1.0, most));
}

Vec2 point_at(const Vec2& from, const TracedCurve& curve, double t) {
    const double s = 1.0 - t;
    return s * s * s * from + 3.0 * s * s * t * curve.first + 3.0 * s * t * t * curve.second +
           t * t * t * curve.end;
}

} // namespace

std::vector<TracedPath> trace(const Picture& picture, const TraceSettings& settings) {
    check_trace_settings(settings);
    expects(picture.width > 0 && picture.height > 0, "a picture has pixels");
    const std::unique_ptr<potrace_param_t, decltype(&potrace_param_free)> parameters(potrace_param_default(),
                                                                                     &potrace_param_free);
    if (!parameters) {
        throw std::bad_alloc();
    }
    parameters->turdsize = settings.speckle;
    parameters->turnpolicy = policy(settings.turns);
    parameters->alphamax = settings.corner;
    parameters->opticurve = settings.tolerance > 0.0 ? 1 : 0;
    parameters->opttolerance = settings.tolerance;
    const BitMap bits(picture, settings.threshold);
    const std::unique_ptr<potrace_state_t, decltype(&potrace_state_free)> found(
        potrace_trace(parameters.get(), &bits.map()), &potrace_state_free);
    if (!found || found->status != POTRACE_STATUS_OK) {
        throw Error("the picture cannot be traced: not enough memory");
    }
    std::vector<TracedPath> paths;
    for (const potrace_path_t* path = found->plist; path != nullptr; path = path->next) {
        paths.push_back(path_of(*path));
    }
    return paths;
}

Strokes strokes_of(const std::vector<TracedPath>& paths, double pitch, double tolerance, int pen) {
    if (!(pitch > 0.0 && tolerance > 0.0) || !std::isfinite(pitch + tolerance)) {
        throw Error(fmt::format(
            "chords within {} mm of the curves are not possible with pixels of {} mm", tolerance, pitch));
    }
    Strokes strokes;
    for (const TracedPath& path : paths) {
        Stroke& stroke = strokes.emplace_back(Stroke{.pen = pen, .points = {path.start * pitch}});
        Vec2 at = path.start;
        for (const TracedCurve& curve : path.curves) {
            const int chords = chords_of(at, curve, tolerance / pitch);
            for (int n = 1; n < chords; ++n) {
                stroke.points.emplace_back(point_at(at, curve, static_cast<double>(n) / chords) * pitch);
            }
            stroke.points.emplace_back(curve.end * pitch);
            at = curve.end;
        }
    }
    return strokes;
}

std::string svg_text(const std::vector<TracedPath>& paths, const Picture& picture, double pitch) {
    const double width = picture.width * pitch;
    const double height = picture.height * pitch;
    std::string text =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.4f}mm\" height=\"{1:.4f}mm\" "
                    "viewBox=\"0 0 {0:.4f} {1:.4f}\">\n<path fill-rule=\"evenodd\" d=\"\n",
                    width,
                    height);
    const auto out = std::back_inserter(text);
    const auto put = [&](const char* name, const Vec2& p) {
        fmt::format_to(out, "{}{:.4f} {:.4f}", name, p.x() * pitch, height - p.y() * pitch);
    };
    for (const TracedPath& path : paths) {
        put("M", path.start);
        for (const TracedCurve& curve : path.curves) {
            if (curve.straight) {
                put("L", curve.end);
            } else {
                put("C", curve.first);
                put(" ", curve.second);
                put(" ", curve.end);
            }
        }
        text += "Z\n";
    }
    text += "\"/>\n</svg>\n";
    return text;
}

} // namespace millwright::plot
