# Installs the build into a fresh folder, builds a foreign project against it and runs what came out.
#
#   cmake -DBUILD_DIR=... -DWORK_DIR=... -DCOMPILER=... -DFLAGS=... -P install_test.cmake
cmake_minimum_required(VERSION 3.25)

function(run description)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message("${output}")
        message(FATAL_ERROR "${description} failed (${result})")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})

# What is compiled here shows that headers and libraries are whole; how fast it runs is nobody's concern.
set(as_a_stranger -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O0)

run("installation" ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})

run("configuring the consumer" ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${WORK_DIR}/consumer -G Ninja
    -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS=${FLAGS}" ${as_a_stranger})
run("building the consumer" ${CMAKE_COMMAND} --build ${WORK_DIR}/consumer)
run("running the consumer" ${WORK_DIR}/consumer/consumer)
# JCGM 100:2008, table G.2, column 95.45 %
set(expected "1 13.97\n5 2.65\n10 2.28\n50 2.05\ninf 2.00\n")
if(NOT output STREQUAL expected)
    message(FATAL_ERROR "the consumer printed\n${output}instead of\n${expected}")
endif()

# The shipped examples of the C++ libraries: built against the installed package, and run.
run("configuring the examples" ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/../../examples/api -B ${WORK_DIR}/api -G Ninja
    -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS=${FLAGS}" ${as_a_stranger})
run("building the examples" ${CMAKE_COMMAND} --build ${WORK_DIR}/api)
function(expect_printed program)
    run("${program}" ${WORK_DIR}/api/${program})
    foreach(expected IN LISTS ARGN)
        string(FIND "${output}" "${expected}" position)
        if(position EQUAL -1)
            message(FATAL_ERROR "${program} printed\n${output}and not\n${expected}")
        endif()
    endforeach()
endfunction()
# JCGM 100:2008, H.1 (unrounded: 31.7 nm, 16.8 degrees of freedom) and H.1.7
expect_printed(budget_by_hand "l_s       25.0 nm" "d_theta   16.6 nm  27.5 %"
               "l = 50000838 nm, U = 92 nm (k = 2.90, 16.8 degrees of freedom, p = 99 %)"
               "u = 31.7 nm, with terms of second order 33.8 nm")
# JCGM 101:2008, 9.3
expect_printed(monte_carlo "law of propagation  dm = 1.2340 mg, u = 0.0539 mg" "dm = 1.234" "u = 0.075"
               "95 % from 1.08 mg to 1.38 mg" "the law of propagation is not validated")
# ISO/TS 28037:2010, clause 7
expect_printed(calibration_line "a = 0.5788, u = 0.4764" "b = 2.1597, u = 0.1355"
               "chi-square = 2.743 on 4 degrees of freedom" "x = 4.594, u = 0.163")
# JCGM 100:2008, H.3: b(30 °C) = -0.1494 °C with u = 0.0041 °C, and the resolution of the reading
expect_printed(uncertainty_budget "t[30 degC] = 29.8506 degC, U = 0.0096 K (u = 0.0042 K, k = 2.32, student_t)"
               "r(22 degC, 30 degC) = -0.59, r(26 degC, 30 degC) = 0.90"
               "inputs y1, y2: correlated, with 9 degrees of freedom each")
# ISO 13528:2022, E.1 (robust mean 26.81), and E_n = D / √(U² + U_ref²) of three laboratories against a fourth
expect_printed(proficiency_test "solution: assigned value 26.81" "solution L18  z =  3.64" "block    L1   reference"
               "block    L2   E_n =  0.38  no signal" "block    L3   E_n =  1.37  action" "block    L4   E_n = -0.40"
               "r = 0.0: D = 13 nm, U(D) = 34 nm, E_n = 0.38, zeta = 0.76" "r = 0.5: D = 13 nm, U(D) = 26 nm, E_n = 0.50")
# The truth beside it is that of the drawn table; 76 · 0.95 = 72.2 values are expected within U.
expect_printed(rotary_table "before anything is measured: U of EXA at most 0.10 µm" "EXA at  0°: 2.16 µm, U = 0.10, true 2.20" "ECA at 30°: 14.39 ″, U = 0.19, true 14.28"
               "72 of 76 true values lie within U" "length noise: 67.6 % of the variance of EXA")
# JCGM 100:2008, G.4.1 and table G.2; JCGM 101:2008, 9.2.3; k = (1 − √((1 − p)(1 − β²))) / √((1 + β²)/6) for β = 1/2
expect_printed(coverage_factor "nu_eff = 19.0, k = 2.09 for 95 %" "k = 2.65 for 95.45 % and 5 degrees of freedom"
               "95 % within 3.88" "trapezoid: k = 1.77" "lie below 0.9877" "P(Z1^2 + 0.2 Z2^2 >= 5) = 0.028953")
# JCGM 100:2008, table 1, F.2.2.1 and H.5 (F = 2.26 from the figures of table H.9)
expect_printed(observations "mean 100.14, s = 1.49, u = 0.33, 19 degrees of freedom" "half-width 4: u = 2.3" "u = 0.29"
               "F = 2.26, critical value 2.12: an effect between days is taken to exist"
               "mean 97 uV, u = 18 uV with the effect, 13 uV without it")
# JCGM 106:2012 (0.92), ILAC-G8 (4.85 %), NCSLI RP-19 (2.85583037 % and 3.63227145 %)
expect_printed(conformity "probability of conformity 0.92" "DR-01: accepted up to -5.40 V, pass, risk 8.1 %"
               "DR-03: accepted up to -5.50 V, fail, risk 91.9 %" "conditional_pass" "largest risk 4.85 %"
               "falsely accepted 2.85583 % of all, 3.63227 % of those accepted")
# H. Wolf, Ausgleichungsrechnung II (1979), p. 87; closure: u = 0.05" √(n − 1)/n with (n − 1)(n − 2) degrees of freedom
expect_printed(distances "P = 900.0167 899.9833 1300.0062 m, u = 11.8 11.8 6.2 mm"
               "T_1 = 1.000\", u = 0.0186\" with 20 degrees of freedom" "order 1: amplitude 2.000\"" "order 2: amplitude 0.000\"")
# 2.00 √(u² + (1 % of the deviation)²) with the u above
expect_printed(circle_closure "T_0 = 2.000\", U = 0.055\" (k = 2.00)" "T_1 = 1.000\", U = 0.042\" (k = 2.00)"
               "P_5 = -0.500\", U = 0.039\" (k = 2.00)" "range of T = 4.000\"")
# What was simulated comes back.
expect_printed(simulated_campaign "EXC at angle number 2: 4.944 um, simulated 4.944 um"
               "EXC at angle number 3: -0.104 um, simulated -0.104 um" "450 distances and coordinates, 108 parameters")
expect_printed(records "line 2, column 2: the key \"u\" occurs twice" "capability at 0.1 m: 0.0707 um"
               "ISO/IEC 17025:2017, 7.8.2.1 b")

# The installed package must not remember the tree that it was built from.
file(GLOB_RECURSE package_files ${prefix}/lib/cmake/*.cmake ${prefix}/lib/*/cmake/*.cmake)
if(NOT package_files)
    message(FATAL_ERROR "no package file was installed below ${prefix}")
endif()
get_filename_component(source_dir ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
foreach(file IN LISTS package_files)
    file(READ ${file} text)
    string(FIND "${text}" "${source_dir}/" position)
    if(NOT position EQUAL -1)
        message(FATAL_ERROR "${file} names a path of the source tree")
    endif()
endforeach()

foreach(wanted share/gumcert/tools/verify_archive.py bin/gumcert share/gumcert/templates share/gumcert/reference_cases/gum-h1-end-gauge.json share/gumcert/schemas share/gumcert/package-lock.json
               share/gumcert/LICENSE share/gumcert/NOTICE include/gumcert/gum/coverage.h)
    if(NOT EXISTS ${prefix}/${wanted})
        message(FATAL_ERROR "${wanted} was not installed")
    endif()
endforeach()
run("the installed program" ${prefix}/bin/gumcert --version)
if(NOT output MATCHES "0\\.1\\.0")
    message(FATAL_ERROR "gumcert --version printed ${output}")
endif()

# The installed program makes a certificate by itself: its templates and its PDF module came along.
run("the example" ${prefix}/bin/gumcert run ${CMAKE_CURRENT_LIST_DIR}/../../examples/rotary_table/job.json -o ${WORK_DIR}/out)
foreach(wanted record.json certificate.html certificate.pdf)
    if(NOT EXISTS ${WORK_DIR}/out/${wanted})
        message(FATAL_ERROR "the installed program did not write ${wanted}")
    endif()
endforeach()

# It tests itself with the cases that came along, which are those of the release.
run("the self-test" ${prefix}/bin/gumcert self-test -o ${WORK_DIR}/self_test)
if(NOT EXISTS ${WORK_DIR}/self_test/self-test.pdf OR output MATCHES "not those of this release")
    message(FATAL_ERROR "the self-test of the installed program printed\n${output}")
endif()

# And the example reads what it made: of the end gauge Monte Carlo is reported, because the terms of second order matter
# (JCGM 100:2008, H.1.7).
run("the end gauge" ${prefix}/bin/gumcert evaluate ${CMAKE_CURRENT_LIST_DIR}/../../examples/end_gauge/job.json
    -o ${WORK_DIR}/end_gauge.json)
run("records" ${WORK_DIR}/api/records ${WORK_DIR}/end_gauge.json ${WORK_DIR}/out/certificate.pdf)
foreach(wanted "l = 50000838 nm, U = 93 (u = 31.66 nm)" "written again it is the same text: yes" "pdf: 0 signatures")
    string(FIND "${output}" "${wanted}" position)
    if(position EQUAL -1)
        message(FATAL_ERROR "records printed\n${output}and not\n${wanted}")
    endif()
endforeach()
