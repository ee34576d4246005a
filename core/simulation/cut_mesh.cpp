#include "core/simulation/cut_mesh.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

namespace millwright::simulation {

namespace {

using Node = std::array<int, 3>;

/// The lattice points that are looked at, with one layer outside of the box on each side.
class Lattice {
public:
    Lattice(const DexelField& field, int stride) : field_(field), stride_(stride) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            count_[axis] = (field.count()[axis] - 1) / stride + 3;
        }
        filled_.resize(size_of(count_[0]) * size_of(count_[1]) * size_of(count_[2]));
        for (int x = 1; x + 1 < count_[0]; ++x) {
            for (int y = 1; y + 1 < count_[1]; ++y) {
                fill(x, y);
            }
        }
    }
    [[nodiscard]] const std::array<int, 3>& count() const { return count_; }
    [[nodiscard]] bool filled(const Node& n) const { return filled_[index(n)] != 0; }
    [[nodiscard]] double at(int axis, int n) const {
        const auto a = static_cast<std::size_t>(axis);
        if (n == count_[a] - 1) { // the layer outside
            return field_.box().max()[axis] + 0.5 * field_.cell()[axis];
        }
        return field_.middle(axis, n == 0 ? -1 : (n - 1) * stride_);
    }

    struct Crossing {
        double at = 0.0;
        std::int32_t move = stock_surface;
    };
    /// Where the surface passes between `n` and the next point along axis `k`; one of them is material.
    [[nodiscard]] Crossing crossing(const Node& n, int k) const {
        const auto a = static_cast<std::size_t>(k);
        const double low = at(k, n[a]), high = at(k, n[a] + 1);
        const bool starts = !filled(n);
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        const double face = field_.box().min()[k];
        Crossing found{0.5 * (low + high), stock_surface};
        double nearest = high - low;
        for (const Dexel& piece : field_.line(k, cell(u, n), cell(v, n))) {
            const double place = face + static_cast<double>(starts ? piece.from : piece.to);
            const double off = std::max({low - place, place - high, 0.0});
            if (off < nearest) {
                nearest = off;
                found = {std::clamp(place, low, high), starts ? piece.from_move : piece.to_move};
            }
        }
        return found;
    }

private:
    static std::size_t size_of(int n) { return static_cast<std::size_t>(n); }
    [[nodiscard]] std::size_t index(const Node& n) const {
        return (size_of(n[0]) * size_of(count_[1]) + size_of(n[1])) * size_of(count_[2]) + size_of(n[2]);
    }
    [[nodiscard]] int cell(int axis, const Node& n) const {
        return (n[static_cast<std::size_t>(axis)] - 1) * stride_;
    }
    void fill(int x, int y) {
        const auto pieces = field_.line(2, (x - 1) * stride_, (y - 1) * stride_);
        std::size_t piece = 0;
        for (int z = 1; z + 1 < count_[2]; ++z) {
            const auto place = static_cast<float>(at(2, z) - field_.box().min().z());
            while (piece < pieces.size() && pieces[piece].to < place) {
                ++piece;
            }
            filled_[index({x, y, z})] = piece < pieces.size() && pieces[piece].from <= place ? 1 : 0;
        }
    }

    const DexelField& field_;
    int stride_;
    std::array<int, 3> count_{};
    std::vector<std::uint8_t> filled_;
};

class Mesher {
public:
    Mesher(const DexelField& field, int stride) : lattice_(field, stride) {
        mesh_.stride = stride;
        const auto& count = lattice_.count();
        layer_ = static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
        corners_.assign(2 * layer_, -1);
    }
    CutMesh mesh(const Progress& progress) {
        const auto& count = lattice_.count();
        for (int x = 0; x + 1 < count[0]; ++x) {
            progress.check();
            progress.report(static_cast<double>(x) / count[0]);
            for (int y = 0; y + 1 < count[1]; ++y) {
                for (int z = 0; z + 1 < count[2]; ++z) {
                    corner_at({x, y, z}) = new_corner({x, y, z});
                }
            }
            faces_of_layer(x);
        }
        return std::move(mesh_);
    }

private:
    /// The corner of the cell above `n`; two layers are kept.
    int& corner_at(const Node& n) {
        return corners_[static_cast<std::size_t>(n[0] % 2) * layer_ +
                        static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(lattice_.count()[2]) +
                        static_cast<std::size_t>(n[2])];
    }

    /// -1 where the surface does not pass.
    int new_corner(const Node& n) {
        Vec3 sum = Vec3::Zero();
        int crossings = 0;
        std::int32_t move = stock_surface;
        for (std::size_t k = 0; k < 3; ++k) {
            for (int edge = 0; edge < 4; ++edge) {
                Node from = n;
                from[(k + 1) % 3] += edge % 2;
                from[(k + 2) % 3] += edge / 2;
                Node to = from;
                ++to[k];
                if (lattice_.filled(from) == lattice_.filled(to)) {
                    continue;
                }
                const auto crossing = lattice_.crossing(from, static_cast<int>(k));
                Vec3 place;
                for (int axis = 0; axis < 3; ++axis) {
                    place[axis] = lattice_.at(axis, from[static_cast<std::size_t>(axis)]);
                }
                place[static_cast<Eigen::Index>(k)] = crossing.at;
                sum += place;
                move = std::max(move, crossing.move);
                ++crossings;
            }
        }
        if (crossings == 0) {
            return -1;
        }
        mesh_.points.emplace_back(sum / crossings);
        mesh_.moves.push_back(move);
        return static_cast<int>(mesh_.points.size()) - 1;
    }

