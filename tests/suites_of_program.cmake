# Writes an entry of ctest for each suite that a test program lists: one process for its tests. What a process costs before
# its first test (libraries to load, texts and examples to read) was more than most tests of words cost.
#
#   cmake -DPROGRAM=… -DFOLDER=unit/text -DFILE=….cmake -P suites_of_program.cmake
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed ERROR_VARIABLE problem RESULT_VARIABLE ended TIMEOUT 120)
if(NOT ended STREQUAL "0")
    message(FATAL_ERROR "${PROGRAM}: cannot list its tests (${ended}) — ${problem}${listed}")
endif()
string(REGEX REPLACE "[][;]" "_" listed "${listed}")
string(REPLACE "\n" ";" lines "${listed}")
set(entries "")
set(suites 0)
foreach(line IN LISTS lines)
    # "Suite." or "Values/Suite/0.  # TypeParam = …"; tests are indented.
    if(line MATCHES "^([A-Za-z0-9_/]+)\\.( +#.*)?$")
        set(suite ${CMAKE_MATCH_1})
        # gtest lists what was skipped at its end; behind it what failed, and then the entry fails.
        string(APPEND entries
               "add_test([==[${FOLDER}/${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==])\n"
               "set_tests_properties([==[${FOLDER}/${suite}]==] PROPERTIES LABELS [==[${FOLDER}]==] "
               "SKIP_REGULAR_EXPRESSION [==[\\[  SKIPPED \\] [^\n]*\n*$]==])\n")
        math(EXPR suites "${suites} + 1")
    endif()
endforeach()
if(suites EQUAL 0)
    message(FATAL_ERROR "${PROGRAM}: lists no suite — a program of tests has some — look at --gtest_list_tests")
endif()
file(WRITE ${FILE} "${entries}")
