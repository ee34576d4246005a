#include "core/simulation/internal/block_index.h"

#include "core/kinematics/forward.h"

#include <algorithm>
#include <cmath>

namespace millwright::simulation {

const ToolUse* tool_of(const SimulationInput& input, int block) {
    const ToolUse* found = nullptr;
    for (const ToolUse& tool : input.tools) {
        if (tool.first_block <= block) {
            found = tool.body ? &tool : nullptr;
        }
    }
    return found;
}

namespace {

Box3 box_of_sweep(const SimulationInput& input, int block, const ToolUse& tool) {
    const kinematics::StraightForward way(tool.machine ? *tool.machine : input.machine,
                                          program::position_before(input.program, block),
                                          input.program.blocks[static_cast<std::size_t>(block)].target);
    const toolpath::ProfileShape& shape = tool.body->shape();
    Box3 box;
    for (const double f : {0.0, 1.0}) {
        const geometry::ToolPose pose = way.at(f);
        box.extend(Vec3(pose.tip + shape.bottom * pose.axis));
        box.extend(Vec3(pose.tip + shape.top * pose.axis));
    }
    // A curve whose second derivative is at most b leaves its chord by b / 8.
    const kinematics::Bend bend = way.bend();
    const double longest = std::max(std::abs(shape.top), std::abs(shape.bottom));
    const double more = shape.radius + (bend.tip + longest * bend.axis) / 8.0;
    return {box.min() - Vec3::Constant(more), box.max() + Vec3::Constant(more)};
}

} // namespace

BlockIndex::BlockIndex(const SimulationInput& input, int first) {
    for (int n = first; n < input.program.block_count(); ++n) {
        const ToolUse* tool = tool_of(input, n);
        if (tool != nullptr && input.program.blocks[static_cast<std::size_t>(n)].moves()) {
            entries_.push_back({box_of_sweep(input, n, *tool), n});
        }
    }
    if (!entries_.empty()) {
        nodes_.push_back({{}, 0, entries_.size(), 0});
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            split(n);
        }
    }
}

void BlockIndex::split(std::size_t at) {
    constexpr std::size_t leaf = 4;
    Node& node = nodes_[at];
    const std::size_t from = node.from, to = node.to;
    for (std::size_t n = from; n < to; ++n) {
        node.box.extend(entries_[n].box);
    }
    if (to - from <= leaf) {
        return;
    }
    int axis = 0;
    node.box.sizes().maxCoeff(&axis);
    const std::size_t middle = from + (to - from) / 2;
    const auto begin = entries_.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(from),
                     begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(to),
                     [&](const Entry& a, const Entry& b) {
                         return a.box.min()[axis] + a.box.max()[axis] < b.box.min()[axis] + b.box.max()[axis];
                     });
    node.left = nodes_.size();
    nodes_.push_back({{}, from, middle, 0}); // `node` is not valid from here on
    nodes_.push_back({{}, middle, to, 0});
}

void BlockIndex::add_around(const Vec3& point, std::vector<int>& blocks) const {
    std::vector<std::size_t> open;
    if (!nodes_.empty()) {
        open.push_back(0);
    }
    while (!open.empty()) {
        const Node& node = nodes_[open.back()];
        open.pop_back();
        if (!node.box.contains(point)) {
            continue;
        }
        if (node.left != 0) {
            open.push_back(node.left);
            open.push_back(node.left + 1);
            continue;
        }
        for (std::size_t n = node.from; n < node.to; ++n) {
            if (entries_[n].box.contains(point)) {
                blocks.push_back(entries_[n].block);
            }
        }
    }
}

} // namespace millwright::simulation
