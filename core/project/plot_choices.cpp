#include "core/project/plot_choices.h"

#include <array>

namespace millwright::project {

namespace {

using hpgl::FillMode;
using hpgl::LineEnds;
using plot::Corners;
using plot::CutterSide;
using plot::GrayRule;
using plot::TipKind;
using plot::TurnPolicy;

constexpr std::array<Choice<PictureUse>, 5> of_use{{
    {PictureUse::relief, "relief", "Relief", "Depth follows the brightness of the pixels"},
    {PictureUse::outlines, "outlines", "Outlines", "Traces around dark areas"},
    {PictureUse::carving, "carving", "V-carving", "Carves dark areas with a V-bit along their centreline"},
    {PictureUse::halftone, "halftone", "Halftone", "Dots whose size follows the darkness"},
    {PictureUse::dots, "dots", "Dots", "Dots of equal size whose number follows the darkness"},
}};

constexpr std::array<Choice<DrawingUse>, 2> of_drawing_use{{
    {DrawingUse::strokes, "strokes", "Strokes", "Along the lines, offset from them, or filled"},
    {DrawingUse::carving,
     "carving",
     "V-carving",
     "Carves closed outlines with a V-bit along their centreline"},
}};

constexpr std::array<Choice<GrayRule>, 2> of_gray{{
    {GrayRule::mean, "mean", "Mean", "(R + G + B) / 3, as in the thesis of 2006"},
    {GrayRule::luminance, "luminance", "Luminance", "Weighted by perceived brightness (ITU-R BT.709)"},
}};

constexpr std::array<Choice<TipKind>, 4> of_tip{{
    {TipKind::ball, "ball", "Ball", "Hemispherical tip"},
    {TipKind::flat, "flat", "End mill", "Flat tip"},
    {TipKind::v, "v", "V", "Conical tip"},
    {TipKind::point, "point", "Point", "Zero width: each pixel gets its own depth, as in the thesis"},
}};

constexpr std::array<Choice<CutterSide>, 3> of_side{{
    {CutterSide::on_line, "on-line", "On line", "The tool centre follows the stroke"},
    {CutterSide::outside, "outside", "Outside", "The tool stays outside, so that the outer size is right"},
    {CutterSide::inside, "inside", "Inside", "The tool stays inside, so that the size of a hole is right"},
}};

constexpr std::array<Choice<Corners>, 2> of_corners{{
    {Corners::sharp, "sharp", "Sharp", "Mitred; cut square beyond four times the offset"},
    {Corners::round, "round", "Round", "An arc around each corner"},
}};

constexpr std::array<Choice<FillMode>, 3> of_fill{{
    {FillMode::hatched,
     "hatched",
     "Hatched",
     "As the fill type specifies; solid fills are hatched at pen width"},
    {FillMode::outline, "outline", "Outlines", "Edges only"},
    {FillMode::none, "none", "None", "Filled areas are skipped"},
}};

constexpr std::array<Choice<LineEnds>, 3> of_line_ends{{
    {LineEnds::automatic, "automatic", "Automatic", "Detected from the file; an ambiguous file is rejected"},
    {LineEnds::join, "join", "Ignored", "For listings that are wrapped in the middle of numbers"},
    {LineEnds::separate, "separate", "Separators", "Treated as spaces between numbers"},
}};

constexpr std::array<Choice<TurnPolicy>, 6> of_turns{{
    {TurnPolicy::minority, "minority", "Minority", "Connects the locally less frequent colour"},
    {TurnPolicy::majority, "majority", "Majority", "Connects the locally more frequent colour"},
    {TurnPolicy::connect_black, "black", "Black", "Connects dark areas"},
    {TurnPolicy::connect_white, "white", "White", "Connects bright areas"},
    {TurnPolicy::left, "left", "Left", "Outlines always turn left"},
    {TurnPolicy::right, "right", "Right", "Outlines always turn right"},
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
