#include "core/simulation/dexel_field.h"

#include "core/base/error.h"
#include "core/base/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace millwright::simulation {

namespace {

constexpr double bytes_per_line = 2.0 * sizeof(Dexel) + static_cast<double>(sizeof(Tile)) / Tile::lines;
constexpr double most_cells = 20'000.0; ///< along an axis

int tiles_for(int cells) {
    return (cells + Tile::side - 1) / Tile::side;
}

double lines_of(const Vec3& size, double pitch) {
    const Vec3 n = (size / pitch).array().ceil().max(1.0);
    return n.x() * n.y() + n.y() * n.z() + n.z() * n.x();
}

} // namespace

void Tile::look(float middle) {
    low = std::numeric_limits<float>::max();
    high = std::numeric_limits<float>::lowest();
    float gap_from = std::numeric_limits<float>::lowest();
    float gap_to = std::numeric_limits<float>::max();
    for (std::size_t n = 0; n < lines; ++n) {
        for (const Dexel& dexel : line(n)) {
            low = std::min(low, dexel.from);
            high = std::max(high, dexel.to);
            if (dexel.to <= middle) {
                gap_from = std::max(gap_from, dexel.to);
            } else if (dexel.from >= middle) {
                gap_to = std::min(gap_to, dexel.from);
            } else {
                gap_to = gap_from; // material at the middle itself
            }
        }
    }
    if (gap_to - gap_from > void_to - void_from) {
        void_from = gap_from;
        void_to = gap_to;
    }
}

FieldSize field_size(const Box3& box, double pitch) {
    expects(pitch > 0.0 && !box.isEmpty(), "a field has a pitch above 0 and a box");
    FieldSize size;
    const Vec3 n = (box.sizes() / pitch).array().ceil().max(1.0).min(most_cells);
    for (int axis = 0; axis < 3; ++axis) {
        size.count[static_cast<std::size_t>(axis)] = static_cast<int>(n[axis]);
    }
    const double lines = lines_of(box.sizes(), pitch);
    constexpr double beyond = 1e15;
    size.lines = static_cast<std::size_t>(std::min(lines, beyond));
    size.bytes = static_cast<std::size_t>(std::min(lines * bytes_per_line, beyond));
    return size;
}

double pitch_within(const Box3& box, std::size_t bytes) {
    const double most = static_cast<double>(bytes) / bytes_per_line;
    double fine = 1e-6 * box.sizes().maxCoeff(), coarse = box.sizes().maxCoeff();
    fine = std::max(fine, box.sizes().maxCoeff() / most_cells);
    for (int n = 0; n < 60; ++n) {
        const double middle = 0.5 * (fine + coarse);
        (lines_of(box.sizes(), middle) > most ? fine : coarse) = middle;
    }
    return coarse;
}

DexelField::DexelField(const Stock& stock, double pitch, std::size_t most_bytes, const Progress& progress) {
    if (const std::string fault = fault_of(stock); !fault.empty()) {
        throw Error(fault);
    }
    expects(std::isfinite(pitch) && pitch > 0.0, "a resolution is above 0 mm");
    box_ = bounds(stock);
    size_ = field_size(box_, pitch);
    const double longest = box_.sizes().maxCoeff();
    if (size_.bytes > most_bytes || longest / pitch > most_cells) {
        constexpr double mega = 1e6;
        throw Error(
            fmt::format("a resolution of {:g} mm asks for {} lines and about {:.0f} MB of memory, and {:.0f} "
                        "MB may be used",
                        pitch,
                        size_.lines,
                        static_cast<double>(size_.bytes) / mega,
                        static_cast<double>(most_bytes) / mega),
            {},
            fmt::format("a resolution of {:.2g} mm fits", 1.05 * pitch_within(box_, most_bytes)));
    }
    for (int axis = 0; axis < 3; ++axis) {
        cell_[axis] = box_.sizes()[axis] / size_.count[static_cast<std::size_t>(axis)];
    }
    for (int k = 0; k < 3; ++k) {
        progress.check();
        fill(stock, k);
        progress.report((k + 1) / 3.0);
    }
}

void DexelField::fill(const Stock& stock, int k) {
    const auto [columns, rows] = tile_count(k);
    auto& tiles = tiles_[static_cast<std::size_t>(k)];
    tiles.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    const int width = size_.count[static_cast<std::size_t>(u)];
    const int height = size_.count[static_cast<std::size_t>(v)];
    RayGrid grid{k, Vec3(box_.min() + 0.5 * cell_), cell_, {width, 0}};
    for (int row = 0; row < rows;
         ++row) { // a row of tiles at a time: the lists of all lines take more memory
        const int from = row * Tile::side;
        grid.first[v] = middle(v, from);
        grid.count[1] = std::min(Tile::side, height - from);
        const auto lines = material_along(stock, grid);
        for (int column = 0; column < columns; ++column) {
            Tile& made = tile(k, column, row);
            for (std::size_t n = 0; n < Tile::lines; ++n) {
                made.first[n] = static_cast<std::uint32_t>(made.dexels.size());
                const int i = column * Tile::side + static_cast<int>(n % Tile::side);
                const int j = static_cast<int>(n / Tile::side);
                if (i < width && j < grid.count[1]) {
                    for (const Interval& piece :
                         lines[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(i)]) {
                        made.dexels.push_back({static_cast<float>(piece.from - box_.min()[k]),
                                               static_cast<float>(piece.to - box_.min()[k])});
                    }
                }
            }
            made.first[Tile::lines] = static_cast<std::uint32_t>(made.dexels.size());
            made.dexels.shrink_to_fit();
            made.look(static_cast<float>(0.5 * box_.sizes()[k]));
        }
    }
}

