# A layer is a folder of the tree: its *.h and *.cpp make one static library, included from the root of the tree.
#
# The tables below are the whole law of who may use whom (docs/architecture.md, docs/adr/0001-layers.md). They are read
# by gumcert_layer() for the link lines and by tests/lint/check_includes.py for every #include; there is no second copy.
# A new arrow is one line here and an ADR. Keep each entry in the form set(NAME word word ...): the scanner reads it.

# The layers from the foundation upwards. An edge may only point to a layer further left, so there are no cycles.
set(GUMCERT_LAYER_FOLDERS text encoding system gum/quantity json gum/expression gum gum/monte_carlo gum/conformity
                          gum/comparison certificate certificate/gates laboratory engine engine/rotary_table
                          engine/rotary_table/start engine/rotary_table/evaluation
                          engine/rotary_table/trials engine/rotary_table/studies gum/budget gum/circle_closure
                          gum/rotary_table gum/rotary_table/studies workbook audit audit/worksheets
                          audit/rules audit/words
                          audit/tables jobs jobs/certificate jobs/laboratory jobs/budget
                          jobs/circle_closure jobs/rotary_table jobs/comparison jobs/schema reports/record
                          reports/record/schema reports/record/make reports/record/make/budget
                          reports/record/make/comparison
                          reports/record/make/rotary_table reports/record/make/circle_closure
                          reports/record/make/certificate reports reports/plots reports/view reports/forms
                          reports/audit reports/studies reports/summary reports/dcc reports/agreement audit/sources signing imports archive/store archive
                          outputs evaluation issuing archive/certificates self_test manual app/cli/terminal
                          app/cli/archive app/cli)

# Our own layers whose headers a layer may include and whose library it may link.
set(GUMCERT_EDGES_text)
set(GUMCERT_EDGES_encoding)
set(GUMCERT_EDGES_system)
set(GUMCERT_EDGES_gum_quantity                       text)
set(GUMCERT_EDGES_json                               text gum/quantity)
set(GUMCERT_EDGES_gum_expression                     text gum/quantity)
set(GUMCERT_EDGES_gum                                text gum/quantity)
set(GUMCERT_EDGES_gum_monte_carlo                    text gum/quantity gum)
set(GUMCERT_EDGES_gum_conformity                     text gum/quantity gum)
set(GUMCERT_EDGES_gum_comparison                     text gum/quantity gum gum/monte_carlo)
set(GUMCERT_EDGES_certificate                        text gum/quantity gum/expression gum gum/monte_carlo
                                                     gum/conformity)
set(GUMCERT_EDGES_certificate_gates                  text gum/quantity gum certificate)
set(GUMCERT_EDGES_laboratory                         text gum/quantity gum certificate)
set(GUMCERT_EDGES_engine                             text gum/quantity)
set(GUMCERT_EDGES_engine_rotary_table                text gum/quantity engine)
set(GUMCERT_EDGES_engine_rotary_table_start          text gum/quantity engine engine/rotary_table)
set(GUMCERT_EDGES_engine_rotary_table_evaluation     text gum/quantity engine engine/rotary_table
                                                     engine/rotary_table/start)
set(GUMCERT_EDGES_engine_rotary_table_trials         gum/quantity engine/rotary_table)
set(GUMCERT_EDGES_engine_rotary_table_studies        gum/quantity engine/rotary_table engine/rotary_table/evaluation)
set(GUMCERT_EDGES_gum_budget                         text gum/quantity gum/expression gum gum/monte_carlo engine)
set(GUMCERT_EDGES_gum_circle_closure                 gum/quantity gum gum/monte_carlo engine gum/budget)
set(GUMCERT_EDGES_gum_rotary_table                   text gum/quantity gum gum/monte_carlo engine/rotary_table
                                                     engine/rotary_table/evaluation engine/rotary_table/trials gum/budget)
set(GUMCERT_EDGES_gum_rotary_table_studies           text gum/quantity gum gum/monte_carlo engine/rotary_table
                                                     engine/rotary_table/start engine/rotary_table/evaluation
                                                     engine/rotary_table/studies gum/rotary_table)
set(GUMCERT_EDGES_workbook                           text gum/quantity)
set(GUMCERT_EDGES_audit                              text gum/quantity gum gum/monte_carlo gum/conformity
                                                     gum/comparison certificate workbook)
