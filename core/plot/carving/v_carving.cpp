#include "core/plot/carving/v_carving.h"

#include "core/base/counted.h"
#include "core/base/units.h"
#include "core/plot/carving/internal/carving_outlines.h"
#include "core/plot/carving/internal/carving_path.h"
#include "core/plot/carving/medial_axis.h"
#include "core/plot/compensation.h"
#include "core/plot/cut_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace millwright::plot {
namespace {

using internal::BitDepth;
using internal::CutLine;
using internal::PartPasses;

constexpr double finest_tolerance = 1e-4; // mm; places are rounded to 1e-6 mm
constexpr double finest_pass = 0.002;     // mm; shallower ones are a slip, and take hours
constexpr double most_passes = 10'000.0;

void expect_carving_settings(const CarvingSettings& settings) {
    const ToolTip& tip = settings.tip;
    if (tip.kind != TipKind::v) {
        throw Error(fmt::format("{} cannot carve: its width does not grow with its depth", to_text(tip)),
                    {},
                    "give a V-bit, such as v:60");
    }
    const bool cone = tip.angle > 0.0 && tip.angle < std::numbers::pi && tip.diameter > 0.0;
    const bool narrow = tip.end_width >= 0.0 && tip.end_radius >= 0.0 &&
                        tip.end_width / 2.0 + tip.end_radius * std::cos(tip.angle / 2.0) < radius(tip);
    if (!cone || !narrow || !std::isfinite(tip.diameter)) {
        throw Error(
            fmt::format(
                "not a valid V-bit: {:g} degrees, diameter {:g} mm, flat end {:g} mm, round end {:g} mm",
                to_degrees(tip.angle),
                tip.diameter,
                tip.end_width,
                tip.end_radius),
            {},
            "use an angle above 0 and below 180 degrees, and an end narrower than the bit");
    }
    const auto expect_above_zero = [](const char* what, double value) {
        if (!(value > 0.0) || !std::isfinite(value)) {
            throw Error(fmt::format("{} must be above 0, not {:g}", what, value));
        }
    };
    expect_above_zero("the largest depth", settings.largest_depth.value_or(1.0));
    expect_above_zero("the depth per pass", settings.depth_per_pass.value_or(1.0));
    if (settings.depth_per_pass && *settings.depth_per_pass < finest_pass) {
        throw Error(fmt::format(
            "the depth per pass must be {:g} mm or more, not {:g}", finest_pass, *settings.depth_per_pass));
    }
    expect_above_zero("the step-over", settings.step_over.value_or(1.0));
    expect_above_zero("the largest gap to close", settings.close_gaps);
    expect_above_zero("the cutting speed", settings.cutting);
    expect_above_zero("the plunge rate", settings.plunging);
    expect_above_zero("the safe height", settings.safe_height);
    if (!(settings.tolerance >= finest_tolerance) || !std::isfinite(settings.tolerance)) {
        throw Error(fmt::format(
            "the tolerance must be {:g} mm or more, not {:g}", finest_tolerance, settings.tolerance));
    }
}

/// Of place and depth: where the cone is steep, depth asks for more than place.
double clearance_tolerance(const CarvingSettings& settings) {
    return settings.tolerance * std::min(1.0, std::tan(settings.tip.angle / 2.0));
}

double area_of(const Region& region) {
    double twice = 0.0;
    for (const Ring& ring : region) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const Vec2& a = ring[n];
            const Vec2& b = ring[(n + 1) % ring.size()];
            twice += a.x() * b.y() - a.y() * b.x();
        }
    }
    return 0.5 * twice;
}

/// With its end closed on its begin.
CutLine closed_cut(const Ring& ring, double z) {
    CutLine line;
    for (const Vec2& at : ring) {
        line.emplace_back(at.x(), at.y(), z);
    }
    line.push_back(line.front());
    return line;
}

/// What is cut of each part before it is divided into passes.
class CarvingPlan {
public:
    CarvingPlan(const MedialAxis& axis, const CarvingSettings& settings)
        : axis_(axis), settings_(settings),
          bit_(settings.tip,
               settings.largest_depth.value_or(std::numeric_limits<double>::infinity()),
               settings.tolerance / 4.0),
          cuts_(static_cast<std::size_t>(axis.parts)), regions_(static_cast<std::size_t>(axis.parts)),
          widest_(static_cast<std::size_t>(axis.parts), 0.0) {
        for (std::size_t n = 0; n < axis.region.size(); ++n) {
            regions_[static_cast<std::size_t>(axis.ring_parts[n])].push_back(axis.region[n]);
        }
        for (const AxisNode& node : axis.nodes) {
            double& widest = widest_[static_cast<std::size_t>(node.part)];
            widest = std::max(widest, node.clearance);
        }
    }

