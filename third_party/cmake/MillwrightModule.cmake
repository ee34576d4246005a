# How the folders declare what they build. Files are listed, never globbed; the architecture test finds the
# ones that were forgotten.

# millwright_module(NAME HEADERS ... SOURCES ... PUBLIC ... PRIVATE ...)
#   One folder = one target millwright_NAME, alias millwright::NAME. Headers form a file set, so that
#   all_verify_interface_header_sets compiles each of them alone. Headers of the folder that nobody else may
#   include live in internal/ and are not listed.
function(millwright_module name)
    cmake_parse_arguments(ARG "" "" "HEADERS;SOURCES;PUBLIC;PRIVATE" ${ARGN})
    add_library(millwright_${name} STATIC ${ARG_SOURCES})
    add_library(millwright::${name} ALIAS millwright_${name})
    target_sources(millwright_${name}
        PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_HEADERS})
    target_link_libraries(millwright_${name}
        PUBLIC ${ARG_PUBLIC}
        PRIVATE $<BUILD_INTERFACE:millwright_options> ${ARG_PRIVATE})
endfunction()

# millwright_test(NAME SOURCES ... LINK ... [ON_DISPLAY pattern] [ALONE pattern])
#   The test program of one folder. It links that folder's target alone: only so does the linker refuse an
#   upward call. Tests run from the repository's root; those of the core with floating-point traps in the
#   checked build (outside parts of the user interface calculate with infinities). Those that match ON_DISPLAY open
#   windows; a window is told when another one covers it, so they have the display to themselves.
#   Those that match ALONE run while no other test runs.
function(millwright_test name)
    if(NOT MILLWRIGHT_TESTS)
        return()
    endif()
    cmake_parse_arguments(ARG "" "ON_DISPLAY;ALONE" "SOURCES;LINK" ${ARGN})
    set(main millwright_test_main)
    if(MILLWRIGHT_CHECKED AND CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/tests/core/")
        set(main millwright_trapping_test_main)
    endif()
    add_executable(${name}_test ${ARG_SOURCES})
    target_link_libraries(${name}_test PRIVATE millwright_options ${ARG_LINK} ${main})
    target_precompile_headers(${name}_test REUSE_FROM millwright_test_main)
    set_target_properties(${name}_test PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
    set(discovery
        WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
        NO_PRETTY_VALUES # ctest and --gtest_filter call a test the same
        DISCOVERY_TIMEOUT 120)
    set(others "")
    if(ARG_ON_DISPLAY)
        gtest_discover_tests(${name}_test ${discovery}
            TEST_FILTER "${ARG_ON_DISPLAY}"
            TEST_LIST ${name}_test_on_display
            PROPERTIES TIMEOUT 600 RESOURCE_LOCK display)
        string(APPEND others ":${ARG_ON_DISPLAY}")
    endif()
    if(ARG_ALONE)
        gtest_discover_tests(${name}_test ${discovery}
            TEST_FILTER "${ARG_ALONE}"
            TEST_LIST ${name}_test_alone
            PROPERTIES TIMEOUT 600 RUN_SERIAL TRUE)
        string(APPEND others ":${ARG_ALONE}")
    endif()
    string(REGEX REPLACE "^:" "-" others "${others}")
    gtest_discover_tests(${name}_test ${discovery} TEST_FILTER "${others}" PROPERTIES TIMEOUT 600)
endfunction()

# millwright_fuzz(NAME SOURCES ... LINK ... [CORPUS folder])
#   A libFuzzer program build/fuzz/fuzz/NAME_fuzz, only in the fuzz preset. ctest runs it for 20 seconds from the
#   inputs in CORPUS (relative to the repository's root) as NAME_fuzz.
function(millwright_fuzz name)
    if(NOT MILLWRIGHT_FUZZ)
        return()
    endif()
    cmake_parse_arguments(ARG "" "CORPUS" "SOURCES;LINK" ${ARGN})
    add_executable(${name}_fuzz ${ARG_SOURCES})
    target_link_libraries(${name}_fuzz PRIVATE millwright_options ${ARG_LINK})
    target_link_options(${name}_fuzz PRIVATE -fsanitize=fuzzer)
    if(NOT TARGET fuzzers)
        add_custom_target(fuzzers) # all of them and nothing else
    endif()
    add_dependencies(fuzzers ${name}_fuzz)
    set_target_properties(${name}_fuzz PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/fuzz)
    # New inputs go to the first folder; those of the repository are only read. The seed makes a run from the same
    # inputs the same one, so that what the continuous integration finds is found here, too.
    set(found ${PROJECT_BINARY_DIR}/fuzz/${name}_corpus)
    file(MAKE_DIRECTORY ${found})
    add_test(NAME ${name}_fuzz
        COMMAND ${name}_fuzz -seed=1 -max_total_time=20 -timeout=30 -print_final_stats=1
            -artifact_prefix=${PROJECT_BINARY_DIR}/fuzz/${name}_ ${found} ${ARG_CORPUS}
        WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set_tests_properties(${name}_fuzz PROPERTIES LABELS fuzz TIMEOUT 120)
endfunction()

# millwright_bench(NAME SOURCES ... LINK ...)
#   A Google Benchmark program build/PRESET/bench/NAME_bench, run by hand: a time is shown, never asserted.
function(millwright_bench name)
    if(NOT MILLWRIGHT_BENCH)
        return()
    endif()
    cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
    add_executable(${name}_bench ${ARG_SOURCES})
    target_link_libraries(${name}_bench PRIVATE millwright_options ${ARG_LINK} benchmark::benchmark_main)
    set_target_properties(${name}_bench PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bench)
endfunction()
