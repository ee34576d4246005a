#include "core/drivers/point_track.h"

#include "core/drivers/table_axes.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

namespace millwright::drivers {

namespace {

/// What to do about an axis that is too slow: strokes go up and down at a velocity of their own.
std::string slower(char axis) {
    return axis == 'Z' ? "decode it with a lower plunge velocity (--plunge-velocity), or with more digits"
                       : "decode it with a lower velocity, also with the pen up (--travel-velocity), with "
                         "samples rounded up, or with more digits";
}

class PointChecks {
public:
    PointChecks(const PointTrack& track,
                const kinematics::MachineModel& model,
                const std::filesystem::path& file)
        : track_(track), model_(model), file_(file), index_(table_axes(model)) {}

    std::vector<Diagnostic> take() {
        for (std::size_t n = 0; n < track_.points.size(); ++n) {
            for (std::size_t k = 0; k < index_.size(); ++k) {
                check(n, k, model_.axis(static_cast<int>(index_[k])));
            }
        }
        return std::move(found_);
    }

private:
    const PointTrack& track_;
    const kinematics::MachineModel& model_;
    const std::filesystem::path& file_;
    std::array<std::size_t, 3> index_; ///< of X, Y, Z
    double digit_ = std::pow(10.0, -point_decimals);
    std::vector<Diagnostic> found_;
    std::set<std::pair<std::size_t, bool>> reported_;

    [[nodiscard]] double written(std::size_t n, std::size_t k) const {
        return std::round(track_.points[n][static_cast<Eigen::Index>(k)] / digit_) * digit_;
    }

    void check(std::size_t n, std::size_t k, const kinematics::MachineAxis& axis) {
        const double at = track_.points[n][static_cast<Eigen::Index>(k)];
        if (!(at >= axis.min && at <= axis.max)) {
            report(n,
                   k,
                   true,
                   fmt::format("axis {} would move to {:.3f}, outside {:.3f} ... {:.3f} mm",
                               axis.letter,
                               at,
                               axis.min,
                               axis.max));
        }
        const double way = n == 0 ? 0.0 : std::abs(written(n, k) - written(n - 1, k));
        constexpr double last_bits = 1e-3; // of a digit
        if (way > axis.max_velocity * track_.period + last_bits * digit_) {
            report(n,
                   k,
                   false,
                   fmt::format(
                       "axis {} would move {:.{}f} mm in {} s at {:.6g} mm/s, but its maximum is {:.6g} mm/s",
                       axis.letter,
                       way,
                       point_decimals,
                       track_.period,
                       way / track_.period,
                       axis.max_velocity));
        }
    }

    void report(std::size_t n, std::size_t k, bool place, std::string sentence) {
        if (reported_.insert({k, place}).second) {
            found_.push_back({{file_, static_cast<int>(n) + 1, 0, -1},
                              std::move(sentence),
                              place ? std::string() : slower("XYZ"[k])});
        }
    }
};

} // namespace

std::vector<Diagnostic> check_points(const PointTrack& track,
                                     const kinematics::MachineModel& model,
                                     const std::filesystem::path& file) {
    return PointChecks(track, model, file).take();
}

} // namespace millwright::drivers
