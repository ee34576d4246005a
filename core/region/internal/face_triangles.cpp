#include "core/region/internal/face_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace millwright::region {

namespace {

/// A point of the mesh and its parameters on the face.
struct Place {
    int point = 0;
    Vec2 uv = Vec2::Zero();
};

class FaceTriangulation {
public:
    FaceTriangulation(
        int face, const ExactFace& of, const WeldedSides& welded, double spacing, FaceMesh& mesh)
        : face_(face), surface_(of.surface), welded_(welded), spacing_(spacing), mesh_(mesh) {}

    /// A raster inside, and a strip between it and each side.
    void run() {
        std::array<std::vector<Place>, 4> sides;
        for (int side = 0; side < 4; ++side) {
            sides[static_cast<std::size_t>(side)] = border(side);
        }
        const std::vector<double> us = lines(sides, 0), vs = lines(sides, 1);
        rows_ = static_cast<int>(us.size());
        columns_ = static_cast<int>(vs.size());
        add_raster(us, vs);
        for (int i = 0; i + 1 < rows_; ++i) {
            for (int j = 0; j + 1 < columns_; ++j) {
                add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
                add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
            }
        }
        for (int side = 0; side < 4; ++side) {
            add_strip(sides[static_cast<std::size_t>(side)], inner_row(side), side % 2);
        }
    }

private:
    [[nodiscard]] const Place& at(int i, int j) const {
        return inside_[static_cast<std::size_t>(i * columns_ + j)];
    }

    /// The points of a side from its start to its end.
    [[nodiscard]] std::vector<Place> border(int side) const {
        std::vector<std::pair<double, int>> points;
        for (const FaceBorder& border : welded_.borders) {
            for (const FaceBorder::Side& own : border.sides) {
                if (own.face == face_ && own.side == side) {
                    for (std::size_t n = 0; n < own.along.size(); ++n) {
                        points.emplace_back(own.along[n], border.points[n]);
                    }
                }
            }
        }
        if (points.empty()) { // all of it one point
            const auto& corners = welded_.corners[static_cast<std::size_t>(face_)];
            points = {{0.0, corners[static_cast<std::size_t>(side)]},
                      {1.0, corners[static_cast<std::size_t>((side + 1) % 4)]}};
        }
        std::ranges::sort(points);
        points.erase(std::unique(points.begin(), points.end()), points.end()); // ends of pieces
        std::vector<Place> places;
        for (const auto& [along, point] : points) {
            places.push_back({point, place_on_side(side, along)});
        }
        return places;
    }

    /// Lines inside that cut the parameter along `side`: as many as end at the sides that they run to, or as
    /// the face is long for its spacing.
    [[nodiscard]] std::vector<double> lines(const std::array<std::vector<Place>, 4>& sides,
                                            std::size_t side) const {
        constexpr int fewest = 2, most = 2000;
        const SideCurve middle(surface_, static_cast<int>(side), 0.5);
        const int by_length =
            static_cast<int>(std::min<double>(std::round(middle.length() / spacing_), most)) - 1;
        const auto ends = static_cast<int>(std::max(sides[side].size(), sides[side + 2].size())) - 2;
        const int count = std::max({fewest, by_length, ends});
        std::vector<double> places;
        for (int n = 1; n <= count; ++n) {
            places.push_back(middle.along_at(middle.length() * n / (count + 1)));
        }
        return places;
    }

    void add_raster(const std::vector<double>& us, const std::vector<double>& vs) {
        for (const double u : us) {
            for (const double v : vs) {
                inside_.push_back({static_cast<int>(mesh_.points.size()), {u, v}});
                mesh_.points.push_back(surface_.position(u, v));
            }
        }
    }

    /// The row of the raster beside a side, in the side's sense.
    [[nodiscard]] std::vector<Place> inner_row(int side) const {
        std::vector<Place> row;
        const int count = side % 2 == 0 ? rows_ : columns_;
        for (int n = 0; n < count; ++n) {
            const int k = side < 2 ? n : count - 1 - n;
            row.push_back(side == 0   ? at(k, 0)
                          : side == 1 ? at(rows_ - 1, k)
                          : side == 2 ? at(k, columns_ - 1)
                                      : at(0, k));
        }
        return row;
    }

    /// Goes on where the next edge lies nearer: on the border or on the row.
    void add_strip(const std::vector<Place>& border, const std::vector<Place>& row, int axis) {
        const double sense = border.front().uv[axis] < border.back().uv[axis] ? 1.0 : -1.0;
        std::size_t i = 0, j = 0;
        while (i + 1 < border.size() || j + 1 < row.size()) {
            const auto edge = [&](const std::vector<Place>& line, std::size_t n) {
                return sense * (line[n].uv[axis] + line[n + 1].uv[axis]);
            };
            const bool on_border =
                j + 1 >= row.size() || (i + 1 < border.size() && edge(border, i) < edge(row, j));
            if (on_border) {
                add(border[i], border[i + 1], row[j]);
                ++i;
            } else {
                add(border[i], row[j + 1], row[j]);
                ++j;
            }
        }
    }

    void add(const Place& a, const Place& b, const Place& c) {
        if (a.point != b.point && b.point != c.point && c.point != a.point) {
            mesh_.triangles.push_back({face_, {a.point, b.point, c.point}, {a.uv, b.uv, c.uv}});
        }
    }

    int face_;
    const geometry::BsplineSurface& surface_;
    const WeldedSides& welded_;
    double spacing_; ///< mm
    FaceMesh& mesh_;
    int rows_ = 0, columns_ = 0; ///< of the raster inside: along u and v
    std::vector<Place> inside_;
};

} // namespace

void add_triangles(int face, const ExactFace& of, const WeldedSides& welded, double spacing, FaceMesh& mesh) {
    FaceTriangulation(face, of, welded, spacing, mesh).run();
}

} // namespace millwright::region
