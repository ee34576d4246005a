// Cutting: moves of cutters take material from a field. Each tile of lines is cut by one thread, move after
// move, so that the result is the same bytes on any number of threads. Lengths mm.
#pragma once

#include "core/base/progress.h"
#include "core/simulation/dexel_field.h"
#include "core/simulation/swept_cutter.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace millwright::simulation {

/// A rapid move that stays shallower than this is no finding: surfaces are cut to within a fraction of a
/// micrometre, and a tool that leaves them at rapid grazes them.
inline constexpr double contact_depth = 0.01;

/// A cutter, and the one that has to meet material for a finding: smaller by `contact_depth` all around.
struct CuttingBody {
    BodyRay body;
    BodyRay core;

    explicit CuttingBody(const toolpath::Profile& profile);
};

/// Shank and holder remove nothing: only their contact is looked for.
enum class ToolPart : std::uint8_t { cutter, shank, holder };

/// A step of a move.
struct CutStep {
    const CuttingBody* cutter = nullptr;
    geometry::ToolPose from{}, to{}; ///< at most `largest_turn` apart
    std::int32_t move = 0;           ///< the id that ends of the material get
    bool contact_counts = false;     ///< MoveCut::contact is wanted
    ToolPart part = ToolPart::cutter;
};

/// No straight move is divided into more.
inline constexpr double most_steps_per_move = 1e7;
/// How many steps a straight move is divided into.
[[nodiscard]] double
step_count(const CuttingBody& cutter, const geometry::ToolPose& from, const geometry::ToolPose& to);

/// A straight move, with the axis turning evenly: appends its steps to `steps`. Throws Defect if there are
/// more than `most_steps_per_move`.
void divide(const CuttingBody& cutter,
            const geometry::ToolPose& from,
            const geometry::ToolPose& to,
            std::int32_t move,
            bool contact_counts,
            std::vector<CutStep>& steps);

/// Where a move met material.
struct Contact {
    double length = 0.0;       ///< the longest piece of a line that was met, mm
    Vec3 place = Vec3::Zero(); ///< its middle, part coordinates
};

/// Where on the tool material was removed: heights above the tip along the axis, and places across axis and
/// direction of the move. Ends of lines count, so that it is known to a cell. Lengths mm.
struct Engagement {
    double lowest = 1e300, highest = -1e300;
    double leftmost = 1e300, rightmost = -1e300;

    [[nodiscard]] double depth() const { return std::max(highest - lowest, 0.0); }
    [[nodiscard]] double width() const { return std::max(rightmost - leftmost, 0.0); }
    void extend(double height, double across) {
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
        leftmost = std::min(leftmost, across);
        rightmost = std::max(rightmost, across);
    }
    void extend(const Engagement& other) {
        lowest = std::min(lowest, other.lowest);
        highest = std::max(highest, other.highest);
        leftmost = std::min(leftmost, other.leftmost);
        rightmost = std::max(rightmost, other.rightmost);
    }
};

/// What a move removed.
struct MoveCut {
    double volume = 0.0; ///< mm^3; the mean of the three families
    std::optional<Contact> contact{};
    Engagement engaged{};
};

class Removal {
public:
    /// `field` must outlive it.
    explicit Removal(DexelField& field) : field_(field) {}

    /// Cuts along `steps`, in order. Throws Cancelled; the field is then partly cut.
    void remove(std::span<const CutStep> steps, const Progress& progress);

    /// Moves that removed anything, by id.
    [[nodiscard]] const std::map<std::int32_t, MoveCut>& cuts() const { return cuts_; }

    /// Where shank or holder met material, deepest, by the id of the move.
    [[nodiscard]] const std::map<std::int32_t, Contact>& contacts(ToolPart part) const {
        return part == ToolPart::shank ? shank_contacts_ : holder_contacts_;
    }

    /// Forgets what moves from `move` on removed, and adds up only what these remove from now on: those
    /// before are known, and are cut again.
    void record_from(std::int32_t move);

private:
    void remove_batch(std::span<const CutStep> steps, const Progress& progress);

    DexelField& field_;
    std::map<std::int32_t, MoveCut> cuts_;
    std::map<std::int32_t, Contact> shank_contacts_, holder_contacts_;
    std::int32_t first_recorded_ = 0;
};

} // namespace millwright::simulation