set(GUMCERT_EDGES_audit_worksheets                   text workbook audit)
set(GUMCERT_EDGES_audit_rules                        text gum/quantity gum/expression gum
                                                     gum/comparison certificate audit audit/worksheets)
set(GUMCERT_EDGES_audit_words                        text gum/quantity gum/conformity certificate audit)
set(GUMCERT_EDGES_audit_tables                       text gum/quantity workbook audit audit/words)
set(GUMCERT_EDGES_jobs                               text encoding gum/quantity json gum gum/monte_carlo)
set(GUMCERT_EDGES_jobs_certificate                   text encoding gum/quantity json gum/conformity certificate jobs)
set(GUMCERT_EDGES_jobs_laboratory                    text gum/quantity certificate laboratory jobs jobs/certificate)
set(GUMCERT_EDGES_jobs_budget                        text gum/quantity gum/expression gum certificate gum/budget jobs
                                                     jobs/certificate jobs/laboratory)
set(GUMCERT_EDGES_jobs_circle_closure                text gum/quantity gum certificate engine gum/circle_closure jobs
                                                     jobs/certificate jobs/laboratory jobs/budget)
set(GUMCERT_EDGES_jobs_rotary_table                  text gum/quantity gum certificate engine/rotary_table
                                                     gum/rotary_table gum/rotary_table/studies jobs jobs/certificate jobs/laboratory
                                                     jobs/budget)
set(GUMCERT_EDGES_jobs_comparison                    text gum/quantity gum gum/comparison certificate jobs
                                                     jobs/certificate jobs/laboratory jobs/budget jobs/circle_closure jobs/rotary_table)
set(GUMCERT_EDGES_jobs_schema                        json jobs jobs/laboratory jobs/budget jobs/circle_closure jobs/rotary_table
                                                     jobs/comparison)
set(GUMCERT_EDGES_reports_record                     text encoding gum/quantity json gum certificate)
set(GUMCERT_EDGES_reports_record_schema              json reports/record)
set(GUMCERT_EDGES_reports_record_make                text encoding gum/quantity json gum gum/monte_carlo certificate
                                                     engine/rotary_table reports/record)
set(GUMCERT_EDGES_reports_record_make_budget         text gum/quantity gum gum/monte_carlo certificate engine
                                                     gum/budget jobs/budget reports/record reports/record/make)
set(GUMCERT_EDGES_reports_record_make_comparison     text gum/quantity gum/expression gum gum/comparison certificate
                                                     gum/budget gum/circle_closure gum/rotary_table jobs/budget
                                                     jobs/circle_closure jobs/rotary_table jobs/comparison
                                                     reports/record reports/record/make reports/record/make/budget)
set(GUMCERT_EDGES_reports_record_make_rotary_table   text gum/quantity gum certificate engine engine/rotary_table
                                                     engine/rotary_table/evaluation engine/rotary_table/trials
                                                     gum/rotary_table jobs/budget
                                                     jobs/rotary_table reports/record reports/record/make
                                                     reports/record/make/budget reports/record/make/comparison)
set(GUMCERT_EDGES_reports_record_make_circle_closure text gum/quantity gum gum/monte_carlo certificate
                                                     gum/circle_closure jobs/circle_closure reports/record
                                                     reports/record/make)
set(GUMCERT_EDGES_reports_record_make_certificate    text encoding gum/quantity gum gum/conformity certificate certificate/gates
                                                     gum/budget reports/record reports/record/make
                                                     reports/record/make/budget reports/record/make/rotary_table
                                                     reports/record/make/circle_closure)
set(GUMCERT_EDGES_reports                            text gum/quantity certificate reports/record)
set(GUMCERT_EDGES_reports_plots                      text gum/quantity certificate reports/record reports)
set(GUMCERT_EDGES_reports_view                       text gum/quantity gum certificate reports/record reports
                                                     reports/plots)
set(GUMCERT_EDGES_reports_forms                      text encoding system gum/quantity json reports/record reports
                                                     reports/view)
set(GUMCERT_EDGES_reports_audit                      text encoding gum/quantity json gum certificate audit reports
                                                     reports/plots reports/view reports/forms)
set(GUMCERT_EDGES_reports_studies                    text gum/quantity json gum engine/rotary_table gum/rotary_table
                                                     gum/rotary_table/studies reports/plots reports/forms)
