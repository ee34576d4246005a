# How the folders declare what they build. Files are listed, never globbed; the architecture test finds the
# ones that were forgotten.

# millwright_precompile(TARGET HEADERS...)
#   Precompiles outside headers for TARGET and for those that REUSE_FROM it: they are read once instead of by every unit.
#   None of ours: each change of it would build everything anew. The compiler writes different bytes each time, so a
#   file beside them says to ccache what they contain.
function(millwright_precompile target)
    target_precompile_headers(${target} PRIVATE ${ARGN})
    get_target_property(folder ${target} BINARY_DIR)
    set(versions "${CMAKE_CXX_COMPILER_VERSION} Eigen ${Eigen3_VERSION} fmt ${fmt_VERSION}")
    if("<gtest/gtest.h>" IN_LIST ARGN)
        string(APPEND versions " GoogleTest ${GTest_VERSION}")
    endif()
    foreach(ending gch pch)
        file(WRITE ${folder}/CMakeFiles/${target}.dir/cmake_pch.hxx.${ending}.sum
            "${versions} ${ARGN}\n")
    endforeach()
endfunction()

file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled.cpp CONTENT "")
add_library(millwright_precompiled OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
target_link_libraries(millwright_precompiled PRIVATE millwright_options fmt::fmt Eigen3::Eigen)
millwright_precompile(millwright_precompiled
    <algorithm> <array> <charconv> <chrono> <cmath> <cstdint> <deque> <filesystem> <functional> <limits> <map> <memory>
    <mutex> <optional> <set> <span> <string> <string_view> <thread> <utility> <variant> <vector>
    <fmt/format.h> <Eigen/Core> <Eigen/Geometry>)
# A precompiled header is refused where a macro differs from what it was made with.
target_compile_definitions(millwright_options INTERFACE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)

# millwright_sources(TARGET FILES...)
#   Adds source files in units of about MILLWRIGHT_UNIT_KB: reading the headers takes longer than compiling one file.
#   So names in the anonymous namespaces of one target are unique. A unit names its files by their path from the
#   repository's root: ccache then recognises it in any checkout.
function(millwright_sources target)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    math(EXPR limit "${MILLWRIGHT_UNIT_KB} * 1024")
    if(limit EQUAL 0)
        target_sources(${target} PRIVATE ${ARGN})
        return()
    endif()
    get_target_property(number ${target} MILLWRIGHT_UNITS)
    if(NOT number)
        set(number 0)
    endif()
    set(unit "")
    set(size 0)
    foreach(source IN LISTS ARGN)
        file(SIZE ${CMAKE_CURRENT_SOURCE_DIR}/${source} bytes)
        math(EXPR with_it "${size} + ${bytes}")
        if(with_it GREATER limit AND unit)
            math(EXPR number "${number} + 1")
            millwright_unit(${target} ${number} "${unit}")
            set(unit "")
            set(size 0)
        endif()
        string(APPEND unit "#include \"${folder}/${source}\"\n")
        math(EXPR size "${size} + ${bytes}")
    endforeach()
    if(unit)
        math(EXPR number "${number} + 1")
        millwright_unit(${target} ${number} "${unit}")
    endif()
    set_target_properties(${target} PROPERTIES MILLWRIGHT_UNITS ${number})
endfunction()

function(millwright_unit target number text)
    set(file ${CMAKE_CURRENT_BINARY_DIR}/${target}_${number}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
    target_sources(${target} PRIVATE ${file})
endfunction()

# millwright_module(NAME HEADERS ... SOURCES ... [APART ...] PUBLIC ... PRIVATE ...)
#   One folder = one target millwright_NAME, alias millwright::NAME. The target `headers` compiles each of HEADERS
#   alone. Headers of the folder that nobody else may include live in internal/ and are not listed.
#   APART: sources with options of their own or with outside headers that define macros; each is compiled alone.
function(millwright_module name)
    cmake_parse_arguments(ARG "" "" "HEADERS;SOURCES;APART;PUBLIC;PRIVATE" ${ARGN})
    add_library(millwright_${name} STATIC)
    millwright_sources(millwright_${name} ${ARG_SOURCES})
    target_sources(millwright_${name} PRIVATE ${ARG_APART})
    target_precompile_headers(millwright_${name} REUSE_FROM millwright_precompiled)
    add_library(millwright::${name} ALIAS millwright_${name})
    target_sources(millwright_${name}
        PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_HEADERS})
    target_link_libraries(millwright_${name}
        PUBLIC ${ARG_PUBLIC}
        PRIVATE $<BUILD_INTERFACE:millwright_options> ${ARG_PRIVATE})
    millwright_headers_alone(${name} ${ARG_HEADERS})
    millwright_links_alone(${name})
endfunction()

# A program of all that a module of the core has and of the modules that it names: a call of a later one does not link.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/nothing.cpp CONTENT "int main() {}\n")
function(millwright_links_alone name)
    if(NOT MILLWRIGHT_TESTS OR MILLWRIGHT_SANITIZE OR NOT CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/core/")
        return()
    endif()
    add_executable(millwright_${name}_alone ${PROJECT_BINARY_DIR}/nothing.cpp)
    target_link_libraries(millwright_${name}_alone PRIVATE "$<LINK_LIBRARY:WHOLE_ARCHIVE,millwright_${name}>")
endfunction()

# The precompiled header hides which standard headers are missing: the architecture test looks for those.
add_custom_target(headers)
function(millwright_headers_alone name)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    set(sources "")
    foreach(header IN LISTS ARGN)
        string(MAKE_C_IDENTIFIER ${header} file)
        set(file ${CMAKE_CURRENT_BINARY_DIR}/headers/${file}.cpp)
        file(CONFIGURE OUTPUT ${file} CONTENT "#include \"${folder}/${header}\"\n" @ONLY)
        list(APPEND sources ${file})
    endforeach()
    add_library(millwright_${name}_headers OBJECT EXCLUDE_FROM_ALL ${sources})
    target_link_libraries(millwright_${name}_headers PRIVATE millwright_options millwright_${name})
    target_precompile_headers(millwright_${name}_headers REUSE_FROM millwright_precompiled)
    add_dependencies(headers millwright_${name}_headers)
endfunction()

# millwright_test(NAME SOURCES ... [APART ...] LINK ... [ON_DISPLAY pattern] [REAL_TIME pattern] [LONG pattern])
#   The test program of one folder. It links that folder's target, and what it is tried with (tests/architecture knows
#   which). Tests run from the repository's root; those of the core with floating-point traps in the
#   checked build (outside parts of the user interface calculate with infinities). Those that match ON_DISPLAY open
#   windows; a window is told when another one covers it, so they have the display to themselves.
#   Those that match REAL_TIME drive a controller or an arm that does not wait for a starved computer: each counts
#   as two, so that fewer others run beside it.
#   Those that match LONG are the full size of a test that also exists in small; they have the label `long`, which
#   scripts/test leaves out and .ci/run runs last.
function(millwright_test name)
    if(NOT MILLWRIGHT_TESTS)
        return()
    endif()
    cmake_parse_arguments(ARG "" "ON_DISPLAY;REAL_TIME;LONG" "SOURCES;APART;LINK" ${ARGN})
    set(main millwright_test_main)
    if(MILLWRIGHT_CHECKED AND CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/tests/core/")
        set(main millwright_trapping_test_main)
    endif()
    add_executable(${name}_test)
    millwright_sources(${name}_test ${ARG_SOURCES})
    target_sources(${name}_test PRIVATE ${ARG_APART})
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
            PROPERTIES TIMEOUT 600 LABELS ${name} RESOURCE_LOCK display)
        string(APPEND others ":${ARG_ON_DISPLAY}")
    endif()
    if(ARG_REAL_TIME)
        gtest_discover_tests(${name}_test ${discovery}
            TEST_FILTER "${ARG_REAL_TIME}"
            TEST_LIST ${name}_test_real_time
            PROPERTIES TIMEOUT 600 LABELS ${name} PROCESSORS 2)
        string(APPEND others ":${ARG_REAL_TIME}")
    endif()
    if(ARG_LONG)
        gtest_discover_tests(${name}_test ${discovery}
            TEST_FILTER "${ARG_LONG}"
            TEST_LIST ${name}_test_long
            PROPERTIES TIMEOUT 1800 LABELS long)
        string(APPEND others ":${ARG_LONG}")
    endif()
    string(REGEX REPLACE "^:" "-" others "${others}")
    gtest_discover_tests(${name}_test ${discovery}
        TEST_FILTER "${others}"
        PROPERTIES TIMEOUT 600 LABELS ${name})
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
