#include "core/region/internal/sheet_checks.h"

#include "core/base/error.h"
#include "core/geometry/closest_point.h"
#include "core/region/internal/side_welding.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace millwright::region {

namespace {

int number(std::span<const ExactFace> faces, int face) {
    return faces[static_cast<std::size_t>(face)].number;
}

const Vec3& point(const FaceMesh& mesh, int n) {
    return mesh.points[static_cast<std::size_t>(n)];
}

Vec3 middle(const FaceMesh& mesh, const FaceBorder& border) {
    return point(mesh, border.points[border.points.size() / 2]);
}

/// Where the faces that hang together with the first come nearest to the others.
[[noreturn]] void
refuse_apart(std::span<const ExactFace> faces, const FaceMesh& mesh, const std::vector<bool>& reached) {
    double least = std::numeric_limits<double>::infinity();
    int own = 0, other = 0, at = 0;
    for (const FaceBorder& a : mesh.borders) {
        for (const FaceBorder& b : mesh.borders) {
            const int face_a = a.sides.front().face, face_b = b.sides.front().face;
            if (!reached[static_cast<std::size_t>(face_a)] || reached[static_cast<std::size_t>(face_b)]) {
                continue;
            }
            for (const int p : a.points) {
                for (const int q : b.points) {
                    const double apart = (point(mesh, p) - point(mesh, q)).norm();
                    if (apart < least) {
                        least = apart, own = face_a, other = face_b, at = p;
                    }
                }
            }
        }
    }
    const std::string place = place_text(point(mesh, at));
    throw Error(least > 0.0 ? fmt::format("faces {} and {} do not touch: they are {:.4g} mm apart, at {}",
                                          number(faces, own),
                                          number(faces, other),
                                          least,
                                          place)
                            : fmt::format("faces {} and {} touch at a point alone, at {}",
                                          number(faces, own),
                                          number(faces, other),
                                          place),
                {},
                "choose faces that share a border, or a larger tolerance");
}

/// An edge of a triangle, with the triangle on its left.
using Edge = std::pair<int, int>;

std::vector<Edge> directed_edges(const FaceMesh& mesh) {
    std::vector<Edge> edges;
    for (const FaceTriangle& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            edges.emplace_back(triangle.corners[k], triangle.corners[(k + 1) % 3]);
        }
    }
    std::ranges::sort(edges);
    return edges;
}

/// Boundaries, each from its least point.
std::vector<std::vector<int>> loops_of(const FaceMesh& mesh, const std::vector<Edge>& edges) {
    std::vector<int> next(mesh.points.size(), -1);
    for (const auto& [from, to] : edges) {
        if (std::ranges::binary_search(edges, Edge{to, from})) {
            continue;
        }
        if (next[static_cast<std::size_t>(from)] >= 0) {
            throw Error("faces touch at a point alone, at " + place_text(point(mesh, from)),
                        {},
                        "choose faces that share whole borders");
        }
        next[static_cast<std::size_t>(from)] = to;
    }
    std::vector<std::vector<int>> loops;
    for (int start = 0; start < std::ssize(next); ++start) {
        std::vector<int> loop;
        for (int at = start; next[static_cast<std::size_t>(at)] >= 0;) {
            loop.push_back(at);
            at = std::exchange(next[static_cast<std::size_t>(at)], -1);
        }
        if (!loop.empty()) {
            loops.push_back(std::move(loop));
        }
    }
    return loops;
}

double length(const FaceMesh& mesh, const std::vector<int>& loop) {
    double sum = 0.0;
    for (std::size_t n = 0; n < loop.size(); ++n) {
        sum += (point(mesh, loop[(n + 1) % loop.size()]) - point(mesh, loop[n])).norm();
    }
    return sum;
}

/// Across the border, from it into the face, of unit length.
Vec3 inwards(const geometry::BsplineSurface& face, const FaceBorder::Side& side, std::size_t n) {
    const Vec2 uv = place_on_side(side.side, side.along[n]);
    const geometry::SurfaceDerivatives at = face.derivatives(uv.x(), uv.y());
    const bool along_u = side.side % 2 == 0;
    const Vec3 along = (along_u ? at.du : at.dv).normalized();
    const Vec3 across =
        side.side == 0 || side.side == 3 ? (along_u ? at.dv : at.du) : Vec3(along_u ? -at.dv : -at.du);
    return (across - across.dot(along) * along).normalized();
}

void refuse_folded_back(std::span<const ExactFace> faces, const FaceMesh& mesh) {
    constexpr double closed = 0.9998; // cosine of 1.1 degrees
    for (const FaceBorder& border : mesh.borders) {
        if (border.sides.size() < 2) {
            continue;
        }
        const std::size_t n = border.points.size() / 2;
        std::array<Vec3, 2> in;
        for (std::size_t k = 0; k < 2; ++k) {
            in[k] =
                inwards(faces[static_cast<std::size_t>(border.sides[k].face)].surface, border.sides[k], n);
        }
        if (in[0].dot(in[1]) > closed) {
            throw Error(fmt::format("faces {} and {} lie on one another beside their border, at {}",
                                    number(faces, border.sides[0].face),
                                    number(faces, border.sides[1].face),
                                    place_text(point(mesh, border.points[n]))),
                        {},
                        "choose one of them");
        }
    }
}