set(GUMCERT_EDGES_reports_summary                    text gum/quantity reports/record reports reports/view)
set(GUMCERT_EDGES_reports_dcc                        text encoding gum/quantity json gum certificate reports/record
                                                     reports reports/view reports/forms)
set(GUMCERT_EDGES_reports_agreement                  text gum/quantity json certificate reports/record reports
                                                     reports/forms reports/dcc)
set(GUMCERT_EDGES_audit_sources                      text gum/quantity gum gum/conformity certificate workbook
                                                     audit audit/words reports/record reports/dcc)
set(GUMCERT_EDGES_signing                            text encoding system gum/quantity json)
set(GUMCERT_EDGES_imports                            text gum/quantity json gum/expression certificate reports reports/dcc
                                                     signing)
set(GUMCERT_EDGES_archive_store                      encoding gum/quantity)
set(GUMCERT_EDGES_archive                            text encoding gum/quantity json gum/expression archive/store)
set(GUMCERT_EDGES_outputs                            encoding system gum/quantity json)
set(GUMCERT_EDGES_evaluation                         text encoding gum/quantity json gum/monte_carlo certificate
                                                     certificate/gates laboratory engine/rotary_table
                                                     gum/budget gum/circle_closure
                                                     gum/rotary_table gum/rotary_table/studies workbook audit
                                                     audit/rules audit/tables jobs jobs/certificate jobs/laboratory jobs/budget
                                                     jobs/circle_closure jobs/rotary_table jobs/comparison
                                                     reports/record reports/record/make reports/record/make/budget
                                                     reports/record/make/comparison reports/record/make/rotary_table
                                                     reports/record/make/circle_closure
                                                     reports/record/make/certificate reports reports/view reports/forms
                                                     reports/audit reports/studies reports/dcc audit/sources signing
                                                     imports outputs)
set(GUMCERT_EDGES_issuing                            text gum/quantity certificate certificate/gates reports/record
                                                     reports reports/view reports/forms reports/audit reports/dcc
                                                     signing outputs evaluation)
set(GUMCERT_EDGES_archive_certificates               text encoding gum/quantity json gum/expression gum
                                                     gum/monte_carlo certificate certificate/gates jobs reports/record
                                                     reports/record/make/certificate reports reports/forms reports/dcc
                                                     reports/agreement signing imports archive/store archive outputs
                                                     evaluation issuing)
set(GUMCERT_EDGES_self_test                          text encoding gum/quantity json gum jobs reports/record reports
                                                     reports/view reports/forms evaluation)
set(GUMCERT_EDGES_manual                             text)
set(GUMCERT_EDGES_app_cli_terminal                   text encoding system gum/quantity reports/record reports/forms
                                                     archive/store outputs evaluation)
set(GUMCERT_EDGES_app_cli_archive                    text encoding system gum/quantity signing archive/store archive
                                                     outputs evaluation archive/certificates app/cli/terminal)
set(GUMCERT_EDGES_app_cli                            text encoding system gum/quantity certificate audit/rules
                                                     jobs/laboratory reports/record reports reports/forms
                                                     reports/audit reports/summary signing imports archive/store
                                                     archive outputs evaluation issuing self_test manual
                                                     app/cli/terminal app/cli/archive)

# Headers from outside that a layer may include: a first folder (Eigen) or one file (cholmod.h). The standard library is
# free for all; what a layer may not do with it is in tests/lint/check_includes.py. Headers of POSIX count as foreign.
set(GUMCERT_THIRD_PARTY_text)
set(GUMCERT_THIRD_PARTY_encoding                           fcntl.h linux/openat2.h openssl sys/stat.h sys/syscall.h
                                                           unistd.h)
set(GUMCERT_THIRD_PARTY_system                             fcntl.h gnu libxml link.h linux openssl stdlib.h sys/file.h
                                                           sys/prctl.h sys/resource.h sys/stat.h sys/syscall.h sys/types.h
                                                           sys/utsname.h unistd.h)
