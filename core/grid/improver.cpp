#include "core/grid/improver.h"

namespace millwright::grid {

ImproverState run(GridImprover& improver, const Progress& progress) {
    while (improver.advance(progress)) {
        progress.check();
    }
    return improver.state();
}

} // namespace millwright::grid
