#include "core/simulation/internal/stock_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace millwright::simulation {

namespace {

/// From `low` to `high` along each axis, in um from the field's box. Whole numbers: equal faces are found.
struct Block {
    std::array<std::int32_t, 3> low{}, high{};
};

constexpr double um = 1e-3; // mm

std::int32_t in_um(double length) {
    return static_cast<std::int32_t>(std::lround(length / um));
}

/// What lines say of a cube along an axis: where those along it have material, and where others pass.
struct Extent {
    float from = std::numeric_limits<float>::max(), to = std::numeric_limits<float>::lowest();
    std::int16_t first = std::numeric_limits<std::int16_t>::max(), last = -1; // cells
};

class Cubes {
public:
    Cubes(const DexelField& field, int stride, const Progress& progress) : field_(field), stride_(stride) {
        for (std::size_t a = 0; a < 3; ++a) {
            count_[a] = (field.count()[a] - 1) / stride + 1;
        }
        extents_.resize(3 * static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                        static_cast<std::size_t>(count_[2]));
        for (int k = 0; k < 3; ++k) {
            const int height = field.count()[static_cast<std::size_t>((k + 2) % 3)];
            for (int j = 0; j < height; ++j) {
                progress.check();
                for (int i = 0; i < field.count()[static_cast<std::size_t>((k + 1) % 3)]; ++i) {
                    add_line(k, i, j);
                }
            }
        }
    }

    /// Of the cubes with material that do not lie within full ones.
    [[nodiscard]] std::vector<Block> blocks() const {
        std::vector<Block> found;
        for (int x = 0; x < count_[0]; ++x) {
            for (int y = 0; y < count_[1]; ++y) {
                for (int z = 0; z < count_[2]; ++z) {
                    const std::array<int, 3> cube{x, y, z};
                    if (has_material(cube) && !is_within_full_ones(cube)) {
                        found.push_back(block_of(cube));
                    }
                }
            }
        }
        return found;
    }

private:
    [[nodiscard]] std::size_t index(const std::array<int, 3>& cube) const {
        return 3 * ((static_cast<std::size_t>(cube[0]) * static_cast<std::size_t>(count_[1]) +
                     static_cast<std::size_t>(cube[1])) *
                        static_cast<std::size_t>(count_[2]) +
                    static_cast<std::size_t>(cube[2]));
    }
    [[nodiscard]] double edge(int axis, int cube) const {
        const int cells = std::min(cube * stride_, field_.count()[static_cast<std::size_t>(axis)]);
        return cells * field_.cell()[axis];
    }

    void add_line(int k, int i, int j) {
        const auto a = static_cast<std::size_t>(k), u = (a + 1) % 3, v = (a + 2) % 3;
        const double length = stride_ * field_.cell()[k];
        const auto cube_at = [&](float at) {
            return std::clamp(static_cast<int>(static_cast<double>(at) / length), 0, count_[a] - 1);
        };
        std::array<int, 3> cube{};
        cube[u] = i / stride_;
        cube[v] = j / stride_;
        for (const Dexel& piece : field_.line(k, i, j)) {
            const int first = cube_at(piece.from), last = cube_at(piece.to);
            for (int n = first; n <= last; ++n) {
                const float from = std::max(piece.from, static_cast<float>(edge(k, n)));
                const float to = std::min(piece.to, static_cast<float>(edge(k, n + 1)));
                constexpr float rounding = 5e-4F; // mm: an end at the border of two cubes
                if (first != last && to - from < rounding) {
                    continue;
                }
                cube[a] = n;
                Extent* of = &extents_[index(cube)];
                of[a].from = std::min(of[a].from, from);
                of[a].to = std::max(of[a].to, to);
                pass(of[u], i);
                pass(of[v], j);
            }
        }
    }
    static void pass(Extent& extent, int cell) {
        extent.first = std::min(extent.first, static_cast<std::int16_t>(cell));
        extent.last = std::max(extent.last, static_cast<std::int16_t>(cell));
    }

    [[nodiscard]] bool has_material(const std::array<int, 3>& cube) const {
        const Extent* of = &extents_[index(cube)];
        return of[0].last >= 0 || of[1].last >= 0;
    }

