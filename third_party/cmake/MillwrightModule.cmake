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

# millwright_test(NAME SOURCES ... LINK ...)
#   The test program of one folder. It links that folder's target alone: only so does the linker refuse an
#   upward call. Tests run from the repository's root.
function(millwright_test name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
    add_executable(${name}_test ${ARG_SOURCES})
    target_link_libraries(${name}_test PRIVATE millwright_options ${ARG_LINK} millwright_test_main GTest::gmock)
    set_target_properties(${name}_test PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
    gtest_discover_tests(${name}_test
        WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
        DISCOVERY_TIMEOUT 120
        PROPERTIES TIMEOUT 600)
endfunction()
