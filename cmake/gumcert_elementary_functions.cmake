# Elementary functions whose bits do not depend on the processor (ADR 0058): those of musl, taken as objects out of its
# archive. The C library of the system has several of each, of which it takes one by what the processor can do (FMA). The
# names are the same, exp, sin and so on, so that code of libraries is served, too; all of the objects are linked, before
# anything can ask the C library.
string(REPLACE "-gnu" "-musl" GUMCERT_MUSL_FOLDER "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}")
find_file(GUMCERT_MUSL_ARCHIVE libc.a PATHS ${GUMCERT_MUSL_FOLDER} NO_DEFAULT_PATH DOC "libc.a of musl")
if(NOT GUMCERT_MUSL_ARCHIVE)
    message(FATAL_ERROR "${GUMCERT_MUSL_FOLDER}/libc.a: not found — the build takes elementary functions from it — install "
                        "musl-dev, or run scripts/setup")
endif()
set(functions acos acosh asin asinh atan atan2 atanh cbrt cos cosh erf exp exp10 exp2 expm1 hypot lgamma lgamma_r log log10
              log1p log2 pow sin sincos sinh tan tanh tgamma
              cabs carg cexp clog)
# Of extended precision only what Boost.Math and the fits of curves ask for; these are made of additions and products. Two
# more that it asks for are ours: gum/quantity/extended_functions.cpp.
list(APPEND functions cosl hypotl powl sincosl sinl)
set(parts __cexp __cos __cosl __expo2 __math_divzero __math_invalid __math_oflow __math_uflow __math_xflow __polevll __rem_pio2
          __rem_pio2_large __rem_pio2l __sin __sinl __tan exp_data log2_data log_data pow_data signgam)
list(TRANSFORM functions APPEND .lo OUTPUT_VARIABLE members)
list(TRANSFORM parts APPEND .lo)
list(APPEND members ${parts})
set(folder ${PROJECT_BINARY_DIR}/elementary_functions)
file(MAKE_DIRECTORY ${folder})
list(TRANSFORM members PREPEND ${folder}/ OUTPUT_VARIABLE objects)
add_custom_command(OUTPUT ${objects}
                   COMMAND ${CMAKE_COMMAND} -E chdir ${folder} ${CMAKE_AR} x ${GUMCERT_MUSL_ARCHIVE} ${members}
                   COMMAND ${CMAKE_COMMAND} -E touch ${objects}
                   DEPENDS ${GUMCERT_MUSL_ARCHIVE}
                   COMMENT "Elementary functions"
                   VERBATIM)
set_source_files_properties(${objects} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
add_library(elementary_functions STATIC ${objects})
add_library(gumcert::elementary_functions ALIAS elementary_functions)
set_target_properties(elementary_functions PROPERTIES OUTPUT_NAME gumcert_elementary_functions LINKER_LANGUAGE CXX)
