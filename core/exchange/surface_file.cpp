#include "core/exchange/surface_file.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/exchange/cad_file.h"
#include "core/exchange/internal/file_kind.h"
#include "core/geometry/glb.h"

#include <assimp/Exporter.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace millwright::exchange {

namespace {

using geometry::Mesh;

std::vector<Mesh> tessellated(const geometry::Surface& surface, double tolerance, const Progress& progress) {
    std::vector<Mesh> meshes;
    for (const geometry::BezierPatch& patch : surface.patches()) {
        progress.check();
        const Steps steps = steps_within(patch, tolerance);
        meshes.push_back(geometry::tessellate(patch, steps.u, steps.v));
        progress.report(static_cast<double>(meshes.size()) / surface.patch_count(), "creating triangles");
    }
    return meshes;
}

std::string name_of_patch(std::size_t n) {
    return fmt::format("patch {}", n + 1);
}

std::string glb_text(const std::vector<Mesh>& meshes, const std::string& name) {
    std::vector<geometry::PlacedBody> bodies;
    for (std::size_t n = 0; n < meshes.size(); ++n) {
        geometry::SolidMesh mesh{.color = Vec3(0.72, 0.75, 0.78),
                                 .positions = meshes[n].positions,
                                 .normals = meshes[n].normals,
                                 .triangles = meshes[n].triangles};
        bodies.push_back({.body = {.name = name_of_patch(n), .meshes = {std::move(mesh)}}});
    }
    return geometry::glb_of(bodies, name);
}

aiVector3D vector_of(const Vec3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// The library owns what it is given, by plain pointers.
aiMesh* mesh_for_library(const Mesh& mesh, const std::string& name) {
    auto result = std::make_unique<aiMesh>();
    result->mName = name;
    result->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    result->mNumVertices = static_cast<unsigned>(mesh.positions.size());
    result->mVertices = new aiVector3D[mesh.positions.size()];
    result->mNormals = new aiVector3D[mesh.positions.size()];
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        result->mVertices[n] = vector_of(mesh.positions[n]);
        result->mNormals[n] = vector_of(mesh.normals[n]);
    }
    result->mNumFaces = static_cast<unsigned>(mesh.triangles.size());
    result->mFaces = new aiFace[mesh.triangles.size()];
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        aiFace& face = result->mFaces[n];
        face.mNumIndices = 3;
        face.mIndices = new unsigned[3];
        std::ranges::transform(
            mesh.triangles[n], face.mIndices, [](int i) { return static_cast<unsigned>(i); });
    }
    return result.release();
}

std::unique_ptr<aiScene> scene_of(const std::vector<Mesh>& meshes) {
    auto scene = std::make_unique<aiScene>();
    const auto count = static_cast<unsigned>(meshes.size());
    scene->mMaterials = new aiMaterial* [1] { new aiMaterial() };
    scene->mNumMaterials = 1;
    scene->mMeshes = new aiMesh* [count] {};
    scene->mNumMeshes = count;
    scene->mRootNode = new aiNode("design");
    scene->mRootNode->mMeshes = new unsigned[count];
    scene->mRootNode->mNumMeshes = count;
    for (unsigned n = 0; n < count; ++n) {
        scene->mMeshes[n] = mesh_for_library(meshes[n], name_of_patch(n));
        scene->mRootNode->mMeshes[n] = n;
    }
    return scene;
}

std::string triangles_text(const std::vector<Mesh>& meshes,
                           const std::string& format,
                           const std::filesystem::path& file) {
    const std::unique_ptr<aiScene> scene = scene_of(meshes);
    Assimp::Exporter exporter;
    const aiExportDataBlob* const blob = exporter.ExportToBlob(scene.get(), format, 0U);
    if (blob == nullptr) {
        throw Error(fmt::format("the triangles cannot be written: {}", exporter.GetErrorString()), file);
    }
    return {static_cast<const char*>(blob->data), blob->size};
}

/// As the library calls it; empty for a kind that it does not write.
std::string library_format(const std::string& kind) {
    return kind == "stl" ? "stlb" : kind == "obj" ? "objnomtl" : kind == "ply" ? "plyb" : "";
}

} // namespace

Steps steps_within(const geometry::BezierPatch& patch, double tolerance) {
    expects(std::isfinite(tolerance) && tolerance > 0.0, "a tolerance is above zero");
    constexpr int raster = 32;
    constexpr double between_samples = 1.1;
    constexpr double most = 1000.0;
    double uu = 0.0;
    double uv = 0.0;
    double vv = 0.0;
    for (int i = 0; i <= raster; ++i) {
        for (int j = 0; j <= raster; ++j) {
            const auto at =
                patch.derivatives(static_cast<double>(i) / raster, static_cast<double>(j) / raster);
            uu = std::max(uu, at.duu.norm());
            uv = std::max(uv, at.duv.norm());
            vv = std::max(vv, at.dvv.norm());
        }
    }
    // A linear interpolant misses by at most (uu h^2 + 2 uv h k + vv k^2) / 8 (Filip, Magedson and Markot
    // 1986): a third of the tolerance for each of the three.
    const double third = 8.0 * tolerance / (3.0 * between_samples);
    const double nu = std::max(1.0, std::sqrt(uu / third));
    const double nv = std::max(1.0, std::sqrt(vv / third));
    const double mixed = std::max(1.0, std::sqrt(2.0 * uv / (nu * nv * third)));
    const auto count = [&](double n) { return static_cast<int>(std::min(std::ceil(n * mixed), most)); };
    return {count(nu), count(nv)};
}

bool is_surface_file(const std::filesystem::path& file) {
    constexpr std::array<std::string_view, 6> kinds{"step", "stp", "glb", "stl", "obj", "ply"};
    return std::ranges::find(kinds, kind_of(file)) != kinds.end();
}

void write_surface(const geometry::Surface& design,
                   const std::filesystem::path& file,
                   double tolerance,
                   const Progress& progress) {
    const std::string kind = kind_of(file);
    if (!is_surface_file(file)) {
        throw Error("a design cannot be written as this file type",
                    file,
                    "use a name ending in .step, .glb, .stl, .obj or .ply");
    }
    const geometry::Surface surface = design.in_patches();
    if (kind == "step" || kind == "stp") {
        write_step(surface, file, progress);
        return;
    }
    const std::vector<Mesh> meshes = tessellated(surface, tolerance, progress.part(0.0, 0.7));
    progress.report(0.7, "writing the file");
    const std::string text = kind == "glb" ? glb_text(meshes, file.stem().string())
                                           : triangles_text(meshes, library_format(kind), file);
    progress.check();
    write_file(file, text);
    progress.report(1.0);
}

} // namespace millwright::exchange