    /// Along an axis without a line of its own the material ends somewhere within the next cells.
    [[nodiscard]] Block block_of(const std::array<int, 3>& cube) const {
        Block block;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const Extent& of = extents_[index(cube) + a];
            const double cell = field_.cell()[axis];
            const bool known = of.from <= of.to;
            const double beside = known ? 0.0 : cell;
            double low = known ? static_cast<double>(of.from) : field_.box().sizes()[axis];
            double high = known ? static_cast<double>(of.to) : 0.0;
            if (of.last >= 0) {
                low = std::min(low, (of.first + 0.5) * cell - beside);
                high = std::max(high, (of.last + 0.5) * cell + beside);
            }
            block.low[a] = in_um(std::max(low, 0.0));
            block.high[a] = in_um(std::min(high, field_.box().sizes()[axis]));
        }
        return block;
    }

    [[nodiscard]] bool is_full(const std::array<int, 3>& cube) const {
        if (!has_material(cube)) {
            return false;
        }
        const Block block = block_of(cube);
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            if (block.low[a] > in_um(edge(axis, cube[a])) || block.high[a] < in_um(edge(axis, cube[a] + 1))) {
                return false;
            }
        }
        return true;
    }

    [[nodiscard]] bool is_within_full_ones(const std::array<int, 3>& cube) const {
        for (std::size_t a = 0; a < 3; ++a) {
            for (const int step : {-1, 1}) {
                std::array<int, 3> beside = cube;
                beside[a] += step;
                if (beside[a] < 0 || beside[a] >= count_[a] || !is_full(beside)) {
                    return false;
                }
            }
        }
        return true;
    }

    const DexelField& field_;
    int stride_;
    std::array<int, 3> count_{};
    std::vector<Extent> extents_; // three a cube
};

/// Blocks in a row along `axis` that continue each other become one.
void join_along(std::size_t axis, std::vector<Block>& blocks) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto section = [&](const Block& b) {
        return std::array<std::int32_t, 4>{b.low[u], b.high[u], b.low[v], b.high[v]};
    };
    std::ranges::sort(blocks, [&](const Block& a, const Block& b) {
        return std::pair(section(a), a.low[axis]) < std::pair(section(b), b.low[axis]);
    });
    std::size_t kept = 0;
    for (std::size_t n = 1; n < blocks.size(); ++n) {
        Block& last = blocks[kept];
        if (section(last) == section(blocks[n]) && blocks[n].low[axis] <= last.high[axis]) {
            last.high[axis] = std::max(last.high[axis], blocks[n].high[axis]);
        } else {
            blocks[++kept] = blocks[n];
        }
    }
    blocks.resize(std::min(blocks.size(), kept + 1));
}

constexpr std::size_t triangles_of_block = 12;

CollisionTriangles surface_of(const std::vector<Block>& blocks, const Vec3& origin) {
    CollisionTriangles surface;
    surface.points.reserve(8 * blocks.size());
    surface.triangles.reserve(triangles_of_block * blocks.size());
    for (const Block& block : blocks) {
        const int first = static_cast<int>(surface.points.size());
        for (unsigned corner = 0; corner < 8; ++corner) {
            Vec3 point = origin;
            for (std::size_t a = 0; a < 3; ++a) {
                point[static_cast<Eigen::Index>(a)] +=
                    um * ((corner >> a & 1U) != 0 ? block.high[a] : block.low[a]);
            }
            surface.points.push_back(point);
        }
        for (int a = 0; a < 3; ++a) {
            const int u = 1 << (a + 1) % 3, v = 1 << (a + 2) % 3;
            const int low = first, high = first + (1 << a);
            surface.triangles.push_back({low, low + u + v, low + u});
            surface.triangles.push_back({low, low + v, low + u + v});
            surface.triangles.push_back({high, high + u, high + u + v});
            surface.triangles.push_back({high, high + u + v, high + v});
        }
    }
    return surface;
}

} // namespace

StockBlocks
blocks_of(const DexelField& field, std::size_t most_triangles, int least, const Progress& progress) {
    constexpr double most_cubes = 3e6; // up to 110 MB while they are counted
    const auto& count = field.count();
    const double cells = 1.0 * count[0] * count[1] * count[2];
    int stride = std::max(least, static_cast<int>(std::ceil(std::cbrt(cells / most_cubes))));
    const int longest = std::ranges::max(count);
    for (;; ++stride) {
        std::vector<Block> blocks = Cubes(field, stride, progress).blocks();
        for (const std::size_t axis : {2U, 1U, 0U}) {
            join_along(axis, blocks);
        }
        if (triangles_of_block * blocks.size() <= most_triangles || stride >= longest) {
            return {surface_of(blocks, field.box().min()), stride};
        }
    }
}

} // namespace millwright::simulation
