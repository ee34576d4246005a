#include "core/simulation/stock.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/simulation/internal/mesh_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::simulation {

namespace {

template <class... Each> struct Overloaded : Each... { using Each::operator()...; };

template <class... Each> Overloaded(Each...) -> Overloaded<Each...>; // clang 14 deduces none

std::string fault_of_box(const BoxStock& box) {
    if (!is_finite(box.low) || !is_finite(box.high)) {
        return "the corners of a box are finite";
    }
    return (box.high - box.low).minCoeff() > 0.0 ? std::string() : "the edges of a box are longer than 0 mm";
}

std::string fault_of_cylinder(const CylinderStock& cylinder) {
    const bool finite = is_finite(cylinder.base) && std::isfinite(cylinder.diameter) &&
                        std::isfinite(cylinder.bore) && std::isfinite(cylinder.length);
    if (!finite || !(cylinder.diameter > 0.0) || !(cylinder.length > 0.0)) {
        return "a cylinder has a diameter and a length above 0 mm";
    }
    return cylinder.bore >= 0.0 && cylinder.bore < cylinder.diameter
               ? std::string()
               : fmt::format("a bore of {:.6g} mm does not fit into a diameter of {:.6g} mm",
                             cylinder.bore,
                             cylinder.diameter);
}

/// Where a line at distance `offset` from the middle of a circle is inside: from -half to half.
double half_chord(double diameter, double offset) {
    const double square = 0.25 * diameter * diameter - offset * offset;
    return square > 0.0 ? std::sqrt(square) : 0.0;
}

std::vector<Interval> along(const CylinderStock& cylinder, const Vec3& at, int k) {
    const double low = cylinder.base[cylinder.axis];
    const Interval all{low, low + cylinder.length};
    const int u = (cylinder.axis + 1) % 3;
    const int v = (cylinder.axis + 2) % 3;
    if (k == cylinder.axis) {
        const double rho = std::hypot(at[u] - cylinder.base[u], at[v] - cylinder.base[v]);
        return rho < 0.5 * cylinder.diameter && rho >= 0.5 * cylinder.bore ? std::vector{all}
                                                                           : std::vector<Interval>{};
    }
    if (at[cylinder.axis] < all.from || at[cylinder.axis] > all.to) {
        return {};
    }
    const int other = k == u ? v : u;
    const double offset = at[other] - cylinder.base[other];
    const double middle = cylinder.base[k];
    const double outer = half_chord(cylinder.diameter, offset);
    const double inner = half_chord(cylinder.bore, offset);
    if (outer <= 0.0) {
        return {};
    }
    if (inner <= 0.0) {
        return {{middle - outer, middle + outer}};
    }
    return {{middle - outer, middle - inner}, {middle + inner, middle + outer}};
}

std::string number(double value) {
    return fmt::format("{:.6g}", value);
}

std::string numbers(const Vec3& p) {
    return fmt::format("{:.6g}, {:.6g}, {:.6g}", p.x(), p.y(), p.z());
}

} // namespace

std::string fault_of(const Stock& stock) {
    return std::visit(Overloaded{[](const BoxStock& box) { return fault_of_box(box); },
                                 [](const CylinderStock& cylinder) { return fault_of_cylinder(cylinder); },
                                 [](const std::shared_ptr<const MeshStock>& mesh) {
                                     return mesh->is_checked ? std::string() : fault_of_mesh(*mesh);
                                 }},
                      stock);
}

Box3 bounds(const Stock& stock) {
    return std::visit(
        Overloaded{[](const BoxStock& box) { return Box3(box.low, box.high); },
                   [](const CylinderStock& cylinder) {
                       Vec3 reach = Vec3::Constant(0.5 * cylinder.diameter);
                       reach[cylinder.axis] = 0.0;
                       Box3 box(Vec3(cylinder.base - reach), Vec3(cylinder.base + reach));
                       box.extend(Vec3(cylinder.base + reach + cylinder.length * Vec3::Unit(cylinder.axis)));
                       return box;
                   },
                   [](const std::shared_ptr<const MeshStock>& mesh) {
                       Box3 box;
                       for (const Vec3& point : mesh->points) {
                           box.extend(point);
                       }
                       return box;
                   }},
        stock);
}

double volume(const Stock& stock) {
    return std::visit(
        Overloaded{[](const BoxStock& box) { return (box.high - box.low).prod(); },
                   [](const CylinderStock& cylinder) {
                       const double square =
                           cylinder.diameter * cylinder.diameter - cylinder.bore * cylinder.bore;
                       return 0.25 * pi * square * cylinder.length;
                   },
                   [](const std::shared_ptr<const MeshStock>& mesh) { return mesh_volume(*mesh); }},
        stock);
}

std::vector<std::vector<Interval>> material_along(const Stock& stock, const RayGrid& grid) {
    if (const auto* mesh = std::get_if<std::shared_ptr<const MeshStock>>(&stock)) {
        return mesh_along(**mesh, grid);
    }
    std::vector<std::vector<Interval>> lines;
    const int u = (grid.k + 1) % 3;
    const int v = (grid.k + 2) % 3;
    for (int j = 0; j < grid.count[1]; ++j) {
        for (int i = 0; i < grid.count[0]; ++i) {
            Vec3 at = grid.first;
            at[u] += i * grid.pitch[u];
            at[v] += j * grid.pitch[v];
            if (const auto* box = std::get_if<BoxStock>(&stock)) {
                lines.push_back({{box->low[grid.k], box->high[grid.k]}});
            } else {
                lines.push_back(along(std::get<CylinderStock>(stock), at, grid.k));
            }
        }
    }
    return lines;
}

std::string to_text(const Stock& stock) {
    return std::visit(
        Overloaded{[](const BoxStock& box) {
                       const Vec3 size = box.high - box.low;
                       return fmt::format("box {} x {} x {} mm from {}",
                                          number(size.x()),
                                          number(size.y()),
                                          number(size.z()),
                                          numbers(box.low));
                   },
                   [](const CylinderStock& cylinder) {
                       const std::string bore =
                           cylinder.bore > 0.0 ? fmt::format(", bore {} mm", number(cylinder.bore)) : "";
                       return fmt::format("cylinder, diameter {} mm{}, length {} mm along {} from {}",
                                          number(cylinder.diameter),
                                          bore,
                                          number(cylinder.length),
                                          "XYZ"[cylinder.axis],
                                          numbers(cylinder.base));
                   },
                   [](const std::shared_ptr<const MeshStock>& mesh) {
                       return fmt::format("mesh of {} triangles", mesh->triangles.size());
                   }},
        stock);
}

} // namespace millwright::simulation