set(GUMCERT_THIRD_PARTY_gum_quantity                       Eigen)
set(GUMCERT_THIRD_PARTY_json                               nlohmann)
set(GUMCERT_THIRD_PARTY_gum_expression                     Eigen boost)
set(GUMCERT_THIRD_PARTY_gum                                Eigen boost)
set(GUMCERT_THIRD_PARTY_gum_monte_carlo                    Eigen Random123 boost unsupported)
set(GUMCERT_THIRD_PARTY_gum_conformity                     boost)
set(GUMCERT_THIRD_PARTY_gum_comparison                     Eigen boost)
set(GUMCERT_THIRD_PARTY_certificate)
set(GUMCERT_THIRD_PARTY_certificate_gates)
set(GUMCERT_THIRD_PARTY_laboratory)
set(GUMCERT_THIRD_PARTY_engine                             Eigen ceres glog)
set(GUMCERT_THIRD_PARTY_engine_rotary_table                Eigen)
set(GUMCERT_THIRD_PARTY_engine_rotary_table_start          Eigen)
set(GUMCERT_THIRD_PARTY_engine_rotary_table_evaluation     Eigen)
set(GUMCERT_THIRD_PARTY_engine_rotary_table_trials         Eigen)
set(GUMCERT_THIRD_PARTY_engine_rotary_table_studies        Eigen)
set(GUMCERT_THIRD_PARTY_gum_budget                         Eigen)
set(GUMCERT_THIRD_PARTY_gum_circle_closure                 Eigen)
set(GUMCERT_THIRD_PARTY_gum_rotary_table                   Eigen)
set(GUMCERT_THIRD_PARTY_gum_rotary_table_studies           Eigen)
set(GUMCERT_THIRD_PARTY_workbook                           boost libxml zip.h)
set(GUMCERT_THIRD_PARTY_audit)
set(GUMCERT_THIRD_PARTY_audit_worksheets)
set(GUMCERT_THIRD_PARTY_audit_rules                        Eigen)
set(GUMCERT_THIRD_PARTY_audit_words)
set(GUMCERT_THIRD_PARTY_audit_tables)
set(GUMCERT_THIRD_PARTY_jobs                               Eigen nlohmann)
set(GUMCERT_THIRD_PARTY_jobs_certificate                   nlohmann)
set(GUMCERT_THIRD_PARTY_jobs_laboratory                    nlohmann)
set(GUMCERT_THIRD_PARTY_jobs_budget                        nlohmann)
set(GUMCERT_THIRD_PARTY_jobs_circle_closure                nlohmann)
set(GUMCERT_THIRD_PARTY_jobs_rotary_table                  Eigen nlohmann)
set(GUMCERT_THIRD_PARTY_jobs_comparison                    Eigen nlohmann)
set(GUMCERT_THIRD_PARTY_jobs_schema                        nlohmann)
set(GUMCERT_THIRD_PARTY_reports_record                     nlohmann)
set(GUMCERT_THIRD_PARTY_reports_record_schema              nlohmann)
set(GUMCERT_THIRD_PARTY_reports_agreement                  nlohmann)
set(GUMCERT_THIRD_PARTY_audit_sources                      nlohmann)
set(GUMCERT_THIRD_PARTY_reports_record_make                gumcert_build_info.h nlohmann)
set(GUMCERT_THIRD_PARTY_reports_record_make_budget         Eigen nlohmann)
set(GUMCERT_THIRD_PARTY_reports_record_make_comparison     Eigen nlohmann)
set(GUMCERT_THIRD_PARTY_reports_record_make_rotary_table   Eigen nlohmann)
set(GUMCERT_THIRD_PARTY_reports_record_make_circle_closure Eigen nlohmann)
set(GUMCERT_THIRD_PARTY_reports_record_make_certificate)
set(GUMCERT_THIRD_PARTY_reports                            nlohmann)
set(GUMCERT_THIRD_PARTY_reports_plots)
set(GUMCERT_THIRD_PARTY_reports_view                       nlohmann)
set(GUMCERT_THIRD_PARTY_reports_forms                      fcntl.h kainjow nlohmann poll.h qpdf qrencode.h spawn.h
                                                           sys/resource.h sys/wait.h unistd.h)
set(GUMCERT_THIRD_PARTY_reports_audit                      nlohmann)
set(GUMCERT_THIRD_PARTY_reports_studies                    nlohmann)
set(GUMCERT_THIRD_PARTY_reports_summary                    fmt)
set(GUMCERT_THIRD_PARTY_reports_dcc                        libxml nlohmann)
set(GUMCERT_THIRD_PARTY_signing                            fcntl.h libxml nlohmann openssl poll.h qpdf spawn.h
                                                           sys/wait.h unistd.h xmlsec)
