#include "core/exchange/mesh_file.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/exchange/internal/file_kind.h"
#include "core/exchange/internal/mesh_readers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace millwright::exchange {

namespace {

/// For each point the first one, in the order of the file, that lies in the same place.
std::vector<int> first_in_place(const std::vector<Vec3>& points) {
    const auto key = [&](int n) {
        const Vec3& p = points[static_cast<std::size_t>(n)];
        return std::tuple(p.x(), p.y(), p.z());
    };
    std::vector<int> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, [&](int a, int b) { return key(a) < key(b); });
    std::vector<int> first(points.size());
    for (std::size_t n = 0; n < order.size(); ++n) {
        const int at = order[n];
        const bool same = n > 0 && key(order[n - 1]) == key(at);
        first[static_cast<std::size_t>(at)] = same ? first[static_cast<std::size_t>(order[n - 1])] : at;
    }
    return first;
}

/// Each place once, in the order of the file, and triangles with an area alone.
MeshFile joined(const TriangleMesh& soup) {
    const std::vector<int> first = first_in_place(soup.points);
    MeshFile result;
    std::vector<bool> used(soup.points.size(), false);
    const auto first_of = [&](int corner) {
        const int at = first[static_cast<std::size_t>(corner)];
        used[static_cast<std::size_t>(at)] = true;
        return at;
    };
    for (std::size_t n = 0; n < soup.triangles.size(); ++n) {
        const auto& [a, b, c] = soup.triangles[n];
        if (!(soup.doubled_area(n).norm() > 0.0)) {
            ++result.without_area;
            continue;
        }
        result.mesh.triangles.push_back({first_of(a), first_of(b), first_of(c)});
    }
    std::vector<int> number(soup.points.size(), -1);
    for (std::size_t n = 0; n < used.size(); ++n) {
        if (used[n]) {
            number[n] = static_cast<int>(result.mesh.points.size());
            result.mesh.points.push_back(soup.points[n]);
        }
    }
    for (std::array<int, 3>& triangle : result.mesh.triangles) {
        for (int& corner : triangle) {
            corner = number[static_cast<std::size_t>(corner)];
        }
    }
    return result;
}

} // namespace

bool is_mesh_file(const std::filesystem::path& file) {
    constexpr std::array<std::string_view, 3> kinds{"stl", "obj", "ply"};
    return std::ranges::find(kinds, kind_of(file)) != kinds.end();
}

MeshFile parse_mesh(std::string_view bytes,
                    const std::filesystem::path& file,
                    double mm_per_unit,
                    const Progress& progress) {
    expects(std::isfinite(mm_per_unit) && mm_per_unit > 0.0, "a unit of length is above zero");
    if (!is_mesh_file(file)) {
        throw Error("this file type cannot be read as a mesh", file, "use an STL, OBJ or PLY file");
    }
    if (bytes.empty()) {
        throw Error("the file is empty", file);
    }
    progress.report(0.0, "reading the mesh");
    PolygonSoup soup(file, mm_per_unit);
    const std::string kind = kind_of(file);
    if (kind == "stl") {
        read_stl(bytes, file, soup, progress);
    } else if (kind == "obj") {
        refuse_wide_text(bytes, file);
        read_obj(bytes, soup, progress);
    } else {
        constexpr std::size_t head = 64; // what follows may be binary
        refuse_wide_text(bytes.substr(0, head), file);
        read_ply(bytes, soup, progress);
    }
    progress.report(0.6, "joining points");
    std::vector<std::string> notes = soup.notes();
    MeshFile result = joined(std::move(soup).take());
    result.notes = std::move(notes);
    progress.check();
    if (result.mesh.triangles.empty()) {
        throw Error("the file contains no triangle with an area", file);
    }
    return result;
}

MeshFile read_mesh(const std::filesystem::path& file, double mm_per_unit, const Progress& progress) {
    return parse_mesh(read_file(file), file, mm_per_unit, progress);
}

} // namespace millwright::exchange
