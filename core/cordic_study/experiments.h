// The accuracy experiments E1 to E7 of the thesis (chapter 5), computed anew: what its figures show, with the
// largest errors as numbers. Its E7 program is lost but for the first block; ours obeys all that is known of
// it (docs/reference/cordic.md#experiments). All in binary64 with the 29-step sequence, as the thesis's own
// runs.
#pragma once

#include "core/cordic_study/chart.h"

#include <string>
#include <vector>

namespace millwright::cordic {

struct Picture {
    std::string name; ///< file name without folder: e1-pre.svg
    std::string svg;
};

struct Finding {
    std::string experiment; ///< E1
    std::string what;
    double largest_error = 0.0;
};

struct Experiments {
    std::vector<Picture> pictures;
    std::vector<Finding> findings;
};

[[nodiscard]] Experiments run_experiments();

} // namespace millwright::cordic
