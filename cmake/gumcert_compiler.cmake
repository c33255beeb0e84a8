# Compiler settings of every target of the project, through one interface target that is never exported.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "Kind of build; the presets set their own" FORCE)
endif()

add_library(gumcert_compile_options INTERFACE)
target_compile_options(gumcert_compile_options INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
    -Woverloaded-virtual -Wformat=2 -Wcast-align
    # Clang takes sums in long double for a slip, too.
    $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion>
    # Not -Wnull-dereference: g++ 12 sees one in the inlined loops of Eigen, optimised, where there is none.
    $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wlogical-op>
    # The same digits from every build: no contraction into fused multiply-add.
    -ffp-contract=off)
# g++ 12 takes what a sanitizer adds for reads of what was never set.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    target_compile_options(gumcert_compile_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    # With a sanitizer Eigen allocates in its own way, and Ceres, which was compiled without, frees what it has not allocated.
    target_compile_definitions(gumcert_compile_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
# The compiler looks less often for memory to use again: a tenth of its time, for up to half as much memory again. The code
# that it makes is the same.
target_compile_options(gumcert_compile_options INTERFACE
    "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-expand=300 --param ggc-min-heapsize=1000000>")
# Of sources that are compiled as one.
add_library(gumcert_files_as_one INTERFACE)
target_compile_options(gumcert_files_as_one INTERFACE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)

option(GUMCERT_WARNINGS_AS_ERRORS "Treat warnings as errors" OFF)
if(GUMCERT_WARNINGS_AS_ERRORS)
    target_compile_options(gumcert_compile_options INTERFACE -Werror)
endif()
# Digits that depend on the machine or on algebra done by the compiler cannot be signed for.
string(TOUPPER "${CMAKE_BUILD_TYPE}" gumcert_build_type)
foreach(flags IN ITEMS "${CMAKE_CXX_FLAGS}" "${CMAKE_CXX_FLAGS_${gumcert_build_type}}")
    if(flags MATCHES "-ffast-math|-Ofast|-funsafe-math-optimizations|-march=native")
        message(FATAL_ERROR "compiler flags: ${CMAKE_MATCH_0} — results must not depend on the machine that built the "
                            "program — remove the flag")
    endif()
endforeach()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()
