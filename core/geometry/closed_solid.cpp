#include "core/geometry/closed_solid.h"

#include "core/base/error.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

namespace millwright::geometry {

namespace {

/// For each position the number of the first equal one.
std::vector<int> welded(const std::vector<Vec3>& positions) {
    std::map<std::tuple<double, double, double>, int> first;
    std::vector<int> number;
    number.reserve(positions.size());
    for (const Vec3& position : positions) {
        const auto next = static_cast<int>(number.size());
        number.push_back(first.try_emplace({position.x(), position.y(), position.z()}, next).first->second);
    }
    return number;
}

double six_volumes(const SolidMesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto at = [&](int n) { return mesh.positions[static_cast<std::size_t>(n)]; };
        sum += at(a).dot(at(b).cross(at(c)));
    }
    return sum;
}

} // namespace

bool is_closed(const SolidMesh& mesh) {
    const auto count = static_cast<int>(mesh.positions.size());
    const std::vector<int> number = welded(mesh.positions);
    std::map<std::pair<int, int>, int> passes; // forwards less backwards, from the lower to the higher number
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const int from = triangle[k], to = triangle[(k + 1) % 3];
            expects(from >= 0 && from < count && to >= 0 && to < count, "a corner is one of the mesh");
            const int a = number[static_cast<std::size_t>(from)], b = number[static_cast<std::size_t>(to)];
            passes[std::minmax(a, b)] += (a < b) - (b < a);
        }
    }
    return std::ranges::all_of(passes, [](const auto& edge) { return edge.second == 0; }) &&
           six_volumes(mesh) > 0.0;
}

} // namespace millwright::geometry
