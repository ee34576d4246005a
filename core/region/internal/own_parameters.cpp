// A raster of faces that one surface was divided into: their parameters side by side are that surface's
// again.
#include "core/region/flattening.h"
#include "core/region/internal/distortion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::region {

namespace {

/// How a face lies in its cell: q = turn * (uv - 1/2) + 1/2, both in [0,1]^2.
struct Cell {
    Vec2 at = Vec2::Zero(); ///< whole numbers; the first face at (0,0)
    Eigen::Matrix2d turn = Eigen::Matrix2d::Identity();

    [[nodiscard]] Vec2 place(const Vec2& uv) const {
        return turn * (uv - Vec2::Constant(0.5)) + Vec2::Constant(0.5);
    }
};

/// Along a side of a face, counter-clockwise, and out of the face.
Vec2 tangent_of(int side) {
    return place_on_side(side, 1.0) - place_on_side(side, 0.0);
}
Vec2 outwards_of(int side) {
    const Vec2 along = tangent_of(side);
    return {along.y(), -along.x()};
}

bool is_whole(const FaceBorder::Side& side) {
    return std::abs(side.along.back() - side.along.front()) >= 1.0;
}

class Raster {
public:
    Raster(std::span<const ExactFace> faces, const FaceMesh& mesh)
        : faces_(faces), mesh_(mesh), cells_(faces.size()) {}

    std::optional<Flattening> run() {
        for (const FaceBorder& border : mesh_.borders) {
            for (const FaceBorder::Side& side : border.sides) {
                if (border.sides.size() == 2 && !is_whole(side)) {
                    return std::nullopt;
                }
            }
        }
        if (!lay_out() || !fills_rectangle()) {
            return std::nullopt;
        }
        for (int axis = 0; axis < 2; ++axis) {
            find_widths(axis);
        }
        return continues() ? flattening() : std::nullopt;
    }

private:
    [[nodiscard]] const Cell& cell(int face) const { return *cells_[static_cast<std::size_t>(face)]; }

    bool lay_out() {
        cells_[0] = Cell{};
        std::vector<int> open{0};
        while (!open.empty()) {
            const int face = open.back();
            open.pop_back();
            for (const FaceBorder& border : mesh_.borders) {
                for (std::size_t k = 0; k < 2 && border.sides.size() == 2; ++k) {
                    if (border.sides[k].face != face) {
                        continue;
                    }
                    const Cell next = beside(border.sides[k], border.sides[1 - k]);
                    auto& there = cells_[static_cast<std::size_t>(border.sides[1 - k].face)];
                    if (there && (there->at != next.at || there->turn != next.turn)) {
                        return false;
                    }
                    if (!there) {
                        there = next;
                        open.push_back(border.sides[1 - k].face);
                    }
                }
            }
        }
        return true;
    }

    [[nodiscard]] Cell beside(const FaceBorder::Side& own, const FaceBorder::Side& other) const {
        const Eigen::Matrix2d& turn = cell(own.face).turn;
        const double sense = own.rises() == other.rises() ? 1.0 : -1.0;
        const Vec2 out = turn * outwards_of(own.side);
        const Vec2 along = sense * (turn * tangent_of(own.side));
        Cell next;
        next.at = cell(own.face).at + out;
        next.turn = along * tangent_of(other.side).transpose() - out * outwards_of(other.side).transpose();
        return next;
    }

    bool fills_rectangle() {
        Vec2 low = Vec2::Zero(), high = Vec2::Zero();
        std::vector<std::pair<double, double>> taken;
        for (const auto& one : cells_) {
            low = low.cwiseMin(one->at);
            high = high.cwiseMax(one->at);
            taken.emplace_back(one->at.x(), one->at.y());
        }
        for (auto& one : cells_) {
            one->at -= low;
        }
        const Vec2 size = high - low + Vec2::Ones();
        std::ranges::sort(taken);
        for (int axis = 0; axis < 2; ++axis) {
            widths_[static_cast<std::size_t>(axis)].assign(static_cast<std::size_t>(std::lround(size[axis])),
                                                           1.0);
        }
        return std::ranges::adjacent_find(taken) == taken.end() &&
               std::lround(size.x() * size.y()) == std::ssize(cells_);
    }

    /// Of the surface along an axis of the raster, mm per cell.
    [[nodiscard]] Vec3 speed(const FaceBorder::Side& side, std::size_t n, int axis) const {
        const Vec2 uv = place_on_side(side.side, side.along[n]);
        const geometry::SurfaceDerivatives at =
            faces_[static_cast<std::size_t>(side.face)].surface.derivatives(uv.x(), uv.y());
        const Vec2 in_face = cell(side.face).turn.transpose() * Vec2::Unit(axis);
        return in_face.x() * at.du + in_face.y() * at.dv;
    }

