// What a project's program leaves of a stock: cut along the whole program, compared with the part, looked at
// for collisions, and then shown at any block, forwards and back. docs/reference/simulation.md. Lengths mm.
#pragma once

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/geometry/solid.h"
#include "core/plan/part_heights.h"
#include "core/plan/part_stock.h"
#include "core/plan/plan.h"
#include "core/simulation/collision.h"
#include "core/simulation/comparison.h"
#include "core/simulation/cut_mesh.h"
#include "core/simulation/engagement.h"
#include "core/simulation/simulator.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::plan {

/// What a person chooses.
struct StockSettings {
    std::string stock;      ///< as core/simulation/spec_text.h has it; empty: the box around the part
    double allowance = 2.0; ///< of that box, on every side
    std::optional<double> resolution; ///< the longest edge of a cell; nullopt: usual_resolution()
    double tolerance = 0.1;           ///< of the comparison
    double clearance = 1.0;           ///< bodies that come nearer are near misses

    friend bool operator==(const StockSettings&, const StockSettings&) = default;
};

/// Whether a simulation by the one is also one by the other: the allowance counts for the box around the part
/// only.
[[nodiscard]] bool give_the_same(const StockSettings& a, StockSettings b);

/// What a G-code file is simulated with, which has no part.
struct FileSetup {
    std::shared_ptr<const kinematics::MachineModel> machine; ///< not null
    std::vector<simulation::ToolUse> tools;                  ///< in the order of the blocks
    std::vector<Diagnostic> warnings;                        ///< of reading it
};

/// Of one plan, whose program is that of the project's tool; or of a G-code file.
struct StockJob {
    project::Project project;                          ///< of a plan
    std::shared_ptr<const geometry::Surface> surface;  ///< not null of a plan
    std::shared_ptr<const CuttingSetup> cutting_setup; ///< not null of a plan
    std::shared_ptr<const program::Program> program;   ///< not null
    std::shared_ptr<const program::Listing> listing;   ///< not null
    /// Bodies of the machine as the window draws them; null: the simple ones of its file.
    std::shared_ptr<const std::vector<geometry::SolidBody>> machine_solids;
    StockSettings settings;
    std::optional<FileSetup> file{}; ///< nullopt: of a plan

    [[nodiscard]] const kinematics::MachineModel& machine() const {
        return file ? *file->machine : cutting_setup->machine;
    }
};

/// What the field of a stock takes, before anything is made.
struct StockForecast {
    double resolution = 0.0;    ///< the longest edge of a cell
    std::size_t bytes = 0;      ///< of the field
    std::size_t most_bytes = 0; ///< that it may have; more is refused
    std::string fault;          ///< why the stock cannot be cut, as a sentence; empty if it can

    friend bool operator==(const StockForecast&, const StockForecast&) = default;
};
[[nodiscard]] StockForecast forecast_of(const simulation::Stock& stock, std::optional<double> resolution);
/// Of the stock that `settings` name; `surface`: of the box around the part. A mesh is read from its file.
/// Throws Error, Cancelled.
[[nodiscard]] StockForecast
forecast_of(const geometry::Surface* surface, const StockSettings& settings, const Progress& progress);

/// Something that may not happen, on one block or on several in a row.
enum class StockEventKind : std::uint8_t { collision, rapid_in_stock, spindle_off, axis_limit, near_miss };
struct StockEvent {
    StockEventKind kind = StockEventKind::collision;
    int block = 0;
    double fraction = 0.0; ///< of the block, 0 to 1
    int line = 0;          ///< of the listing
    std::string bodies;    ///< "holder and part"
    double depth = 0.0;    ///< mm; of a near miss the distance; of a rotary axis beyond its limit rad
    bool angle = false;    ///< `depth` is one
    int moves = 1;         ///< in a row
};

/// Immutable once published.
struct StockResult {
    StockJob job;
    simulation::Stock stock;
    std::string stock_text;
    Vec3 cell = Vec3::Zero();                  ///< edges of a cell
    simulation::Simulation cut;                ///< without its field
    std::vector<simulation::PartPoint> points; ///< of the machined face, that were looked at; of a file none
    std::vector<simulation::Deviation> deviations; ///< one per point
    std::vector<simulation::FeedEngagement> feeds; ///< in the order of the blocks
    simulation::EngagementSummary engagement;
    std::vector<StockEvent> events; ///< collisions first, near misses last, each in the order of the blocks
    std::vector<std::string> unchecked; ///< of collisions, a sentence each
    std::vector<Diagnostic> warnings;   ///< with lines of the listing
};

/// What the blocks before one have left. Immutable once published.
struct StockPicture {
    std::shared_ptr<const StockResult> result;
    int block = 0;
    simulation::CutMesh mesh;
    std::vector<std::optional<double>> heights; ///< one per point: over the machined face
};

class StockSimulation {
public:
    /// Cuts, compares and looks for collisions. Throws Error with the line of the listing, Cancelled.
    StockSimulation(StockJob job, const Progress& progress);
    StockSimulation(const StockSimulation&) = delete;
    StockSimulation& operator=(const StockSimulation&) = delete;
    ~StockSimulation();

    [[nodiscard]] const std::shared_ptr<const StockResult>& result() const { return result_; }
    /// Throws Cancelled; it can be asked again then.
    [[nodiscard]] StockPicture picture_before(int block, const Progress& progress);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
    std::shared_ptr<const StockResult> result_;
};

} // namespace millwright::plan
