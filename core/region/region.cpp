#include "core/region/region.h"

#include "core/base/error.h"
#include "core/region/internal/face_region.h"

#include <utility>

namespace millwright::region {

namespace {

const RegionKind& existing(const std::shared_ptr<const RegionKind>& kind) {
    expects(kind != nullptr, "a region is of some kind");
    return *kind;
}

} // namespace

Region::Region(geometry::BezierPatch patch, geometry::Trim trim)
    : Region(std::make_shared<const FaceRegion<geometry::BezierPatch>>(std::move(patch), std::move(trim))) {}

Region::Region(geometry::BsplineSurface face, geometry::Trim trim)
    : Region(std::make_shared<const FaceRegion<geometry::BsplineSurface>>(std::move(face), std::move(trim))) {
}

Region::Region(std::shared_ptr<const RegionKind> kind)
    : kind_(std::move(kind)), surface_(&existing(kind_).surface()) {}

std::shared_ptr<const geometry::ParametricSurface> Region::shared() const {
    return std::make_shared<const Region>(*this);
}

} // namespace millwright::region
