#include "ui/workspaces/stock_file.h"

#include "core/base/error.h"
#include "core/geometry/glb.h"
#include "core/simulation/cut_mesh.h"
#include "ui/viewport/stock_sight.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace millwright::actions {

namespace {

namespace fs = std::filesystem;
using Rgb = std::array<std::uint8_t, 3>;

constexpr double whole = 255.0;

std::string ending_of(const fs::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(
        ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

std::vector<Rgb> colors_of(const plan::StockPicture& picture, double tolerance) {
    std::vector<Rgb> colors;
    colors.reserve(picture.mesh.points.size());
    for (std::size_t n = 0; n < picture.mesh.points.size(); ++n) {
        const glm::vec3 color = viewport::stock_color(picture, n, tolerance);
        Rgb rgb{};
        for (int k = 0; k < 3; ++k) {
            rgb[static_cast<std::size_t>(k)] =
                static_cast<std::uint8_t>(std::lround(whole * static_cast<double>(color[k])));
        }
        colors.push_back(rgb);
    }
    return colors;
}

/// The shades of the excess in steps, so that there are few materials.
Rgb coarse(Rgb color) {
    constexpr int step = 16;
    for (std::uint8_t& part : color) {
        part = static_cast<std::uint8_t>(part / step * step + step / 2);
    }
    return color;
}

std::string glb_bytes(const plan::StockPicture& picture, double tolerance) {
    const std::vector<Rgb> colors = colors_of(picture, tolerance);
    const std::vector<Vec3> normals = simulation::normals_of(picture.mesh);
    geometry::SolidBody body{.name = "cut part", .meshes = {}};
    std::map<Rgb, std::size_t> mesh_of;
    for (const std::array<int, 3>& triangle : picture.mesh.triangles) {
        const Rgb color = coarse(colors[static_cast<std::size_t>(triangle[0])]);
        const auto [known, is_new] = mesh_of.emplace(color, body.meshes.size());
        if (is_new) {
            body.meshes.emplace_back();
            body.meshes.back().color = Vec3(color[0], color[1], color[2]) / whole;
        }
        geometry::SolidMesh& mesh = body.meshes[known->second];
        const auto first = static_cast<int>(mesh.positions.size());
        for (const int corner : triangle) {
            mesh.positions.push_back(picture.mesh.points[static_cast<std::size_t>(corner)]);
            mesh.normals.push_back(normals[static_cast<std::size_t>(corner)]);
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return geometry::glb_of({{.body = std::move(body)}}, "cut part");
}

} // namespace

bool is_stock_file(const fs::path& file) {
    const std::string ending = ending_of(file);
    return ending == ".stl" || ending == ".ply" || ending == ".glb";
}

std::string stock_file_bytes(const plan::StockPicture& picture, double tolerance, const fs::path& file) {
    const std::string ending = ending_of(file);
    if (!is_stock_file(file)) {
        throw Error("the cut part cannot be written to this type of file",
                    file,
                    "use a name ending in .stl, .ply or .glb");
    }
    if (picture.mesh.triangles.empty()) {
        throw Error("nothing is left of the stock", file, "simulate with a larger one");
    }
    if (ending == ".stl") {
        return simulation::stl_of(picture.mesh);
    }
    return ending == ".ply" ? simulation::ply_of(
                                  picture.mesh.points, picture.mesh.triangles, colors_of(picture, tolerance))
                            : glb_bytes(picture, tolerance);
}

} // namespace millwright::actions
