#include "core/project/plot_settings.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace millwright::project {

namespace {

/// How a number of the core is told to people.
enum class As { it_is, degrees, mm_per_min };

template <As as> double from_people(double value) {
    return as == As::degrees ? from_degrees(value) : as == As::mm_per_min ? from_mm_per_min(value) : value;
}

/// A number that from_people() turns into exactly this one, and what a person typed before any other.
template <As as> double to_people(double value) {
    if (as == As::it_is) {
        return value;
    }
    const double turned = as == As::degrees ? to_degrees(value) : to_mm_per_min(value);
    constexpr double digits = 1e9;
    const double typed = std::round(turned * digits) / digits;
    const auto is_it = [&](double people) { return exactly_equal(from_people<as>(people), value); };
    if (is_it(typed)) {
        return typed;
    }
    constexpr int neighbours = 4;
    constexpr double far = std::numeric_limits<double>::infinity();
    double up = turned;
    double down = turned;
    for (int n = 0; n < neighbours; ++n) {
        if (is_it(up) || is_it(down)) {
            return is_it(up) ? up : down;
        }
        up = std::nextafter(up, far);
        down = std::nextafter(down, -far);
    }
    return turned;
}

/// The member at the end of a chain of members.
template <auto first, auto... rest> auto& reach(auto& owner) {
    if constexpr (sizeof...(rest) == 0) {
        return owner.*first;
    } else {
        return reach<rest...>(owner.*first);
    }
}

template <auto first> using OwnerOf = decltype(internal::owner_of(first));

template <As as, auto first, auto... rest>
inline constexpr NumberField<OwnerOf<first>> number{
    [](const OwnerOf<first>& owner) { return to_people<as>(reach<first, rest...>(owner)); },
    [](OwnerOf<first>& owner, double value) { reach<first, rest...>(owner) = from_people<as>(value); },
    false};

template <auto first, auto... rest>
inline constexpr NumberField<OwnerOf<first>> count{
    [](const OwnerOf<first>& owner) { return static_cast<double>(reach<first, rest...>(owner)); },
    [](OwnerOf<first>& owner, double value) {
        reach<first, rest...>(owner) = static_cast<int>(std::round(value));
    },
    true};

/// People say 0 for none.
template <auto first, auto... rest>
inline constexpr NumberField<OwnerOf<first>> maybe{
    [](const OwnerOf<first>& owner) { return reach<first, rest...>(owner).value_or(0.0); },
    [](OwnerOf<first>& owner, double value) {
        reach<first, rest...>(owner) = value > 0.0 ? std::optional(value) : std::nullopt;
    },
    false};

template <int axis>
inline constexpr NumberField<PlotSettings> of_origin{
    [](const PlotSettings& settings) { return settings.origin[axis]; },
    [](PlotSettings& settings, double value) { settings.origin[axis] = value; },
    false};

using plot::Level;
using plot::StrokePlan;
using plot::Tabs;
using plot::ToolTip;
constexpr auto strokes = &PlotSettings::strokes;
constexpr auto tip = &PlotSettings::tip;

constexpr std::array<NumberSetting<PlotSettings>, 20> of_plot{{
    {"plotter_unit_mm",
     "Plotter unit",
     "mm",
     "Of HPGL: 0.025 is HP's nominal one, and that of the thesis of 2006",
     0.001,
     1.0,
     5,
     number<As::it_is, &PlotSettings::plotter_unit>},
    {"width_mm",
     "Width",
     "mm",
     "Of the picture; 0: as the file says, else 0.26 mm a pixel",
     0.0,
     2000.0,
     1,
     number<As::it_is, &PlotSettings::picture_width>},
    {"threshold",
     "Dark up to",
     "",
     "What is not brighter is dark",
     0.0,
     1.0,
     2,
     number<As::it_is, &PlotSettings::threshold>},
    {"depth_mm",
     "Depth",
     "mm",
     "Of white, or of each dot",
     0.01,
     100.0,
     2,
     number<As::it_is, &PlotSettings::depth>},
    {"dot_pitch_mm",
     "Between dots",
     "mm",
     "Across and down",
     0.05,
     20.0,
     2,
     number<As::it_is, &PlotSettings::dot_pitch>},
    {"tip_diameter_mm",
     "Diameter",
     "mm",
     "Of the tool",
     0.05,
     50.0,
     2,
     number<As::it_is, tip, &ToolTip::diameter>},
    {"tip_angle_deg",
     "Angle",
     "deg",
     "Of a V between its sides",
     5.0,
     170.0,
     1,
     number<As::degrees, tip, &ToolTip::angle>},
    {"step_over_mm",
     "Step-over",
     "mm",
     "Between rows; 0: a tenth of the tool",
     0.0,
     10.0,
     2,
     maybe<&PlotSettings::step_over>},
    {"depth_per_pass_mm",
     "Depth a pass",
     "mm",
     "Of roughing before the last pass; 0: none",
     0.0,
     50.0,
     2,
     maybe<&PlotSettings::depth_per_pass>},
    {"frame_mm",
     "Cut out",
     "mm",
     "Of a plate so thick, with four tabs; 0: it stays in it",
     0.0,
     100.0,
     2,
     maybe<&PlotSettings::frame>},
    {"tool_mm",
     "Tool",
     "mm",
     "Diameter of the end mill",
     0.05,
     50.0,
     2,
     number<As::it_is, strokes, &StrokePlan::tool_diameter>},
    {"hatch_mm",
     "Lines every",
     "mm",
     "0: none; 1.5875 mm is the thesis's 1/16 inch",
     0.0,
     50.0,
     4,
     maybe<strokes, &StrokePlan::hatch_pitch>},
    {"hatch_angle_deg",
     "At",
     "deg",
     "Of the lines to x",
     -180.0,
     180.0,
     1,
     number<As::degrees, strokes, &StrokePlan::hatch_angle>},
    {"contours_mm",
     "Outlines every",
     "mm",
     "The outline again and again inside; 0: none",
     0.0,
     50.0,
     3,
     maybe<strokes, &StrokePlan::contour_pitch>},
    {"link_mm",
     "Link gaps below",
     "mm",
     "Strokes are joined without lifting; 0: none",
     0.0,
     100.0,
     2,
     number<As::it_is, strokes, &StrokePlan::link>},
    {"safe_height_mm",
     "Safe height",
     "mm",
     "Where the tool travels, above the top",
     0.1,
     100.0,
     1,
     number<As::it_is, &PlotSettings::safe_height>},
    {"plate_mm",
     "Plate",
     "mm",
     "The path must not go deeper than its thickness; 0: not known",
     0.0,
     500.0,
     2,
     number<As::it_is, &PlotSettings::plate>},
    {"spindle_rpm",
     "Spindle",
     "1/min",
     "0 leaves it alone",
     0.0,
     1e5,
     0,
     number<As::it_is, &PlotSettings::spindle_rpm>},
    {"origin_x_mm",
     "Origin X",
     "mm",
     "Where that of the drawing lies on the machine",
     -1e4,
     1e4,
     2,
     of_origin<0>},
    {"origin_y_mm",
     "Origin Y",
     "mm",
     "Where that of the drawing lies on the machine",
     -1e4,
     1e4,
     2,
     of_origin<1>},
}};

constexpr std::array<NumberSetting<Level>, 9> of_level{{
    {"order",
     "Order",
     "",
     "Levels with a smaller one are cut first",
     -1'000'000,
     1'000'000,
     0,
     count<&Level::order>},
    {"depth_mm", "Depth", "mm", "Below the top", 0.0, 150.0, 3, number<As::it_is, &Level::depth>},
    {"passes", "Passes", "", "Of equal depth, one below the other", 1, 1000, 0, count<&Level::passes>},
    {"feed_mm_per_min",
     "Feed",
     "mm/min",
     "Along the strokes",
     1.0,
     1e5,
     1,
     number<As::mm_per_min, &Level::cutting>},
    {"plunge_mm_per_min",
     "Plunge",
     "mm/min",
     "Into the work",
     1.0,
     1e5,
     1,
     number<As::mm_per_min, &Level::plunging>},
    {"tool", "Tool", "", "Where it differs the tool is changed by hand", 0, 1000, 0, count<&Level::tool>},
    {"tabs", "Tabs", "", "Bridges on closed strokes", 0, 1000, 0, count<&Level::tabs, &Tabs::count>},
    {"tab_width_mm",
     "Tab width",
     "mm",
     "Along the path of the tool's middle",
     0.1,
     100.0,
     1,
     number<As::it_is, &Level::tabs, &Tabs::width>},
    {"tab_height_mm",
     "Tab height",
     "mm",
     "Above the depth of the level",
     0.01,
     100.0,
     2,
     number<As::it_is, &Level::tabs, &Tabs::height>},
}};

using plot::Corners;
using plot::CutterSide;
using plot::GrayRule;
using plot::TipKind;

constexpr std::array<Choice<PictureUse>, 4> of_use{{
    {PictureUse::relief, "relief", "Relief", "As deep as pixels are bright"},
    {PictureUse::outlines, "outlines", "Outlines", "Around what is dark, by tracing"},
    {PictureUse::halftone, "halftone", "Halftone", "Dots whose size says how dark it is"},
    {PictureUse::dots, "dots", "Dots", "Dots of one size, as many as it is dark"},
}};

constexpr std::array<Choice<GrayRule>, 2> of_gray{{
    {GrayRule::mean, "mean", "Mean", "(R + G + B) / 3, as the thesis of 2006"},
    {GrayRule::luminance, "luminance", "Luminance", "As the eye weighs colours (ITU-R BT.709)"},
}};

constexpr std::array<Choice<TipKind>, 4> of_tip{{
    {TipKind::ball, "ball", "Ball", "Half a sphere"},
    {TipKind::flat, "flat", "End mill", "Flat below"},
    {TipKind::v, "v", "V", "A cone that ends in a point"},
    {TipKind::point, "point", "Point", "Without width: each pixel gets its own depth, as in the thesis"},
}};

constexpr std::array<Choice<CutterSide>, 3> of_side{{
    {CutterSide::on_line, "on-line", "On line", "The middle of the tool on the strokes"},
    {CutterSide::outside, "outside", "Outside", "Where the outer size matters"},
    {CutterSide::inside, "inside", "Inside", "Where the size of a hole matters"},
}};

constexpr std::array<Choice<Corners>, 2> of_corners{{
    {Corners::sharp, "sharp", "Sharp", "Cut square beyond four times the offset"},
    {Corners::round, "round", "Round", "An arc around the corner"},
}};

template <class Owner>
const NumberSetting<Owner>& row(std::span<const NumberSetting<Owner>> rows, std::string_view id) {
    for (const NumberSetting<Owner>& setting : rows) {
        if (setting.id == id) {
            return setting;
        }
    }
    throw Defect("there is no setting '" + std::string(id) + "'");
}

} // namespace

std::span<const NumberSetting<PlotSettings>> plot_numbers() {
    return of_plot;
}
std::span<const NumberSetting<Level>> level_numbers() {
    return of_level;
}
const NumberSetting<PlotSettings>& plot_number(std::string_view id) {
    return row(plot_numbers(), id);
}
const NumberSetting<Level>& level_number(std::string_view id) {
    return row(level_numbers(), id);
}

std::span<const Choice<PictureUse>> picture_uses() {
    return of_use;
}
std::span<const Choice<GrayRule>> gray_rules() {
    return of_gray;
}
std::span<const Choice<TipKind>> tip_kinds() {
    return of_tip;
}
std::span<const Choice<CutterSide>> cutter_sides() {
    return of_side;
}
std::span<const Choice<Corners>> corner_kinds() {
    return of_corners;
}

} // namespace millwright::project
