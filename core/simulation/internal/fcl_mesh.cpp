#include "core/simulation/internal/fcl_mesh.h"

#include "core/base/error.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace millwright::simulation {

struct FclMesh::Model {
    fcl::BVHModel<fcl::OBBRSSd> tree;
};

FclMesh::FclMesh(const CollisionTriangles& surface) {
    auto model = std::make_unique<Model>();
    std::vector<fcl::Triangle> triangles;
    triangles.reserve(surface.triangles.size());
    for (const auto& [a, b, c] : surface.triangles) {
        triangles.emplace_back(
            static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c));
    }
    bool made = model->tree.beginModel() == fcl::BVH_OK;
    made = made && model->tree.addSubModel(surface.points, triangles) == fcl::BVH_OK;
    made = made && model->tree.endModel() == fcl::BVH_OK;
    expects(made, "FCL builds the tree of a mesh");
    model_ = std::move(model);
}

FclMesh::~FclMesh() = default;

std::optional<NearPlace>
FclMesh::nearest(const FclMesh& other, const Frame& this_T_other, double enough) const {
    // What is not nearer than the result that it begins with is left out.
    const fcl::DistanceRequestd request(true);
    fcl::DistanceResultd result(enough);
    fcl::distance(
        &model_->tree, Frame(Frame::Identity()), &other.model_->tree, this_T_other, request, result);
    if (!(result.min_distance < enough)) {
        return std::nullopt;
    }
    return NearPlace{std::max(result.min_distance, 0.0), result.nearest_points[0]};
}

} // namespace millwright::simulation