    [[nodiscard]] std::size_t line(int face, int axis) const {
        return static_cast<std::size_t>(std::lround(cell(face).at[axis]));
    }
    /// Which axis the border lies across, and which of its sides comes first there.
    struct Crossing {
        int axis = 0;
        std::size_t first = 0;
    };
    [[nodiscard]] Crossing crossing(const FaceBorder& border) const {
        const Vec2 step = cell(border.sides[1].face).at - cell(border.sides[0].face).at;
        const int axis = std::abs(step.x()) > std::abs(step.y()) ? 0 : 1;
        return {axis, step[axis] > 0.0 ? std::size_t{0} : std::size_t{1}};
    }

    /// Widths by which the mean speed goes on from line to line.
    void find_widths(int axis) {
        auto& widths = widths_[static_cast<std::size_t>(axis)];
        std::vector<Vec2> speeds(widths.size(), Vec2::Zero()); // before and behind the border after a line
        for (const FaceBorder& border : mesh_.borders) {
            if (border.sides.size() < 2 || crossing(border).axis != axis) {
                continue;
            }
            const std::size_t first = crossing(border).first;
            for (std::size_t n = 0; n < border.points.size(); ++n) {
                speeds[line(border.sides[first].face, axis)] +=
                    Vec2(speed(border.sides[first], n, axis).norm(),
                         speed(border.sides[1 - first], n, axis).norm());
            }
        }
        double sum = widths.front();
        for (std::size_t n = 1; n < widths.size(); ++n) {
            widths[n] = widths[n - 1] * speeds[n - 1].y() / speeds[n - 1].x();
            sum += widths[n];
        }
        for (double& width : widths) {
            width /= sum;
        }
    }

    [[nodiscard]] double width(int face, int axis) const {
        return widths_[static_cast<std::size_t>(axis)][line(face, axis)];
    }

    [[nodiscard]] bool continues() const {
        constexpr double by = 0.02; // of the speed
        for (const FaceBorder& border : mesh_.borders) {
            if (border.sides.size() < 2) {
                continue;
            }
            const int axis = crossing(border).axis;
            for (std::size_t n = 0; n < border.points.size(); ++n) {
                const Vec3 a = speed(border.sides[0], n, axis) / width(border.sides[0].face, axis);
                const Vec3 b = speed(border.sides[1], n, axis) / width(border.sides[1].face, axis);
                if (!((a - b).norm() <= by * a.norm())) {
                    return false;
                }
            }
        }
        return true;
    }

    [[nodiscard]] Vec2 place(int face, const Vec2& uv) const {
        const Vec2 inside = cell(face).place(uv);
        Vec2 place;
        for (int axis = 0; axis < 2; ++axis) {
            const auto& widths = widths_[static_cast<std::size_t>(axis)];
            double before = 0.0, all = 0.0; // so that the last ends at 1 in spite of rounding
            for (std::size_t n = 0; n < widths.size(); ++n) {
                before += n < line(face, axis) ? widths[n] : 0.0;
                all += widths[n];
            }
            place[axis] = (before + inside[axis] * width(face, axis)) / all;
        }
        return place;
    }

    /// Nothing where two faces run along a border at different paces.
    [[nodiscard]] std::optional<Flattening> flattening() const {
        constexpr double apart = 1e-3;
        Flattening flat;
        flat.method = FlatteningMethod::own_parameters;
        flat.places.assign(mesh_.points.size(), Vec2::Constant(-1.0));
        for (const FaceTriangle& triangle : mesh_.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec2 here = place(triangle.face, triangle.parameters[k]);
                Vec2& known = flat.places[static_cast<std::size_t>(triangle.corners[k])];
                if (known.x() >= 0.0 && (known - here).norm() > apart) {
                    return std::nullopt;
                }
                known = here;
            }
        }
        constexpr std::array<std::array<double, 2>, 4> ends{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec2 end(ends[k][0], ends[k][1]);
            const auto nearest = std::ranges::min_element(mesh_.boundary, {}, [&](int n) {
                return (flat.places[static_cast<std::size_t>(n)] - end).norm();
            });
            flat.corners[k] = static_cast<int>(nearest - mesh_.boundary.begin());
        }
        measure(mesh_, flat);
        return flat;
    }

    std::span<const ExactFace> faces_;
    const FaceMesh& mesh_;
    std::vector<std::optional<Cell>> cells_;
    std::array<std::vector<double>, 2> widths_;
};

} // namespace

std::optional<Flattening> own_parameters(std::span<const ExactFace> faces, const FaceMesh& mesh) {
    return Raster(faces, mesh).run();
}

} // namespace millwright::region
