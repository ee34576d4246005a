#include "core/toolpath/strategy.h"

#include "core/base/error.h"
#include "core/toolpath/constant_scallop.h"
#include "core/toolpath/fewest_points.h"
#include "core/toolpath/spiral.h"
#include "core/toolpath/zigzag.h"

namespace millwright::toolpath {

namespace {

class Zigzag final : public Strategy {
public:
    [[nodiscard]] Toolpath contacts(const Covering& of, const Progress& progress) const override {
        Toolpath path = zigzag(of.patch, of.grid, of.direction, of.flipped, of.outline);
        progress.report(1.0);
        return path;
    }
};

} // namespace

std::unique_ptr<Strategy> make_strategy(const StrategySettings& settings) {
    switch (settings.kind) {
    case StrategyKind::zigzag:
        return std::make_unique<Zigzag>();
    case StrategyKind::spiral:
        return std::make_unique<Spiral>();
    case StrategyKind::constant_scallop:
        return std::make_unique<ConstantScallop>(settings.scallop);
    case StrategyKind::fewest_points:
        return std::make_unique<FewestPoints>(settings.tolerance);
    }
    throw Defect("a strategy is one of its kinds");
}

} // namespace millwright::toolpath
