// Which triangle of a flattened sheet a place of the square lies in.
#pragma once

#include "core/region/flattening.h"

#include <array>
#include <memory>
#include <vector>

namespace millwright::region {

/// A place on one of the faces.
struct OnFace {
    int face = 0;
    Vec2 uv = Vec2::Zero();
};

class PlaceLookup {
public:
    PlaceLookup(std::shared_ptr<const FaceMesh> mesh, std::vector<Vec2> places);

    /// By the triangle that holds the place, straight between its corners; beside the sheet by one near it.
    [[nodiscard]] OnFace at(const Vec2& place) const;
    /// A box of the square that holds what lies on a part of a face; empty where no triangle does.
    [[nodiscard]] Eigen::AlignedBox2d places_of(int face, const Vec2& low, const Vec2& high) const;

private:
    static constexpr int side = 64; // cells
    [[nodiscard]] std::array<double, 3> shares(const FaceTriangle& triangle, const Vec2& place) const;

    std::shared_ptr<const FaceMesh> mesh_;
    std::vector<Vec2> places_;
    std::vector<std::vector<int>> cells_; ///< triangles whose box meets each
};

} // namespace millwright::region
