// How large the roundings of a program are made, and how fast they are gone through: between two rests with
// the tolerance, up to the programmed one, and the share of the acceleration for turning that are fastest. A
// larger rounding is not always faster: its bend takes acceleration from the motion along it, on a longer way
// (docs/reference/motion.md#how-large-a-rounding-is).
#pragma once

#include "core/motion/internal/axis_path.h"

#include <limits>
#include <list>
#include <optional>
#include <vector>

namespace millwright::motion::internal {

// The duration of a way that is laid block by block: what is settled is counted and forgotten.

class TimeWindow {
public:
    /// From rest at `start`. Machine and settings must outlive it.
    TimeWindow(const Mechanism& machine,
               const PlannerSettings& settings,
               const kinematics::AxisPositions& start,
               double filter_time);

    /// From the next corner on.
    void set_rounding_bounds(const RoundingBounds& bounds) { builder_.set_rounding_bounds(bounds); }
    /// As AxisPathBuilder::add().
    void add(const program::Block& block, double path_acceleration = std::numeric_limits<double>::infinity());
    /// Of all blocks, s, the last one ending at rest. Nothing is added after it.
    [[nodiscard]] double finish();
    /// Blocks that are in memory now.
    [[nodiscard]] int block_count() const { return builder_.block_count(); }

private:
    static constexpr int least_window = 4096; ///< blocks

    double filter_time_;
    AxisPathBuilder builder_;
    int full_ = least_window;
    double way_ = 0.0, speed_ = 0.0; ///< up to which the time is counted
    bool moving_ = false;            ///< since the last rest
    double time_ = 0.0;

    void pass(bool all);
};

class RoundingChoice {
public:
    /// Of blocks from `first` on, up to the next section.
    struct Section {
        int first = 0;
        RoundingBounds bounds;
    };

    /// As TimeWindow. With `keep` the sections are kept.
    RoundingChoice(const Mechanism& machine,
                   const PlannerSettings& settings,
                   const kinematics::AxisPositions& start,
                   double filter_time,
                   bool keep);

    void add(const program::Block& block, double path_acceleration = std::numeric_limits<double>::infinity());
    /// Of all blocks, s, with the fastest roundings. Nothing is added after it.
    [[nodiscard]] double finish();
    /// Blocks that are in memory now, of one choice.
    [[nodiscard]] int block_count() const { return tries_.back().window.block_count(); }
    /// After finish(), in their order.
    [[nodiscard]] const std::vector<Section>& sections() const { return sections_; }

private:
    /// The blocks since the last rest, with roundings within one tolerance.
    struct Try {
        RoundingBounds bounds;
        TimeWindow window;
    };
    /// A move as its corners see it.
    struct Straight {
        kinematics::AxisPositions unit;
        bool rapid = false;
        program::PathControl path;
    };

    const Mechanism& machine_;
    const PlannerSettings& settings_;
    double filter_time_;
    bool keep_;
    std::vector<AxisLimits> limits_;
    kinematics::AxisPositions at_;
    std::optional<Straight> last_; ///< none: at rest
    std::list<Try> tries_;         ///< tolerances ascend, up to the programmed ones
    std::list<Try> eager_tries_;   ///< the same with the greatest share for turning; none without roundings
    std::vector<Section> sections_;
    int block_ = 0;     ///< the next one
    int begin_ = 0;     ///< of the section
    double time_ = 0.0; ///< of the sections before

    static void insert(std::list<Try>& tries, double tolerance);
    void meet(const Straight& next);
    void try_up_to(double tolerance);
    void close_section();
    void open_section();
};

} // namespace millwright::motion::internal