    [[nodiscard]] Carving run(const Progress& progress) {
        made_.parts = axis_.parts;
        made_.area = area_of(axis_.region);
        for (const internal::AxisTrail& trail : internal::axis_trails(axis_)) {
            std::vector<CutLine>& to = cuts_[static_cast<std::size_t>(trail.part)];
            for (CutLine& line : bit_.cuts_along(trail.way, settings_.clear_floor)) {
                to.push_back(std::move(line));
            }
        }
        progress.check();
        for (std::size_t part = 0; part < cuts_.size(); ++part) {
            add_floor(part, progress);
        }
        find_narrow();
        std::vector<PartPasses> parts;
        for (const std::vector<CutLine>& cuts : cuts_) {
            parts.push_back(passes_of(cuts, progress));
            progress.check();
        }
        made_.path = internal::carving_path(parts, settings_, progress.part(0.2, 0.6));
        for (const CutPoint& point : made_.path) {
            made_.deepest = std::max(made_.deepest, -point.at.z());
        }
        made_.deviation = internal::path_deviation(made_.path, axis_.region, settings_.tip, progress);
        return std::move(made_);
    }

private:
    [[nodiscard]] Region shrunk(const Region& region, double distance) const {
        return offset(region, -distance, Corners::round, clearance_tolerance(settings_) / 4.0);
    }

    /// Along the edge of the floor, and on inside. The axis itself is cut there, too, so that no place of a
    /// cleared floor is farther from a pass than half of the step-over.
    void add_floor(std::size_t part, const Progress& progress) {
        if (!(widest_[part] > bit_.widest())) {
            return;
        }
        const Region& region = regions_[part];
        const Region floor = shrunk(region, bit_.widest());
        Region edge = floor;
        made_.floor_area += area_of(edge);
        if (!settings_.clear_floor) {
            made_.floor_left += area_of(shrunk(region, bit_.widest() + bit_.narrowest()));
        }
        const double step = step_over();
        if (settings_.clear_floor && step > 2.0 * bit_.widest()) {
            throw Error(fmt::format("passes {:g} mm apart leave material between them: the bit is {:.4g} mm "
                                    "wide at the largest depth",
                                    step,
                                    2.0 * bit_.widest()),
                        {},
                        "use a smaller step-over, or leave the floor for an end mill");
        }
        std::size_t points = 0;
        for (int n = 1; !edge.empty(); ++n) {
            for (const Ring& ring : edge) {
                points += ring.size();
                cuts_[part].push_back(closed_cut(ring, -bit_.largest()));
            }
            if (!settings_.clear_floor) {
                return;
            }
            constexpr std::size_t most_floor_points = 10'000'000;
            if (points > most_floor_points) {
                throw Error(fmt::format("passes {:g} mm apart need more than {} points to clear the floor",
                                        step,
                                        most_floor_points),
                            {},
                            "use a larger step-over, or leave the floor for an end mill");
            }
            progress.check();
            made_.ridge =
                std::max(made_.ridge, rise(settings_.tip, std::min(step / 2.0, radius(settings_.tip))));
            edge = shrunk(floor, n * step); // has fewer corners than the outline
        }
    }

    [[nodiscard]] double step_over() const {
        constexpr double of_depth = 0.1;
        return settings_.step_over.value_or(2.0 * mouth_radius(settings_.tip, of_depth * bit_.largest()));
    }

    void find_narrow() {
        const double half = bit_.narrowest();
        if (half > 0.0) {
            const double tolerance = clearance_tolerance(settings_) / 4.0;
            const Region reached = offset(shrunk(axis_.region, half), half, Corners::round, tolerance);
            made_.narrow_area = std::max(0.0, made_.area - area_of(reached));
        }
    }

    [[nodiscard]] PartPasses passes_of(const std::vector<CutLine>& cuts, const Progress& progress) {
        double deepest = 0.0;
        for (const CutLine& line : cuts) {
            for (const Vec3& at : line) {
                deepest = std::max(deepest, -at.z());
            }
        }
        constexpr double rounding = 1e-9;
        const double count =
            settings_.depth_per_pass ? std::ceil(deepest / *settings_.depth_per_pass - rounding) : 1.0;
        if (count > most_passes) {
            throw Error(fmt::format("a cut of {:.6g} mm in steps of {:g} mm needs more than {} passes",
                                    deepest,
                                    *settings_.depth_per_pass,
                                    most_passes),
                        {},
                        "use a larger depth per pass");
        }
        PartPasses passes;
        for (double n = 1.0; n <= count; n += 1.0) {
            progress.check();
            std::vector<CutLine>& pass = passes.emplace_back();
            for (const CutLine& line : cuts) {
                for (CutLine& cut :
                     internal::pass_of(line, (n - 1.0) / count * deepest, n / count * deepest)) {
                    pass_points_ += cut.size();
                    pass.push_back(std::move(cut));
                }
            }
            expect_not_too_long(pass_points_);
        }
        return passes;
    }

