#include "core/simulation/internal/material_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::simulation {

int MaterialProbe::cell_at(const Vec3& place, int axis) const {
    const double at = std::floor((place[axis] - field_.box().min()[axis]) / field_.cell()[axis]);
    return static_cast<int>(std::clamp(at, 0.0, field_.count()[static_cast<std::size_t>(axis)] - 1.0));
}

std::span<const Dexel> MaterialProbe::line_at(const Vec3& place, int k) const {
    return field_.line(k, cell_at(place, (k + 1) % 3), cell_at(place, (k + 2) % 3));
}

bool MaterialProbe::is_near(const Vec3& place) const {
    for (int axis = 0; axis < 3; ++axis) {
        const double cell = field_.cell()[axis];
        if (place[axis] < field_.box().min()[axis] - cell || place[axis] > field_.box().max()[axis] + cell) {
            return false;
        }
    }
    for (int k = 0; k < 3; ++k) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        const double at = place[k] - field_.box().min()[k];
        const double from = at - field_.cell()[k], to = at + field_.cell()[k];
        for (const double a : {-0.5, 0.5}) {
            for (const double b : {-0.5, 0.5}) {
                Vec3 beside = place;
                beside[u] += a * field_.cell()[u];
                beside[v] += b * field_.cell()[v];
                if (std::ranges::any_of(line_at(beside, k), [&](const Dexel& piece) {
                        return static_cast<double>(piece.from) <= to && static_cast<double>(piece.to) >= from;
                    })) {
                    return true;
                }
            }
        }
    }
    return false;
}

double MaterialProbe::way_out(const Vec3& place, const Vec3& direction) const {
    double way = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double slope = direction[axis];
        if (std::abs(slope) > 0.0) {
            const double face = slope > 0.0 ? field_.box().max()[axis] : field_.box().min()[axis];
            way = std::min(way, (face - place[axis]) / slope);
        }
    }
    return std::isfinite(way) ? std::max(way, 0.0) : 0.0;
}

std::optional<MaterialEnd> MaterialProbe::next(const Vec3& place, const Vec3& direction) const {
    const double step = 0.5 * field_.cell().minCoeff();
    const double out = way_out(place, direction);
    for (double way = 0.0; way <= out; way += step) {
        const Vec3 here = place + way * direction;
        if (!field_.box().contains(here)) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            const auto at = static_cast<float>(here[k] - field_.box().min()[k]);
            for (const Dexel& piece : line_at(here, k)) {
                if (piece.from <= at && at <= piece.to) {
                    const bool low = at - piece.from < piece.to - at;
                    return MaterialEnd{way, low ? piece.from_move : piece.to_move};
                }
            }
        }
    }
    return std::nullopt;
}

std::optional<MaterialEnd> MaterialProbe::nearest_on_lines(const Vec3& place) const {
    std::optional<MaterialEnd> nearest;
    for (int k = 0; k < 3; ++k) {
        const double at = place[k] - field_.box().min()[k];
        for (const Dexel& piece : line_at(place, k)) {
            const double below = static_cast<double>(piece.from) - at;
            const double above = at - static_cast<double>(piece.to);
            const double way = std::max({below, above, 0.0});
            if (!nearest || way < nearest->way) {
                nearest = MaterialEnd{way, below > above ? piece.from_move : piece.to_move};
            }
        }
    }
    return nearest;
}

std::optional<MaterialEnd> MaterialProbe::end(const Vec3& place, const Vec3& direction) const {
    int k = 0;
    direction.cwiseAbs().maxCoeff(&k);
    const bool up = direction[k] > 0.0;
    const double at = place[k] - field_.box().min()[k];
    std::optional<MaterialEnd> found;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Dexel& piece : line_at(place, k)) {
        const auto from = static_cast<double>(piece.from), to = static_cast<double>(piece.to);
        const double apart = std::max({from - at, at - to, 0.0});
        if (apart < nearest) {
            nearest = apart;
            const double way = up ? to - at : at - from;
            found = MaterialEnd{way / std::abs(direction[k]), up ? piece.to_move : piece.from_move};
        }
    }
    return found;
}

} // namespace millwright::simulation