set(GUMCERT_THIRD_PARTY_imports                            nlohmann)
set(GUMCERT_THIRD_PARTY_archive_store                      fcntl.h libpq-fe.h sqlite3.h sys/stat.h sys/vfs.h unistd.h)
set(GUMCERT_THIRD_PARTY_archive                            fmt nlohmann)
set(GUMCERT_THIRD_PARTY_outputs                            fcntl.h nlohmann sys/stat.h unistd.h)
set(GUMCERT_THIRD_PARTY_evaluation                         Eigen gumcert_build_info.h nlohmann)
set(GUMCERT_THIRD_PARTY_issuing                            nlohmann)
set(GUMCERT_THIRD_PARTY_archive_certificates               fmt nlohmann)
set(GUMCERT_THIRD_PARTY_self_test                          nlohmann)
set(GUMCERT_THIRD_PARTY_manual                             CLI fmt)
set(GUMCERT_THIRD_PARTY_app_cli_terminal                   fcntl.h fmt gumcert_build_info.h gumcert_templates.h
                                                           nlohmann sys/resource.h unistd.h)
set(GUMCERT_THIRD_PARTY_app_cli_archive                    fmt gumcert_build_info.h nlohmann)
set(GUMCERT_THIRD_PARTY_app_cli                            CLI fmt gumcert_build_info.h gumcert_made_with.h
                                                           gumcert_templates.h nlohmann)

# Layers that may open files; the others are handed what they need and hand back what they made.
set(GUMCERT_MAY_TOUCH_FILES encoding system jobs jobs/budget jobs/circle_closure jobs/rotary_table jobs/comparison reports/forms signing archive/store outputs evaluation archive/certificates self_test app/cli/terminal app/cli/archive app/cli)

# Never in a header of any layer: what they bring must stay behind the layer's own types.
set(GUMCERT_NOT_IN_HEADERS boost ceres libpq-fe.h sqlite3.h)
# A header of ours, and the headers from outside that stand nowhere else: what they bring is compiled once, behind it.
set(GUMCERT_ONLY_IN gum/quantity/dense_factors.h Eigen/Eigenvalues Eigen/QR Eigen/SVD)
# Headers of ours that only their own layer may include. They are not installed, and the line above leaves them alone.
set(GUMCERT_PRIVATE_HEADERS archive/store/postgresql_connection.h archive/store/postgresql_schema.h
                            archive/store/sqlite_schema.h archive/store/sqlite_statement.h
                            audit/tables/beside_number.h audit/tables/claims_of_table.h audit/tables/correlation_lines.h
                            audit/tables/head_lines.h audit/tables/open_sums.h audit/tables/product_of_table.h
                            audit/tables/results_of_table.h audit/tables/row_lines.h
                            audit/tables/table_reader.h audit/tables/table_so_far.h
                            audit/words/bare_text.h audit/words/column_words.h audit/words/dictionary.h
                            audit/words/product_of_coverage.h audit/words/statement_words.h
                            audit/words/uncertainty_in_words.h
                            engine/rotary_table/start/candidate_places.h engine/rotary_table/start/closed_solution.h
                            engine/rotary_table/start/fit_limits.h
                            engine/rotary_table/start/gross_errors.h engine/rotary_table/start/interrupted_beams.h
                            engine/rotary_table/start/no_rigid_table.h engine/rotary_table/start/wrong_labels.h
                            engine/rotary_table/start/label_hypothesis.h engine/rotary_table/start/labels_of_station.h
                            engine/rotary_table/start/labels_of_visits.h
                            engine/rotary_table/start/place_of_reflector.h engine/rotary_table/start/place_search.h
                            engine/rotary_table/start/robust_descent.h engine/rotary_table/start/selected_lengths.h
                            engine/rotary_table/start/shifted_angles.h engine/rotary_table/start/station_distances.h
                            engine/rotary_table/start/two_places.h engine/rotary_table/start/wrong_coordinates.h
                            gum/quantity/unit_expression.h reports/forms/qpdf_objects.h signing/certificates.h signing/checked_signature.h signing/cms.h
                            signing/document_verification.h signing/external_program.h
                            signing/openssl_handles.h signing/qpdf_objects.h signing/signer_chain.h signing/signing_files.h
                            signing/cms_parts.h signing/time_texts.h signing/xml_algorithms.h signing/xml_own_parts.h
                            signing/xml_tree.h workbook/letters.h workbook/operand.h workbook/package_parts.h
                            workbook/sheet_part.h workbook/workbook_parts.h workbook/xml_events.h)

