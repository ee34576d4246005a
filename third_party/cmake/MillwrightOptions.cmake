# Language, warnings and sanitizers: the same for every target of ours.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})

# ccache shares its results between checkouts: paths are made relative, and the build folder is not hashed. A precompiled
# header is known by the file beside it (millwright_precompile), the compiler by its content, so that another
# installation of it counts as the same.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER
        ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 CCACHE_PCH_EXTSUM=1
            CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_COMPILERCHECK=content
            ${CCACHE_PROGRAM})
endif()

set(MILLWRIGHT_SANITIZE "" CACHE STRING "Sanitizers, as -fsanitize takes them; empty for none")
set(MILLWRIGHT_UNIT_KB 100 CACHE STRING "Compile sources in units of so many kilobytes; 0: each file alone")
option(MILLWRIGHT_CHECKED "Checked standard library and floating-point traps in core tests" OFF)
option(MILLWRIGHT_PLAIN_THREADS "Parallel loops on std::jthread instead of oneTBB (for ThreadSanitizer)" OFF)

add_library(millwright_options INTERFACE)
target_include_directories(millwright_options INTERFACE ${PROJECT_SOURCE_DIR})
# Results must not depend on the compiler fusing a*b+c. scripts/build counts the warnings: -Werror would stop a user
# whose compiler is newer than ours.
target_compile_options(millwright_options INTERFACE
    -ffp-contract=off
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual
    -Wdouble-promotion -Wformat=2 -Wcast-align -Wfloat-equal -Wundef)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Without it ccache gives up on whatever uses a precompiled header.
    target_compile_options(millwright_options INTERFACE -fpch-preprocess)
endif()
# Libraries that a program does not call need not be loaded when it starts.
add_link_options(-Wl,--as-needed)
if(MILLWRIGHT_PACKAGE)
    # Where the source lies must not show in the bytes; ccache makes its path a relative one.
    add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}/= -ffile-prefix-map=../../=)
endif()
if(MILLWRIGHT_SANITIZE)
    target_compile_options(millwright_options INTERFACE
        -fsanitize=${MILLWRIGHT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(millwright_options INTERFACE -fsanitize=${MILLWRIGHT_SANITIZE})
endif()
if(MILLWRIGHT_SANITIZE MATCHES "address" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # With these, tests of the geometry took 26 s of processor time, without them 4.4 s (release: 1.2 s). AddressSanitizer
    # stops at a null pointer all the same. What is lost: misaligned access, a wrong dynamic type, and a temporary that is
    # used after its end, which the fuzz preset finds (clang's, over the core).
    target_compile_options(millwright_options INTERFACE
        -fno-sanitize=null,alignment,vptr,object-size -fno-sanitize-address-use-after-scope)
endif()
if(MILLWRIGHT_SANITIZE MATCHES "address")
    # Eigen would otherwise pad what it allocates, and libraries that were built without the sanitizer free it: KDL.
    target_compile_definitions(millwright_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
if(MILLWRIGHT_SANITIZE MATCHES "thread")
    # ThreadSanitizer does not know fences; without them Asio relies on its mutexes alone.
    target_compile_definitions(millwright_options INTERFACE BOOST_ASIO_DISABLE_FENCED_BLOCK)
endif()
# This one looks through inlined code, and g++ 12 then finds unset values that cannot be as soon as it inlines
# differently from -O2: sanitized, or at -Og. The release build is where it is an error.
if(CMAKE_BUILD_TYPE STREQUAL "Debug" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(millwright_options INTERFACE -Wno-maybe-uninitialized)
endif()
# clang gives the first warning for defaulted comparisons too, and the second for a local name that another file of the
# same unit has, too; g++ knows better.
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_compile_options(millwright_options INTERFACE -Wno-float-equal -Wno-shadow)
endif()
if(MILLWRIGHT_CHECKED)
    target_compile_definitions(millwright_options INTERFACE _GLIBCXX_ASSERTIONS)
endif()