std::array<int, 2> DexelField::tile_count(int k) const {
    return {tiles_for(size_.count[static_cast<std::size_t>((k + 1) % 3)]),
            tiles_for(size_.count[static_cast<std::size_t>((k + 2) % 3)])};
}

const Tile& DexelField::tile(int k, int i, int j) const {
    const auto width = static_cast<std::size_t>(tile_count(k)[0]);
    return tiles_[static_cast<std::size_t>(k)]
                 [static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i)];
}

Tile& DexelField::tile(int k, int i, int j) {
    return const_cast<Tile&>(std::as_const(*this).tile(k, i, j)); // NOLINT: the field is not constant here
}

std::span<const Dexel> DexelField::line(int k, int i, int j) const {
    const auto n = static_cast<std::size_t>((j % Tile::side) * Tile::side + i % Tile::side);
    return tile(k, i / Tile::side, j / Tile::side).line(n);
}

bool DexelField::filled(int x, int y, int z) const {
    const auto at = static_cast<float>((z + 0.5) * cell_.z());
    const auto pieces = line(2, x, y);
    return std::ranges::any_of(pieces, [&](const Dexel& d) { return d.from <= at && at <= d.to; });
}

/// The share of a cell that is material along its line of family `k`.
double DexelField::filled_part(int k, const std::array<int, 3>& cell) const {
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    const double from = cell[static_cast<std::size_t>(k)] * cell_[k];
    const double to = from + cell_[k];
    double length = 0.0;
    for (const Dexel& piece : line(k, cell[static_cast<std::size_t>(u)], cell[static_cast<std::size_t>(v)])) {
        const double within =
            std::min(static_cast<double>(piece.to), to) - std::max(static_cast<double>(piece.from), from);
        length += std::max(within, 0.0);
    }
    return std::min(length / cell_[k], 1.0);
}

/// The cell of a place, which is measured from the box.
int DexelField::cell_at(int axis, float at) const {
    return std::clamp(static_cast<int>(static_cast<double>(at) / cell_[axis]),
                      0,
                      size_.count[static_cast<std::size_t>(axis)] - 1);
}

std::uint64_t DexelField::layer_key(int y, int z) const {
    return static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(size_.count[2]) +
           static_cast<std::uint64_t>(z);
}

/// Of each layer across X the cells in which lines along X end: these are found line by line.
std::vector<DexelField::LayerCells> DexelField::ends_along_x() const {
    std::vector<LayerCells> ends(static_cast<std::size_t>(size_.count[0]));
    for (int z = 0; z < size_.count[2]; ++z) {
        for (int y = 0; y < size_.count[1]; ++y) {
            for (const Dexel& piece : line(0, y, z)) {
                ends[static_cast<std::size_t>(cell_at(0, piece.from))].push_back(layer_key(y, z));
                ends[static_cast<std::size_t>(cell_at(0, piece.to))].push_back(layer_key(y, z));
            }
        }
    }
    return ends;
}

void DexelField::add_ends_across_x(int x, LayerCells& ends) const {
    for (int y = 0; y < size_.count[1]; ++y) {
        for (const Dexel& piece : line(2, x, y)) {
            ends.push_back(layer_key(y, cell_at(2, piece.from)));
            ends.push_back(layer_key(y, cell_at(2, piece.to)));
        }
    }
    for (int z = 0; z < size_.count[2]; ++z) {
        for (const Dexel& piece : line(1, z, x)) {
            ends.push_back(layer_key(cell_at(1, piece.from), z));
            ends.push_back(layer_key(cell_at(1, piece.to), z));
        }
    }
}

/// Of the lines of a layer, in cells.
double DexelField::length_along_z(int x) const {
    double sum = 0.0;
    for (int y = 0; y < size_.count[1]; ++y) {
        for (const Dexel& piece : line(2, x, y)) {
            sum += static_cast<double>(piece.to - piece.from) / cell_.z();
        }
    }
    return sum;
}

/// In cells: the lines along Z give the whole, cells at the surface are weighed anew.
double DexelField::layer_volume(int x, LayerCells ends) const {
    add_ends_across_x(x, ends);
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    double sum = length_along_z(x);
    const auto nz = static_cast<std::uint64_t>(size_.count[2]);
    for (const std::uint64_t at : ends) {
        const std::array<int, 3> cell{x, static_cast<int>(at / nz), static_cast<int>(at % nz)};
        const std::array<double, 3> part{filled_part(0, cell), filled_part(1, cell), filled_part(2, cell)};
        const double best =
            *std::ranges::min_element(part, {}, [](double share) { return std::abs(share - 0.5); });
        sum += best - part[2];
    }
    return sum;
}

double DexelField::volume() const {
    const int nx = size_.count[0];
    std::vector<double> layers(static_cast<std::size_t>(nx));
    std::vector<LayerCells> ends = ends_along_x();
    constexpr std::ptrdiff_t layers_per_chunk = 4;
    parallel_for(nx, layers_per_chunk, [&](std::ptrdiff_t layer) {
        const auto n = static_cast<std::size_t>(layer);
        layers[n] = layer_volume(static_cast<int>(layer), std::move(ends[n]));
    });
    double cells = 0.0;
    for (const double layer : layers) {
        cells += layer;
    }
    return cells * cell_.prod();
}

std::size_t DexelField::bytes() const {
    std::size_t sum = 0;
    for (const auto& tiles : tiles_) {
        for (const Tile& one : tiles) {
            sum += sizeof(Tile) + one.dexels.capacity() * sizeof(Dexel);
        }
    }
    return sum;
}

} // namespace millwright::simulation