foreach(layer IN LISTS GUMCERT_LAYER_FOLDERS)
    string(REPLACE "/" "_" name ${layer})
    foreach(used IN LISTS GUMCERT_EDGES_${name})
        list(FIND GUMCERT_LAYER_FOLDERS ${layer} position)
        list(FIND GUMCERT_LAYER_FOLDERS ${used} used_position)
        if(used_position EQUAL -1 OR NOT used_position LESS position)
            message(FATAL_ERROR "${layer}: may use ${used} — an edge points to a layer below — correct the table in "
                                "cmake/gumcert_layers.cmake")
        endif()
    endforeach()
endforeach()

set_property(GLOBAL PROPERTY GUMCERT_LAYERS "")

# With GUMCERT_FILES_AS_ONE the files of a target are compiled as one.
#
# files: of one unit; 0: all. words: whether the code handles texts and computes little; it is compiled with less optimisation, in
# two thirds of the time. No digit depends on it: without the flags that gumcert_compiler.cmake refuses, arithmetic is
# the same at every level.
function(gumcert_compile_as_one target files words)
    if(GUMCERT_FILES_AS_ONE)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${files})
        if(words)
            target_compile_options(${target} PRIVATE -O1)
        endif()
        # After the warnings of every target: a source that is included looks to the compiler like a header of the next one.
        target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:gumcert_files_as_one>)
    endif()
endfunction()

# gumcert_layer(folder [WORDS] [MATRICES [FILES_AS_ONE number]]
#               [PUBLIC package...] [PRIVATE package...] [HEADER_ONLY package...])
#
# WORDS: the layer handles texts and computes little.
# MATRICES: the layer is full of expressions of matrices: fewer files make a unit, since the compiler needs more than twice
# the time for twice as many templates in it. FILES_AS_ONE: how many, where other than three serve better.
# Makes the library gumcert::<folder with _ for />, linked with the layers of its entry above. HEADER_ONLY packages are
# needed to compile the layer, but not by whoever links the installed library.
function(gumcert_layer folder)
    cmake_parse_arguments(PARSE_ARGV 1 ARG "WORDS;MATRICES" "FILES_AS_ONE" "PUBLIC;PRIVATE;HEADER_ONLY")
    if(ARG_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "${folder}: ${ARG_UNPARSED_ARGUMENTS} — only WORDS, MATRICES, FILES_AS_ONE, PUBLIC, PRIVATE "
                            "and HEADER_ONLY are known")
    endif()
    if(NOT folder IN_LIST GUMCERT_LAYER_FOLDERS)
        message(FATAL_ERROR "${folder}: not a layer — every layer has its lines in cmake/gumcert_layers.cmake — "
                            "add them there with an ADR")
    endif()
    string(REPLACE "/" "_" name ${folder})

    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
    add_library(${name} STATIC ${sources})
    add_library(gumcert::${name} ALIAS ${name})
    set_target_properties(${name} PROPERTIES OUTPUT_NAME gumcert_${name} EXPORT_NAME ${name} LINKER_LANGUAGE CXX)
    target_compile_features(${name} PUBLIC cxx_std_20)
    target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/gumcert>)
    target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:gumcert_compile_options> ${ARG_PRIVATE} PUBLIC ${ARG_PUBLIC})
    set(files 0)
    if(ARG_FILES_AS_ONE)
        set(files ${ARG_FILES_AS_ONE})
    elseif(ARG_MATRICES)
        set(files 3)
    endif()
    gumcert_compile_as_one(${name} ${files} ${ARG_WORDS})
    foreach(package IN LISTS ARG_HEADER_ONLY)
        target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:${package}>)
    endforeach()
    foreach(used IN LISTS GUMCERT_EDGES_${name})
        string(REPLACE "/" "_" used_name ${used})
        target_link_libraries(${name} PUBLIC ${used_name})
    endforeach()
    set_property(GLOBAL APPEND PROPERTY GUMCERT_LAYERS ${folder})
endfunction()

# The headers of a layer that others may include, relative to the root of the tree.
function(gumcert_public_headers folder result)
    file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/${folder}/*.h)
    if(GUMCERT_PRIVATE_HEADERS)
        list(REMOVE_ITEM headers ${GUMCERT_PRIVATE_HEADERS})
    endif()
    set(${result} ${headers} PARENT_SCOPE)
endfunction()
