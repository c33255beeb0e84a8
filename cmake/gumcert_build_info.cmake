# The header <gumcert_build_info.h>: version and commit, which a record names as its maker. The header
# <gumcert_templates.h>: the digests of what this release comes with: templates, see reports/forms/template_digest.h, and
# reference cases, see self_test/self_test.h. The header <gumcert_made_with.h>: the compiler, and the libraries that are
# compiled in.
#
# Written at each build, because the commit changes without CMake being run again; rewritten only when it differs.
# As a script (cmake -P) this file writes the header, included it makes the target gumcert::build_info.
if(CMAKE_SCRIPT_MODE_FILE)
    set(commit unknown)
    set(day_of_commit "")
    find_program(git_program git)
    if(git_program)
        execute_process(COMMAND ${git_program} -C ${SOURCE_DIR} rev-parse --show-prefix --short=12 HEAD
                        RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
        # The prefix, first, is empty when the tree is the top of its repository and not a folder in somebody else's.
        if(result EQUAL 0 AND output MATCHES "^\n?([0-9a-f]+)$")
            set(commit ${CMAKE_MATCH_1})
            execute_process(COMMAND ${CMAKE_COMMAND} -E env TZ=UTC ${git_program} -C ${SOURCE_DIR} show -s
                                    --date=format-local:%Y-%m-%d --format=%cd HEAD
                            OUTPUT_VARIABLE day_of_commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
            execute_process(COMMAND ${git_program} -C ${SOURCE_DIR} status --porcelain --untracked-files=no
                            OUTPUT_VARIABLE changes ERROR_QUIET)
            if(changes)
                string(APPEND commit "-modified")
            endif()
        endif()
    endif()
    file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT [[
#pragma once

#include <string_view>

namespace gumcert {

inline constexpr std::string_view k_version = "@VERSION@";
/// Twelve digits of the commit, "-modified" behind it when files differed; "unknown" outside a repository.
inline constexpr std::string_view k_commit = "@commit@";
/// "2026-11-22" by UTC; "" outside a repository.
inline constexpr std::string_view k_day_of_commit = "@day_of_commit@";

}  // namespace gumcert
]])
    file(GLOB_RECURSE names RELATIVE ${SOURCE_DIR}/templates ${SOURCE_DIR}/templates/pdf/* ${SOURCE_DIR}/templates/wording/*)
    file(GLOB beside RELATIVE ${SOURCE_DIR}/templates ${SOURCE_DIR}/templates/certificate.* ${SOURCE_DIR}/templates/*.png
         ${SOURCE_DIR}/templates/*.jpg ${SOURCE_DIR}/templates/*.jpeg)
    list(APPEND names ${beside})
    list(SORT names)
    set(lines "")
    foreach(name IN LISTS names)
        file(SHA256 ${SOURCE_DIR}/templates/${name} digest)
        string(APPEND lines "${digest}  ${name}\n")
    endforeach()
    string(SHA256 template_digest "${lines}")
    file(GLOB cases RELATIVE ${SOURCE_DIR}/tests/reference/cases ${SOURCE_DIR}/tests/reference/cases/*.json)
    list(SORT cases)
    set(lines "")
    foreach(name IN LISTS cases)
        file(SHA256 ${SOURCE_DIR}/tests/reference/cases/${name} digest)
        string(APPEND lines "${digest}  ${name}\n")
    endforeach()
    string(SHA256 case_digest "${lines}")
    cmake_path(GET HEADER PARENT_PATH folder)
    file(CONFIGURE OUTPUT ${folder}/gumcert_templates.h @ONLY CONTENT [[
#pragma once

#include <string_view>

namespace gumcert {

inline constexpr std::string_view k_template_digest = "@template_digest@";
inline constexpr std::string_view k_reference_case_digest = "@case_digest@";

}  // namespace gumcert
]])
    return()
endif()

set(gumcert_build_info_dir ${PROJECT_BINARY_DIR}/generated)

# Libraries of headers leave no file that could be asked at run time.
set(gumcert_compiled_in "")
foreach(package IN ITEMS Eigen3 Boost nlohmann_json CLI11)
    string(APPEND gumcert_compiled_in "    {\"${package}\", \"${${package}_VERSION}\"},\n")
endforeach()
file(CONFIGURE OUTPUT ${gumcert_build_info_dir}/gumcert_made_with.h @ONLY CONTENT [[
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace gumcert {

inline constexpr std::string_view k_compiler = "@CMAKE_CXX_COMPILER_ID@ @CMAKE_CXX_COMPILER_VERSION@, @CMAKE_SYSTEM_PROCESSOR@, @CMAKE_BUILD_TYPE@";
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 4> k_compiled_in{{
@gumcert_compiled_in@}};

}  // namespace gumcert
]])
add_custom_target(gumcert_build_info_header
    COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
            -DHEADER=${gumcert_build_info_dir}/gumcert_build_info.h -P ${CMAKE_CURRENT_LIST_FILE}
    BYPRODUCTS ${gumcert_build_info_dir}/gumcert_build_info.h ${gumcert_build_info_dir}/gumcert_templates.h
    COMMENT "Version and commit")
add_library(gumcert_build_info INTERFACE)
add_library(gumcert::build_info ALIAS gumcert_build_info)
target_include_directories(gumcert_build_info INTERFACE ${gumcert_build_info_dir})
add_dependencies(gumcert_build_info gumcert_build_info_header)
