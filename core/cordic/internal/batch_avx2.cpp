// The loop of batch.cpp with eight numbers in a register; compiled for AVX2, called where the processor has
// it.
#include "core/cordic/internal/batch_lanes.h"

namespace millwright::cordic::internal {

BatchLoop avx2_batch_loop() {
#ifdef __AVX2__
    return rotate_batch<avx2_batch / 2>;
#else
    return nullptr;
#endif
}

} // namespace millwright::cordic::internal
