// Any text is a formula with finite values at every node or an Error with its column, never a crash or a
// number that is not finite; a fault that is known without a grid is one on a grid.
#include "core/geometry/presets.h"
#include "core/grid/expression_weight.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace millwright;
using namespace millwright::grid;

void demand(bool promise) {
    if (!promise) {
        std::abort();
    }
}

FormulaGround ground() {
    return {std::make_shared<const geometry::BezierPatch>(
                geometry::surface_preset("dome").make().patch(geometry::PatchId{0})),
            constant_weight(0.1)};
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    constexpr int n = 4;
    const auto fault = fault_of_expression(text);
    demand(!fault || fault->place.column > 0);
    try {
        const WeightPtr weight = expression_weight(text, n, n, ground());
        demand(!fault);
        std::vector<Vec2> nodes;
        for (int k = 0; k < n * n; ++k) {
            nodes.emplace_back(k / n, k % n);
        }
        std::vector<double> w(nodes.size());
        weight->values(nodes, w);
        for (const double value : w) {
            demand(std::isfinite(value));
        }
    } catch (const Error& error) {
        demand(error.diagnostic().place.column > 0 && !error.diagnostic().message.empty());
    }
    return 0;
}