    /// Faces between the corners of layers x - 1 and x, and within x.
    void faces_of_layer(int x) {
        const auto& count = lattice_.count();
        for (int y = 0; y + 1 < count[1]; ++y) {
            for (int z = 0; z + 1 < count[2]; ++z) {
                const Node n{x, y, z};
                for (std::size_t k = 0; k < 3; ++k) {
                    Node to = n;
                    ++to[k];
                    if (lattice_.filled(n) != lattice_.filled(to)) {
                        add_face(n, k, lattice_.filled(n));
                    }
                }
            }
        }
    }

    /// Around the edge from `n` along axis k; `leaves`: its start is material.
    void add_face(const Node& n, std::size_t k, bool leaves) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        const auto at = [&](int du, int dv) {
            Node cell = n;
            cell[u] -= du;
            cell[v] -= dv;
            return corner_at(cell);
        };
        if (n[u] == 0 || n[v] == 0) {
            return; // points of the outer layer are all outside
        }
        const std::array<int, 4> around{at(1, 1), at(0, 1), at(0, 0), at(1, 0)};
        if (leaves) { // seen against +k counter-clockwise
            mesh_.triangles.push_back({around[0], around[1], around[2]});
            mesh_.triangles.push_back({around[0], around[2], around[3]});
        } else {
            mesh_.triangles.push_back({around[0], around[2], around[1]});
            mesh_.triangles.push_back({around[0], around[3], around[2]});
        }
    }

    Lattice lattice_;
    CutMesh mesh_;
    std::size_t layer_ = 0;
    std::vector<int> corners_;
};

std::size_t end_count(const DexelField& field) {
    std::size_t ends = 0;
    for (int k = 0; k < 3; ++k) {
        const auto [columns, rows] = field.tile_count(k);
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < columns; ++i) {
                ends += 2 * field.tile(k, i, j).dexels.size();
            }
        }
    }
    return ends;
}

template <class Value> void append(std::string& bytes, const Value& value) {
    static_assert(std::endian::native == std::endian::little);
    std::array<char, sizeof(Value)> raw{};
    std::memcpy(raw.data(), &value, sizeof(Value));
    bytes.append(raw.data(), raw.size());
}

void append(std::string& bytes, const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
        append(bytes, static_cast<float>(p[axis]));
    }
}

} // namespace

CutMesh mesh_of(const DexelField& field, std::size_t most_triangles, const Progress& progress) {
    constexpr double most_nodes = 1e8;
    int stride = 1;
    const auto ends = static_cast<double>(end_count(field));
    const auto& count = field.count();
    const double nodes = 1.0 * count[0] * count[1] * count[2];
    while (2.0 * ends / (stride * stride) > static_cast<double>(most_triangles) ||
           nodes / (1.0 * stride * stride * stride) > most_nodes) {
        ++stride;
    }
    return Mesher(field, stride).mesh(progress);
}

std::vector<Vec3> normals_of(const CutMesh& mesh) {
    std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
    const auto point = [&](int k) { return mesh.points[static_cast<std::size_t>(k)]; };
    for (const auto& triangle : mesh.triangles) {
        const Vec3 a = point(triangle[0]);
        const Vec3 doubled = (point(triangle[1]) - a).cross(point(triangle[2]) - a);
        for (const int corner : triangle) {
            normals[static_cast<std::size_t>(corner)] += doubled;
        }
    }
    for (Vec3& normal : normals) {
        const double length = normal.norm();
        normal = length > 0.0 ? Vec3(normal / length) : Vec3(Vec3::UnitZ());
    }
    return normals;
}

std::string stl_of(const CutMesh& mesh) {
    std::string bytes = "Millwright: what is left of the stock, in mm";
    constexpr std::size_t header = 80, a_triangle = 50;
    bytes.resize(header, ' ');
    bytes.reserve(header + 4 + a_triangle * mesh.triangles.size());
    append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) {
        const Vec3& a = mesh.points[static_cast<std::size_t>(triangle[0])];
        const Vec3& b = mesh.points[static_cast<std::size_t>(triangle[1])];
        const Vec3& c = mesh.points[static_cast<std::size_t>(triangle[2])];
        const Vec3 normal = (b - a).cross(c - a);
        const double length = normal.norm();
        append(bytes, length > 0.0 ? Vec3(normal / length) : Vec3(Vec3::Zero()));
        append(bytes, a);
        append(bytes, b);
        append(bytes, c);
        append(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::string ply_of(const std::vector<Vec3>& points,
                   const std::vector<std::array<int, 3>>& triangles,
                   const std::vector<std::array<std::uint8_t, 3>>& colors) {
    expects(colors.size() == points.size(), "every point of a mesh has a colour");
    std::string bytes =
        fmt::format("ply\nformat binary_little_endian 1.0\ncomment Millwright, mm\n"
                    "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
                    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                    "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                    points.size(),
                    triangles.size());
    for (std::size_t n = 0; n < points.size(); ++n) {
        append(bytes, points[n]);
        bytes.append({static_cast<char>(colors[n][0]),
                      static_cast<char>(colors[n][1]),
                      static_cast<char>(colors[n][2])});
    }
    for (const auto& triangle : triangles) {
        bytes.push_back(3);
        for (const int corner : triangle) {
            append(bytes, static_cast<std::int32_t>(corner));
        }
    }
    return bytes;
}

} // namespace millwright::simulation
