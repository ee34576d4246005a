#include "core/simulation/internal/collision_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::simulation {

namespace {

using kinematics::MachineModel;

/// How many axes lie between the base and what `letter` carries, on its side of the machine; 0: the base.
struct PlaceInChain {
    bool head = false;
    int number = 0;
};

PlaceInChain place_of(const MachineModel& machine, char letter) {
    for (const bool head : {false, true}) {
        const auto& chain = head ? machine.head_chain() : machine.table_chain();
        for (std::size_t n = 0; n < chain.size(); ++n) {
            if (machine.axis(chain[n]).letter == letter) {
                return {head, static_cast<int>(n) + 1};
            }
        }
    }
    return {};
}

class PairList {
public:
    PairList(const MachineModel& machine, const CollisionInput& input, std::vector<std::string>& unchecked)
        : machine_(machine), input_(input), unchecked_(unchecked) {}

    void add_tool(const CollisionTool& tool) {
        const auto add_body = [&](const char* name, const std::optional<toolpath::Profile>& profile) {
            if (profile) {
                add_turned(name, *profile);
            }
        };
        add_body("cutter", tool.cutter);
        add_body("shank", tool.shank);
        add_body("holder", tool.holder);
        if (!tool.holder && (tool.cutter || tool.shank)) {
            unchecked_.emplace_back("the tool has no holder: only its cutter and shank are checked");
        }
    }

    void add_machine() {
        const bool none = std::ranges::none_of(
            input_.bodies, [](const CollisionBody& body) { return body.role == BodyRole::machine; });
        if (none) {
            unchecked_.emplace_back(
                "the machine has no bodies: spindle head, table and frame are not checked");
        }
        for (std::size_t n = 0; n < input_.bodies.size(); ++n) {
            for (std::size_t k = n + 1; k < input_.bodies.size(); ++k) {
                add_bodies(input_.bodies[n], input_.bodies[k]);
            }
        }
    }

    std::vector<CollisionPair> take() {
        std::stable_sort(pairs_.begin(), pairs_.end(), [](const CollisionPair& a, const CollisionPair& b) {
            return std::pair(a.moving_carrier(), a.still_carrier()) <
                   std::pair(b.moving_carrier(), b.still_carrier());
        });
        return std::move(pairs_);
    }

private:
    void add_turned(const char* name, const toolpath::Profile& profile) {
        constexpr int sides = 256, few_sides = 24; // a side of a cutter of 16 mm is 0.6 um within it
        const geometry::ToolPose pose{machine_.description().tool_tip, machine_.description().tool_axis};
        const auto body = std::make_shared<const TurnedBody>(
            TurnedBody{name,
                       profile,
                       pose,
                       std::make_shared<const CollisionMesh>(surface_of(profile, pose, sides)),
                       std::make_shared<const CollisionMesh>(surface_of(profile, pose, few_sides))});
        const bool holder = std::string_view(name) == "holder";
        const bool cutter = std::string_view(name) == "cutter";
        for (const CollisionBody& still : input_.bodies) {
            const bool on_head = place_of(machine_, still.carrier).head;
            const bool in_stock = still.role == BodyRole::stock;
            if (on_head || in_stock || (cutter && still.role == BodyRole::cut_faces)) {
                continue;
            }
            const bool part = still.role == BodyRole::part || still.role == BodyRole::cut_faces;
            const double allowance =
                part && !holder ? std::max(input_.part_allowance, touch_depth) : touch_depth;
            pairs_.emplace_back(body, tool_carrier(machine_), still, allowance, holder || !part);
        }
    }

    void add_bodies(const CollisionBody& one, const CollisionBody& other) {
        const PlaceInChain a = place_of(machine_, one.carrier), b = place_of(machine_, other.carrier);
        const bool both_work = one.role != BodyRole::machine && other.role != BodyRole::machine;
        const bool machines = both_machine(one, other);
        const bool one_side = a.head == b.head || a.number == 0 || b.number == 0;
        const bool neighbours = one_side && std::abs(a.number - b.number) == 1;
        if (one.carrier == other.carrier || both_work || (machines && neighbours)) {
            return; // they never move against each other, or one guides the other
        }
        // The one with the fewer axes behind it is the still one; of head and table the table.
        const bool one_moves = a.head != b.head ? a.head || b.number == 0 : a.number > b.number;
        const CollisionBody& moving = one_moves ? one : other;
        const CollisionBody& still = one_moves ? other : one;
        constexpr double drawn_apart = 0.1; // mm: what is nearer was drawn to touch
        CollisionPair pair(moving, still);
        const kinematics::AxisPositions zero = at_physical_zero();
        const RelativeMotion motion(machine_, zero, zero, moving.carrier, still.carrier);
        const bool opposite = (a.head || b.head) && !machines;
        if (!opposite && (pair.are_within(motion.at(0.0), drawn_apart) || pair.is_inside(motion))) {
            unchecked_.push_back(fmt::format("\"{}\" and \"{}\" are drawn into each other with all axes at "
                                             "zero, or touch: not checked against each other",
                                             moving.name,
                                             still.name));
            return;
        }
        pairs_.push_back(std::move(pair));
    }

    static bool both_machine(const CollisionBody& one, const CollisionBody& other) {
        return one.role == BodyRole::machine && other.role == BodyRole::machine;
    }

    [[nodiscard]] kinematics::AxisPositions at_physical_zero() const {
        kinematics::AxisPositions zero(machine_.axis_count());
        for (int n = 0; n < machine_.axis_count(); ++n) {
            zero[n] = -machine_.axis(n).zero_offset;
        }
        return zero;
    }

    const MachineModel& machine_;
    const CollisionInput& input_;
    std::vector<std::string>& unchecked_;
    std::vector<CollisionPair> pairs_;
};

} // namespace

std::vector<CollisionPair> pairs_of(const MachineModel& machine,
                                    const CollisionTool& tool,
                                    const CollisionInput& input,
                                    std::vector<std::string>& unchecked) {
    PairList list(machine, input, unchecked);
    list.add_tool(tool);
    list.add_machine();
    return list.take();
}

} // namespace millwright::simulation
