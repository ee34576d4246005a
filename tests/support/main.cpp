// Runs one folder's tests. In the checked build floating-point traps stop on the line where a NaN is born.
#include <gtest/gtest.h>

#ifdef MILLWRIGHT_TRAPS
#include <cfenv>
#endif

int main(int argc, char** argv) {
#ifdef MILLWRIGHT_TRAPS
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
#endif
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
