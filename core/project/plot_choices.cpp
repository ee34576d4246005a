#include "core/project/plot_choices.h"

#include <array>

namespace millwright::project {

namespace {

using plot::Corners;
using plot::CutterSide;
using plot::FillMode;
using plot::GrayRule;
using plot::LineEnds;
using plot::TipKind;
using plot::TurnPolicy;

constexpr std::array<Choice<PictureUse>, 5> of_use{{
    {PictureUse::relief, "relief", "Relief", "As deep as pixels are bright"},
    {PictureUse::outlines, "outlines", "Outlines", "Around what is dark, by tracing"},
    {PictureUse::carving, "carving", "V-carving", "What is dark, by a V-bit along its middle"},
    {PictureUse::halftone, "halftone", "Halftone", "Dots whose size says how dark it is"},
    {PictureUse::dots, "dots", "Dots", "Dots of one size, as many as it is dark"},
}};

constexpr std::array<Choice<DrawingUse>, 2> of_drawing_use{{
    {DrawingUse::strokes, "strokes", "Strokes", "Along its lines, beside them or filled"},
    {DrawingUse::carving, "carving", "V-carving", "Closed outlines, by a V-bit along their middle"},
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

constexpr std::array<Choice<FillMode>, 3> of_fill{{
    {FillMode::hatched, "hatched", "Hatched", "As their fill type says; solid ones a pen width apart"},
    {FillMode::outline, "outline", "Outlines", "Their edges alone"},
    {FillMode::none, "none", "Nothing", "They are left out"},
}};

constexpr std::array<Choice<LineEnds>, 3> of_line_ends{{
    {LineEnds::automatic, "automatic", "As the file shows", "Refused where it does not show"},
    {LineEnds::join, "join", "Nothing", "Listings are wrapped in the middle of numbers"},
    {LineEnds::separate, "separate", "Separators", "As blanks between numbers"},
}};

constexpr std::array<Choice<TurnPolicy>, 6> of_turns{{
    {TurnPolicy::minority, "minority", "Minority", "What there is less of nearby is connected"},
    {TurnPolicy::majority, "majority", "Majority", "What there is more of nearby is connected"},
    {TurnPolicy::connect_black, "black", "Black", "What is dark is connected"},
    {TurnPolicy::connect_white, "white", "White", "What is bright is connected"},
    {TurnPolicy::left, "left", "Left", "Outlines turn left"},
    {TurnPolicy::right, "right", "Right", "Outlines turn right"},
}};

} // namespace

std::span<const Choice<PictureUse>> picture_uses() {
    return of_use;
}
std::span<const Choice<DrawingUse>> drawing_uses() {
    return of_drawing_use;
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
std::span<const Choice<FillMode>> fill_modes() {
    return of_fill;
}
std::span<const Choice<LineEnds>> line_ends() {
    return of_line_ends;
}
std::span<const Choice<TurnPolicy>> turn_policies() {
    return of_turns;
}

} // namespace millwright::project
