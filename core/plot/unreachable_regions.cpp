#include "core/plot/unreachable_regions.h"

#include "core/plot/internal/clipper_paths.h"

namespace millwright::plot {

std::size_t count_unreachable_regions(const Region& region, const CompensationSettings& settings) {
    if (settings.side == CutterSide::on_line) {
        return 0;
    }
    ClipperLib::Clipper clipper;
    clipper.AddPaths(internal::to_clipper(region), ClipperLib::ptSubject, true);
    ClipperLib::PolyTree tree;
    clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftEvenOdd);
    const bool holes = settings.side == CutterSide::outside;
    const double radius = settings.tool_diameter / 2.0;
    std::size_t count = 0;
    for (const ClipperLib::PolyNode* part = tree.GetFirst(); part != nullptr; part = part->GetNext()) {
        if (part->IsHole() != holes) {
            continue;
        }
        ClipperLib::Paths rings = {part->Contour};
        for (const ClipperLib::PolyNode* within : part->Childs) {
            rings.push_back(within->Contour);
        }
        const ClipperLib::Paths left =
            internal::offset_paths(rings, -radius, settings.corners, settings.arc_tolerance);
        count += left.empty() ? 1 : 0;
    }
    return count;
}

} // namespace millwright::plot
