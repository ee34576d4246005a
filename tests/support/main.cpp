// Runs one folder's tests in a shuffled order with a printed seed. In the checked build floating-point traps
// stop a test of the core on the line where a NaN is born.
#include <gtest/gtest.h>

#ifdef MILLWRIGHT_TRAPS
#include <cfenv>
#endif

#ifdef __SANITIZE_ADDRESS__
/// The driver of OpenGL stays loaded to the end. Unloaded, what it keeps is reported as leaks of no known
/// library, which tests/support/leaks.txt could not name.
extern "C" int dlclose(void* /*library*/) noexcept { // NOLINT: the C library's
    return 0;
}
#endif

int main(int argc, char** argv) {
#ifdef MILLWRIGHT_TRAPS
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
#endif
    GTEST_FLAG_SET(shuffle, true);
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
