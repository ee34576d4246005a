#include "core/simulation/internal/keyframes.h"

#include "core/base/error.h"

#include <algorithm>
#include <iterator>

namespace millwright::simulation {

namespace {

std::size_t bytes_of(const Tile& tile) {
    return sizeof(std::pair<std::uint32_t, Tile>) + tile.dexels.capacity() * sizeof(Dexel);
}

template <class Field, class Work> void for_each_tile(Field& field, const Work& work) {
    std::uint32_t number = 0;
    for (int k = 0; k < 3; ++k) {
        for (auto& tile : field.tiles(k)) {
            work(number++, tile);
        }
    }
}

constexpr std::uint32_t no_version = ~std::uint32_t{0};

} // namespace

int Keyframes::add(const DexelField& field, int block, std::size_t most_bytes) {
    expects(frames_.empty() || frames_.back().block < block, "keyframes come in order");
    Frame frame{block, {}};
    std::size_t more = 0;
    for_each_tile(field, [&](std::uint32_t number, const Tile& tile) {
        if (number >= versions_.size()) {
            versions_.resize(number + 1, no_version);
        }
        if (versions_[number] != tile.version) {
            frame.tiles.emplace_back(number, tile);
            frame.tiles.back().second.dexels.shrink_to_fit();
            more += bytes_of(frame.tiles.back().second);
        }
    });
    frames_.push_back(std::move(frame));
    bytes_ += more;
    for (const auto& [number, tile] : frames_.back().tiles) {
        versions_[number] = tile.version;
    }
    return fit(most_bytes);
}

int Keyframes::fit(std::size_t most_bytes) {
    int thinned = 0;
    while (bytes_ > most_bytes && !frames_.empty()) {
        thin();
        ++thinned;
    }
    if (thinned > 0) {
        count_versions();
    }
    return thinned;
}

/// The first stays as long as any; one alone goes.
void Keyframes::thin() {
    std::vector<Frame> kept;
    for (std::size_t n = 0; n < frames_.size() && frames_.size() > 1; ++n) {
        if (n % 2 == 0) {
            kept.push_back(std::move(frames_[n]));
            continue;
        }
        if (n + 1 == frames_.size()) {
            break;
        }
        // What only the one left out has belongs to the next.
        Frame& next = frames_[n + 1];
        std::vector<std::pair<std::uint32_t, Tile>> tiles;
        const auto by_number = [](const auto& a, const auto& b) { return a.first < b.first; };
        std::set_union(std::make_move_iterator(next.tiles.begin()),
                       std::make_move_iterator(next.tiles.end()),
                       std::make_move_iterator(frames_[n].tiles.begin()),
                       std::make_move_iterator(frames_[n].tiles.end()),
                       std::back_inserter(tiles),
                       by_number);
        next.tiles = std::move(tiles);
    }
    frames_ = std::move(kept);
    bytes_ = 0;
    for (const Frame& frame : frames_) {
        for (const auto& [number, tile] : frame.tiles) {
            bytes_ += bytes_of(tile);
        }
    }
}

void Keyframes::count_versions() {
    std::fill(versions_.begin(), versions_.end(), no_version);
    for (const Frame& frame : frames_) {
        for (const auto& [number, tile] : frame.tiles) {
            versions_[number] = tile.version;
        }
    }
}

void Keyframes::restore(std::size_t n, DexelField& field) const {
    std::vector<const Tile*> wanted(versions_.size(), nullptr);
    for (std::size_t frame = 0; frame <= n; ++frame) {
        for (const auto& [number, tile] : frames_[frame].tiles) {
            wanted[number] = &tile;
        }
    }
    for_each_tile(field, [&](std::uint32_t number, Tile& tile) {
        const Tile* const stored = wanted[number];
        expects(stored != nullptr, "the first keyframe has all tiles");
        if (stored->version != tile.version) {
            tile = *stored;
        }
    });
}

} // namespace millwright::simulation