/// What lies off a side of a face may well be near to it.
bool is_inside(const Vec2& parameters) {
    constexpr double on_side = 1e-6;
    return parameters.minCoeff() > on_side && parameters.maxCoeff() < 1.0 - on_side;
}

/// Per point, the faces that it belongs to.
std::vector<std::vector<int>> faces_at_points(const FaceMesh& mesh) {
    std::vector<std::vector<int>> faces(mesh.points.size());
    for (const FaceTriangle& triangle : mesh.triangles) {
        for (const int corner : triangle.corners) {
            auto& own = faces[static_cast<std::size_t>(corner)];
            if (std::ranges::find(own, triangle.face) == own.end()) {
                own.push_back(triangle.face);
            }
        }
    }
    return faces;
}

} // namespace

std::vector<bool> turned_faces(std::span<const ExactFace> faces, const FaceMesh& mesh) {
    std::vector<std::optional<bool>> turned(faces.size());
    std::vector<int> open{0};
    turned[0] = false;
    while (!open.empty()) {
        const int face = open.back();
        open.pop_back();
        for (const FaceBorder& border : mesh.borders) {
            for (std::size_t k = 0; k < 2 && border.sides.size() == 2; ++k) {
                const FaceBorder::Side& own = border.sides[k];
                const FaceBorder::Side& other = border.sides[1 - k];
                if (own.face != face) {
                    continue;
                }
                // Both counter-clockwise: a border that is run through in opposite senses needs no turn.
                const bool wanted = *turned[static_cast<std::size_t>(face)] != (own.rises() == other.rises());
                auto& there = turned[static_cast<std::size_t>(other.face)];
                if (there && *there != wanted) {
                    throw Error(fmt::format("the faces have a single side, like a Moebius strip: {} and {} "
                                            "look to opposite sides, at {}",
                                            number(faces, face),
                                            number(faces, other.face),
                                            place_text(middle(mesh, border))),
                                {},
                                "leave one of them out");
                }
                if (!there) {
                    there = wanted;
                    open.push_back(other.face);
                }
            }
        }
    }
    std::vector<bool> reached, result;
    for (const auto& one : turned) {
        reached.push_back(one.has_value());
        result.push_back(one.value_or(false));
    }
    if (std::ranges::find(reached, false) != reached.end()) {
        refuse_apart(faces, mesh, reached);
    }
    return result;
}

std::vector<int> boundary_of(const FaceMesh& mesh) {
    const std::vector<Edge> edges = directed_edges(mesh);
    std::vector<std::vector<int>> loops = loops_of(mesh, edges);
    if (loops.empty()) {
        throw Error("the faces form a closed shell without a boundary, around " + place_text(point(mesh, 0)),
                    {},
                    "leave a face out");
    }
    std::ranges::sort(loops, [&](const auto& a, const auto& b) { return length(mesh, a) > length(mesh, b); });
    if (loops.size() > 1) {
        throw Error(
            fmt::format("the faces leave {} inside or form a ring: a second boundary of {:.3f} mm, at {}",
                        loops.size() == 2 ? "a hole" : "holes",
                        length(mesh, loops[1]),
                        place_text(point(mesh, loops[1].front()))),
            {},
            "choose the faces that are missing there, or leave one out of a ring");
    }
    const std::ptrdiff_t undirected =
        (std::ssize(edges) + std::ssize(loops.front())) / 2; // those of the boundary are there once
    if (std::ssize(mesh.points) - undirected + std::ssize(mesh.triangles) != 1) {
        throw Error("the faces form a handle or touch at a point, and no single sheet, near " +
                        place_text(point(mesh, loops.front().front())),
                    {},
                    "leave a face out");
    }
    return std::move(loops.front());
}

void refuse_overlaps(std::span<const ExactFace> faces,
                     const FaceMesh& mesh,
                     double tolerance,
                     const Progress& progress) {
    refuse_folded_back(faces, mesh);
    const std::vector<std::vector<int>> own = faces_at_points(mesh);
    for (int face = 0; face < std::ssize(faces); ++face) {
        const geometry::BsplineSurface& surface = faces[static_cast<std::size_t>(face)].surface;
        std::optional<geometry::ClosestPointSearch> search;
        for (std::size_t n = 0; n < mesh.points.size(); ++n) {
            if (std::ranges::find(own[n], face) != own[n].end() ||
                surface.control_box().exteriorDistance(mesh.points[n]) > tolerance) {
                continue;
            }
            progress.check();
            if (!search) {
                search.emplace(surface);
            }
            const geometry::ClosestPoint at = search->closest(mesh.points[n]);
            if (at.distance <= tolerance && is_inside(at.parameters)) {
                throw Error(fmt::format("faces {} and {} overlap or touch within a face, at {}",
                                        number(faces, own[n].front()),
                                        number(faces, face),
                                        place_text(mesh.points[n])),
                            {},
                            "choose one of them");
            }
        }
    }
}

} // namespace millwright::region