    const MedialAxis& axis_;
    const CarvingSettings& settings_;
    BitDepth bit_;
    std::vector<std::vector<CutLine>> cuts_; ///< by part
    std::vector<Region> regions_;            ///< the same
    std::vector<double> widest_;             ///< clearance, by part
    std::size_t pass_points_ = 0;            ///< of all passes so far
    Carving made_;
};

std::string times_and_place(const OutlineFindings& found) {
    return fmt::format("{}, {} ({:.3f}, {:.3f}) mm",
                       counted(found.count, "time"),
                       found.count == 1 ? "at" : "first at",
                       found.first.x(),
                       found.first.y());
}

void note_outlines(const MedialAxis& axis, std::vector<Diagnostic>& notices) {
    if (axis.crossings.count > 0) {
        notices.push_back({{},
                           "outlines cross or overlap " + times_and_place(axis.crossings),
                           "areas enclosed by an odd number of outlines are carved"});
    }
    if (axis.flat.count > 0) {
        notices.push_back(
            {{}, "outlines that enclose no area are skipped " + times_and_place(axis.flat), {}});
    }
    if (axis.repeated.count > 0) {
        notices.push_back({{}, "duplicate outlines are skipped " + times_and_place(axis.repeated), {}});
    }
}

void note_left(const CarvingSettings& settings, Carving& made) {
    const auto note = [&](std::string message, std::string hint) {
        made.notices.push_back({{}, std::move(message), std::move(hint)});
    };
    if (made.floor_left > 0.0) {
        note(fmt::format(
                 "{:.4g} mm2 of the floor at {:.3f} mm are not cleared", made.floor_left, made.deepest),
             "clear them with a flat end mill, or with the bit: leave out --leave-floor (Clear floor in the "
             "window)");
    } else if (made.floor_area > 0.0) {
        note(fmt::format("outlines are too wide for the bit at {:.3f} mm: the bit clears {:.4g} mm2 of "
                         "floor, with ridges of up to {:.3f} mm between passes",
                         made.deepest,
                         made.floor_area,
                         made.ridge),
             "use a smaller step-over for lower ridges");
    }
    if (made.narrow_area > 0.01 * made.area) {
        note(fmt::format("{:.4g} mm2 of {:.4g} mm2 are narrower than the flat end of the bit, {:g} mm, and "
                         "are not cut",
                         made.narrow_area,
                         made.area,
                         settings.tip.end_width),
             "use a bit with a narrower end, or a larger drawing");
    }
}

} // namespace

Carving v_carving(const Strokes& drawn, const CarvingSettings& settings, const Progress& progress) {
    expect_carving_settings(settings);
    internal::CarvingOutlines outlines = internal::carving_outlines(drawn, settings.close_gaps);
    if (outlines.region.empty()) {
        throw Error("there is no outline to carve");
    }
    const double share = clearance_tolerance(settings) / 4.0;
    progress.report(0.0, "Computing the centre lines of the outlines");
    const MedialAxis axis =
        medial_axis(outlines.region, {.sampling = share, .pruning = 2.0 * share}, progress.part(0.0, 0.6));
    if (axis.parts == 0) {
        throw Error("the outlines enclose no area: there is nothing to carve");
    }
    Carving made = CarvingPlan(axis, settings).run(progress.part(0.6, 1.0));
    if (made.path.empty()) {
        throw Error(fmt::format("the whole drawing is narrower than the flat end of the bit, {:g} mm",
                                settings.tip.end_width),
                    {},
                    "use a bit with a narrower end, or a larger drawing");
    }
    made.notices = std::move(outlines.notices);
    note_outlines(axis, made.notices);
    note_left(settings, made);
    if (made.deviation > settings.tolerance) {
        throw Error(
            fmt::format(
                "the bit would cut {:.6g} mm beyond an outline, which exceeds the tolerance of {:g} mm",
                made.deviation,
                settings.tolerance),
            {},
            "use a larger tolerance, and please report the drawing");
    }
    return made;
}

} // namespace millwright::plot
