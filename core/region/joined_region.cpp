#include "core/region/joined_region.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/region/internal/joined_faces.h"
#include "core/region/internal/position_map.h"
#include "core/region/internal/side_welding.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace millwright::region {

namespace {

void refuse_sharp_borders(std::span<const ExactFace> faces, const FaceMesh& mesh) {
    for (const FaceBorder& border : mesh.borders) {
        for (std::size_t n = 0; n < border.points.size() && border.sides.size() == 2; ++n) {
            std::array<std::optional<Vec3>, 2> normals;
            for (std::size_t k = 0; k < 2; ++k) {
                const FaceBorder::Side& side = border.sides[k];
                const Vec2 uv = place_on_side(side.side, side.along[n]);
                normals[k] = faces[static_cast<std::size_t>(side.face)].surface.unit_normal(uv.x(), uv.y());
                if (normals[k] && mesh.turned_over[static_cast<std::size_t>(side.face)]) {
                    *normals[k] *= -1.0;
                }
            }
            if (!normals[0] || !normals[1]) {
                continue;
            }
            if (const double angle = angle_between(*normals[0], *normals[1]); angle > sharp_border) {
                throw Error(fmt::format("faces {} and {} meet at an edge of {:.1f} degrees, at {}",
                                        faces[static_cast<std::size_t>(border.sides[0].face)].number,
                                        faces[static_cast<std::size_t>(border.sides[1].face)].number,
                                        to_degrees(angle),
                                        place_text(mesh.points[static_cast<std::size_t>(border.points[n])])),
                            {},
                            fmt::format("choose faces that continue one another, up to {:.1f} degrees apart",
                                        to_degrees(sharp_border)));
            }
        }
    }
}

/// The surface has to look to the side of its first face at every place.
void refuse_folds(const JoinedSurface& surface, const FaceMesh& mesh, const Progress& progress) {
    constexpr int places = 64;
    for (int i = 0; i < places; ++i) {
        progress.check();
        for (int j = 0; j < places; ++j) {
            const Vec2 at((i + 0.5) / places, (j + 0.5) / places);
            const geometry::SurfaceDerivatives of = surface.derivatives(at.x(), at.y());
            const OnFace on = surface.on_face(at);
            const auto exact =
                surface.faces()[static_cast<std::size_t>(on.face)].unit_normal(on.uv.x(), on.uv.y());
            const double sense = mesh.turned_over[static_cast<std::size_t>(on.face)] ? -1.0 : 1.0;
            if (exact && !(sense * of.du.cross(of.dv).dot(*exact) > 0.0)) {
                throw Error(fmt::format("the surface over the faces folds at {}", place_text(of.position)),
                            {},
                            "choose other corners, or fewer faces");
            }
        }
    }
}

double boundary_off(const JoinedSurface& surface) {
    constexpr int steps = 256;
    double most = 0.0;
    for (int side = 0; side < 4; ++side) {
        for (int n = 0; n < steps; ++n) {
            const Vec2 place = place_on_side(side, static_cast<double>(n) / steps);
            most = std::max(most, surface.off_boundary(place).value_or(0.0));
        }
    }
    return most;
}

} // namespace

JoinedRegion
joined_region(std::span<const ExactFace> faces, const JoinSettings& settings, const Progress& progress) {
    progress.report(0.0, "welding the faces");
    auto mesh = std::make_shared<const FaceMesh>(face_mesh(faces, settings.mesh, progress.part(0.0, 0.4)));
    refuse_sharp_borders(faces, *mesh);
    progress.report(0.4, "spreading the faces out flat");
    std::optional<SheetCorners> corners;
    if (settings.corners) {
        corners = corners_near(*mesh, *settings.corners);
    }
    Flattening flat = flattened(faces, *mesh, corners, progress.part(0.4, 0.8));
    progress.report(0.8, "laying a smooth surface over the faces");
    std::vector<geometry::BsplineSurface> surfaces;
    for (const ExactFace& face : faces) {
        surfaces.push_back(face.surface);
    }
    JoinedSurface surface(std::move(surfaces),
                          position_map(faces, *mesh, flat),
                          std::make_shared<const PlaceLookup>(mesh, flat.places),
                          std::make_shared<const FaceNeighbours>(faces.size(), *mesh));
    refuse_folds(surface, *mesh, progress.part(0.9, 1.0));
    const double off = boundary_off(surface);
    progress.report(1.0);
    return {Region(std::make_shared<const JoinedFaces>(std::move(surface))), *mesh, std::move(flat), off};
}

} // namespace millwright::region
