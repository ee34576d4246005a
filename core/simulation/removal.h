// Cutting: moves of cutters take material from a field. Each tile of lines is cut by one thread, move after
// move, so that the result is the same bytes on any number of threads. Lengths mm.
#pragma once

#include "core/base/progress.h"
#include "core/simulation/dexel_field.h"
#include "core/simulation/swept_cutter.h"

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

/// A step of a move.
struct CutStep {
    const CuttingBody* cutter = nullptr;
    geometry::ToolPose from, to; ///< at most `largest_turn` apart
    std::int32_t move = 0;       ///< the id that ends of the material get
    bool contact_counts = false; ///< MoveCut::contact is wanted
    bool removes = true;         ///< false: of a body that does not cut only the contact is looked for
};

/// A straight move, with the axis turning evenly: appends its steps to `steps`.
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

/// What a move removed.
struct MoveCut {
    double volume = 0.0; ///< mm^3; the mean of the three families
    std::optional<Contact> contact{};
};

class Removal {
public:
    /// `field` must outlive it.
    explicit Removal(DexelField& field) : field_(field) {}

    /// Cuts along `steps`, in order. Throws Cancelled; the field is then partly cut.
    void remove(std::span<const CutStep> steps, const Progress& progress);

    /// Moves that removed anything, by id.
    [[nodiscard]] const std::map<std::int32_t, MoveCut>& cuts() const { return cuts_; }

private:
    void remove_batch(std::span<const CutStep> steps, const Progress& progress);

    DexelField& field_;
    std::map<std::int32_t, MoveCut> cuts_;
};

} // namespace millwright::simulation
