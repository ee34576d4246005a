#include "core/plot/carving/internal/carving_path.h"

#include "core/plot/internal/point_grid.h"
#include "core/plot/path_bound.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace millwright::plot::internal {
namespace {

class CarvingPathBuilder {
public:
    explicit CarvingPathBuilder(const CarvingSettings& settings) : settings_(settings) {}

    /// Nearest next; a line may be entered at either end.
    void cut_nearest_next(const std::vector<CutLine>& lines, const Progress& progress) {
        std::vector<Vec2> ends;
        for (const CutLine& line : lines) {
            ends.push_back(line.front().head<2>());
            ends.push_back(line.back().head<2>());
        }
        PointGrid grid(ends);
        while (!grid.empty()) {
            progress.check();
            const int end = grid.nearest(at_);
            grid.remove(end);
            grid.remove(end ^ 1);
            const CutLine& line = lines[static_cast<std::size_t>(end / 2)];
            cut(end % 2 == 0 ? line : CutLine(line.rbegin(), line.rend()));
        }
    }

    [[nodiscard]] const Vec2& at() const { return at_; }
    CutPath take() { return std::move(path_); }

private:
    void cut(const CutLine& line) {
        constexpr std::size_t in_the_air = 3;
        expect_not_too_long(path_.size() + line.size() + in_the_air);
        const Vec3& begin = line.front();
        path_.push_back({.at = {begin.x(), begin.y(), settings_.safe_height}});
        path_.push_back({.at = begin, .speed = settings_.plunging, .move = CutMove::plunge});
        for (std::size_t n = 1; n < line.size(); ++n) {
            path_.push_back({.at = line[n], .speed = speed_of(line[n] - line[n - 1]), .move = CutMove::cut});
        }
        at_ = line.back().head<2>();
        path_.push_back({.at = {at_.x(), at_.y(), settings_.safe_height}, .move = CutMove::retract});
    }

    /// Down no faster than the bit plunges.
    [[nodiscard]] double speed_of(const Vec3& move) const {
        const double down = -move.z();
        return down > 0.0 ? std::min(settings_.cutting, settings_.plunging * move.norm() / down)
                          : settings_.cutting;
    }

    const CarvingSettings& settings_;
    CutPath path_;
    Vec2 at_ = Vec2::Zero();
};

} // namespace

CutPath carving_path(const std::vector<PartPasses>& parts,
                     const CarvingSettings& settings,
                     const Progress& progress) {
    std::vector<Vec2> ends;
    std::vector<std::size_t> part_of;
    std::vector<std::vector<int>> ends_of(parts.size());
    for (std::size_t n = 0; n < parts.size(); ++n) {
        for (const CutLine& line : parts[n].empty() ? std::vector<CutLine>() : parts[n].front()) {
            for (const Vec3& end : {line.front(), line.back()}) {
                ends_of[n].push_back(static_cast<int>(ends.size()));
                ends.push_back(end.head<2>());
                part_of.push_back(n);
            }
        }
    }
    PointGrid grid(ends);
    CarvingPathBuilder builder(settings);
    while (!grid.empty()) {
        const std::size_t part = part_of[static_cast<std::size_t>(grid.nearest(builder.at()))];
        for (const int end : ends_of[part]) {
            grid.remove(end);
        }
        for (const std::vector<CutLine>& pass : parts[part]) {
            builder.cut_nearest_next(pass, progress);
        }
    }
    return builder.take();
}

} // namespace millwright::plot::internal
