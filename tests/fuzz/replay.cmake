# One program that replays the inputs of all fuzz targets. All of them have a function of the same name: each is included
# under a name of its own, some in one file, so that what they share is compiled once.
include(${CMAKE_CURRENT_LIST_DIR}/targets.cmake)

set(folder ${CMAKE_CURRENT_BINARY_DIR}/fuzz_targets)
set(declarations "")
set(rows "")
set(sources "")
set(layers "")
set(parts 3)
foreach(part RANGE 1 ${parts})
    set(part_${part} "")
endforeach()
set(number 0)
foreach(name IN LISTS GUMCERT_FUZZ_TARGETS)
    math(EXPR part "${number} % ${parts} + 1")
    math(EXPR number "${number} + 1")
    string(APPEND part_${part} "#define LLVMFuzzerTestOneInput fuzz_${name}\n#include \"tests/fuzz/${name}_fuzzer.cpp\"\n"
                               "#undef LLVMFuzzerTestOneInput\n")
    cmake_parse_arguments(target "" "MUTATOR;SEEDS" "" ${GUMCERT_FUZZ_${name}})
    string(APPEND declarations "extern \"C\" int fuzz_${name}(const std::uint8_t*, std::size_t);\n")
    string(APPEND rows "        {\"${name}\", {fuzz_${name}, \"${target_SEEDS}\"}},\n")
    list(APPEND layers ${target_UNPARSED_ARGUMENTS})
endforeach()
list(REMOVE_DUPLICATES layers)
foreach(part RANGE 1 ${parts})
    file(CONFIGURE OUTPUT ${folder}/targets_${part}.cpp CONTENT "${part_${part}}" @ONLY)
    list(APPEND sources ${folder}/targets_${part}.cpp)
endforeach()
file(CONFIGURE OUTPUT ${folder}/replayed_targets.cpp @ONLY CONTENT
"#include \"tests/fuzz/replayed_targets.h\"

${declarations}
std::map<std::string, gumcert::fuzz::ReplayedTarget> gumcert::fuzz::replayed_targets() {
    return {
${rows}    };
}
")

add_executable(fuzz_replay ${CMAKE_CURRENT_LIST_DIR}/replay.cpp ${folder}/replayed_targets.cpp ${sources})
target_include_directories(fuzz_replay PRIVATE ${PROJECT_SOURCE_DIR})
target_compile_definitions(fuzz_replay PRIVATE GUMCERT_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
target_compile_options(fuzz_replay PRIVATE ${gumcert_test_options} -Wno-shadow)
target_link_libraries(fuzz_replay PRIVATE gumcert_compile_options ${layers})
gumcert_optimised_templates_first(fuzz_replay)
add_test(NAME fuzz/replay COMMAND fuzz_replay WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
set_tests_properties(fuzz/replay PROPERTIES LABELS fuzz)
