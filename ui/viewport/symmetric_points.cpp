#include "ui/viewport/symmetric_points.h"

#include <set>

namespace millwright::viewport {

std::vector<SharedPoint> with_images(const NetOf& net_of,
                                     const geometry::NetSymmetry& symmetry,
                                     const std::vector<ControlPointId>& points,
                                     const ControlPointId& leads) {
    std::set<ControlPointId> ids;
    for (const ControlPointId& id : points) {
        for (const geometry::NetPlace& place : images(net_of(id.patch), symmetry, {id.i, id.j})) {
            ids.insert({id.patch, place.i, place.j});
        }
    }
    const auto side = [&](const ControlPointId& id) {
        return side_of(net_of(id.patch), symmetry, {id.i, id.j});
    };
    std::vector<SharedPoint> shared;
    for (const ControlPointId& id : ids) {
        shared.push_back({id, geometry::share_of_way(side(id), side(leads))});
    }
    return shared;
}

} // namespace millwright::viewport
