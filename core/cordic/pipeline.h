// The iteration unrolled into a pipeline: a register behind every step and correction, a new vector in each
// clock, its result as many clocks later as there are stages. The same bits as the iterative kernel, whose
// steps it uses.
#pragma once

#include "core/cordic/kernel.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace millwright::cordic {

template <class Arithmetic> class Pipeline {
public:
    using Number = typename Arithmetic::Number;
    using Vector = Vector3<Number>;

    struct Result {
        Vector vector;
        bool overflow = false;
    };

    Pipeline(const Kernel<Arithmetic>& kernel, Mode mode)
        : kernel_(kernel), mode_(mode), stages_(static_cast<std::size_t>(kernel.sequence().clock_count())) {}

    /// One clock: takes a vector (or none, a bubble) in, gives the one that is ready out.
    std::optional<Result> clock(const std::optional<Vector>& in) {
        const std::optional<Result> out = stages_.back();
        for (std::size_t n = stages_.size() - 1; n > 0; --n) {
            stages_[n] = stages_[n - 1];
            work(stages_[n], static_cast<int>(n));
        }
        stages_[0].reset();
        if (in) {
            stages_[0] = Result{*in, false};
            work(stages_[0], 0);
        }
        return out;
    }

    /// Clocks from a vector's entry to its result.
    [[nodiscard]] int latency() const { return static_cast<int>(stages_.size()); }

private:
    void work(std::optional<Result>& stage, int n) const {
        if (!stage) {
            return;
        }
        Vector& v = stage->vector;
        const int j = n - kernel_.sequence().step_count;
        if (j < 0) {
            kernel_.step(v, n, kernel_.direction(mode_, v), stage->overflow);
        } else if (kernel_.sequence().multiplies) {
            v.x = kernel_.multiplied(v.x, stage->overflow);
            v.y = kernel_.multiplied(v.y, stage->overflow);
        } else {
            v.x = kernel_.corrected(v.x, j, stage->overflow);
            v.y = kernel_.corrected(v.y, j, stage->overflow);
        }
    }

    Kernel<Arithmetic> kernel_;
    Mode mode_;
    std::vector<std::optional<Result>> stages_; ///< what each register holds
};

} // namespace millwright::cordic
