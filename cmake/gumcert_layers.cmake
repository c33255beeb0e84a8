# A layer is a folder of the tree: its *.h and *.cpp make one static library, included from the root of the tree.
#
# The tables below are the whole law of who may use whom (docs/architecture.md, docs/adr/0001-layers.md). They are read
# by gumcert_layer() for the link lines and by tests/lint/check_includes.py for every #include; there is no second copy.
# A new arrow is one line here and an ADR. Keep each entry in the form set(NAME word word ...): the scanner reads it.

# The layers from the foundation upwards. An edge may only point to a layer further left, so there are no cycles.
set(GUMCERT_LAYER_FOLDERS text encoding gum/quantity json gum/expression gum gum/comparison certificate engine gum/budget
                          gum/rotary_table gum/circle_closure gum/rotary_table/studies
                          engine/job reports/record reports/record/make reports/record/make/rotary_table
                          reports/record/make/circle_closure reports reports/studies reports/dcc signing app app/cli)

# Our own layers whose headers a layer may include and whose library it may link.
set(GUMCERT_EDGES_text)
set(GUMCERT_EDGES_encoding)
set(GUMCERT_EDGES_gum_quantity   text)
set(GUMCERT_EDGES_json           text gum/quantity)
set(GUMCERT_EDGES_gum_expression text gum/quantity)
set(GUMCERT_EDGES_gum            text gum/quantity)
set(GUMCERT_EDGES_gum_comparison text gum/quantity gum)
set(GUMCERT_EDGES_certificate    text gum/quantity gum/expression gum)
set(GUMCERT_EDGES_engine         text gum/quantity)
set(GUMCERT_EDGES_gum_budget     text gum/quantity gum/expression gum engine)
set(GUMCERT_EDGES_gum_rotary_table text gum/quantity gum engine gum/budget)
set(GUMCERT_EDGES_gum_circle_closure gum/quantity gum engine gum/budget)
set(GUMCERT_EDGES_gum_rotary_table_studies text gum/quantity gum engine gum/rotary_table)
set(GUMCERT_EDGES_engine_job     text encoding gum/quantity json gum/expression gum gum/comparison certificate engine
                                 gum/budget gum/rotary_table gum/circle_closure gum/rotary_table/studies)
set(GUMCERT_EDGES_reports_record text encoding gum/quantity json gum certificate)
set(GUMCERT_EDGES_reports_record_make text encoding gum/quantity json gum certificate reports/record)
set(GUMCERT_EDGES_reports_record_make_rotary_table text gum/quantity gum engine gum/rotary_table engine/job certificate
                                 reports/record reports/record/make)
set(GUMCERT_EDGES_reports_record_make_circle_closure text gum/quantity gum gum/circle_closure engine/job certificate
                                 reports/record reports/record/make)
set(GUMCERT_EDGES_reports        text gum/quantity json gum certificate reports/record)
set(GUMCERT_EDGES_reports_studies text gum/quantity json gum engine gum/rotary_table gum/rotary_table/studies reports)
set(GUMCERT_EDGES_reports_dcc    text encoding gum/quantity json gum certificate reports/record reports)
set(GUMCERT_EDGES_signing        text encoding gum/quantity json)
set(GUMCERT_EDGES_app            text encoding gum/quantity json gum/expression gum gum/comparison certificate engine
                                 gum/budget gum/rotary_table gum/circle_closure gum/rotary_table/studies
                                 engine/job reports/record reports/record/make reports/record/make/rotary_table
                                 reports/record/make/circle_closure reports reports/studies reports/dcc signing)
set(GUMCERT_EDGES_app_cli        text encoding gum/quantity certificate reports/record reports/record/make reports signing app)

# Headers from outside that a layer may include: a first folder (Eigen) or one file (cholmod.h). The standard library is
# free for all; what a layer may not do with it is in tests/lint/check_includes.py. Headers of POSIX count as foreign.
set(GUMCERT_THIRD_PARTY_text)
set(GUMCERT_THIRD_PARTY_encoding       openssl fcntl.h sys/stat.h unistd.h)  # input files are read in one way
set(GUMCERT_THIRD_PARTY_gum_quantity   Eigen)
set(GUMCERT_THIRD_PARTY_json           nlohmann)
set(GUMCERT_THIRD_PARTY_gum_expression Eigen)
set(GUMCERT_THIRD_PARTY_gum            Eigen unsupported boost Random123)
set(GUMCERT_THIRD_PARTY_gum_comparison Eigen boost)
set(GUMCERT_THIRD_PARTY_engine         Eigen ceres glog)
set(GUMCERT_THIRD_PARTY_gum_budget     Eigen)
set(GUMCERT_THIRD_PARTY_gum_rotary_table Eigen)
set(GUMCERT_THIRD_PARTY_gum_circle_closure Eigen)
set(GUMCERT_THIRD_PARTY_gum_rotary_table_studies Eigen)
set(GUMCERT_THIRD_PARTY_engine_job     Eigen nlohmann)
set(GUMCERT_THIRD_PARTY_certificate)
set(GUMCERT_THIRD_PARTY_reports_record nlohmann)
set(GUMCERT_THIRD_PARTY_reports_record_make nlohmann gumcert_build_info.h)
set(GUMCERT_THIRD_PARTY_reports_record_make_rotary_table Eigen nlohmann)
set(GUMCERT_THIRD_PARTY_reports_record_make_circle_closure Eigen nlohmann)
set(GUMCERT_THIRD_PARTY_reports        kainjow nlohmann qpdf
                                       fcntl.h poll.h spawn.h sys/wait.h unistd.h)  # PDF is set by a program of its own
set(GUMCERT_THIRD_PARTY_reports_studies nlohmann)
set(GUMCERT_THIRD_PARTY_reports_dcc    libxml nlohmann)
set(GUMCERT_THIRD_PARTY_signing        libxml nlohmann openssl qpdf xmlsec
                                       fcntl.h poll.h spawn.h sys/wait.h unistd.h)  # a signer may be a program
set(GUMCERT_THIRD_PARTY_app            Eigen gumcert_build_info.h nlohmann fcntl.h sys/stat.h unistd.h)
set(GUMCERT_THIRD_PARTY_app_cli        CLI fmt gumcert_build_info.h nlohmann unistd.h)

# Layers that may open files; the others are handed what they need and hand back what they made.
set(GUMCERT_MAY_TOUCH_FILES encoding engine/job reports signing app app/cli)

# Never in a header of any layer: what they bring must stay behind the layer's own types.
set(GUMCERT_NOT_IN_HEADERS boost ceres sqlite3.h)
# A header of ours, and the headers from outside that stand nowhere else: what they bring is compiled once, behind it.
set(GUMCERT_ONLY_IN gum/quantity/dense_factors.h Eigen/Eigenvalues Eigen/QR Eigen/SVD)
# Headers of ours that only their own layer may include. They are not installed, and the line above leaves them alone.
set(GUMCERT_PRIVATE_HEADERS gum/quantity/unit_expression.h reports/forms/qpdf_objects.h signing/certificates.h signing/checked_signature.h signing/cms.h
                            signing/document_verification.h signing/external_program.h
                            signing/openssl_handles.h signing/qpdf_objects.h signing/signing_files.h signing/time_texts.h
                            signing/xml_tree.h)

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

# Refuse a layer that is not in the table, and a use that is not an edge of it.
function(gumcert_check_edges folder)
    if(NOT folder IN_LIST GUMCERT_LAYER_FOLDERS)
        message(FATAL_ERROR "${folder}: not a layer — every layer has its lines in cmake/gumcert_layers.cmake — "
                            "add them there with an ADR")
    endif()
    string(REPLACE "/" "_" name ${folder})
    foreach(used IN LISTS ARGN)
        if(NOT used IN_LIST GUMCERT_EDGES_${name})
            message(FATAL_ERROR "${folder}: uses ${used} — the edge is not in cmake/gumcert_layers.cmake — "
                                "remove the use, or add the edge with an ADR")
        endif()
    endforeach()
endfunction()

# gumcert_layer(folder [WORDS] [USES layer...] [PUBLIC package...] [PRIVATE package...] [HEADER_ONLY package...])
#
# WORDS: the layer handles texts and computes little; a release compiles it with less optimisation, in two thirds of the
# time. No digit depends on it: without the flags that gumcert_compiler.cmake refuses, arithmetic is the same at every
# level.
# Makes the library gumcert::<folder with _ for />. HEADER_ONLY packages are needed to compile the layer, but not by
# whoever links the installed library.
function(gumcert_layer folder)
    cmake_parse_arguments(PARSE_ARGV 1 ARG "WORDS" "" "USES;PUBLIC;PRIVATE;HEADER_ONLY")
    if(ARG_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "${folder}: ${ARG_UNPARSED_ARGUMENTS} — only WORDS, USES, PUBLIC, PRIVATE and HEADER_ONLY are known")
    endif()
    gumcert_check_edges(${folder} ${ARG_USES})
    string(REPLACE "/" "_" name ${folder})

    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
    add_library(${name} STATIC ${sources})
    add_library(gumcert::${name} ALIAS ${name})
    set_target_properties(${name} PROPERTIES OUTPUT_NAME gumcert_${name} EXPORT_NAME ${name} LINKER_LANGUAGE CXX)
    # In a release some files of a layer are compiled as one: half of the time goes into headers and templates that they
    # share. Other builds compile each file by itself, so that none leans on what its neighbours include.
    if(CMAKE_BUILD_TYPE STREQUAL "Release")
        set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
        if(ARG_WORDS)
            target_compile_options(${name} PRIVATE -O1)
        endif()
    endif()
    target_compile_features(${name} PUBLIC cxx_std_20)
    target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/gumcert>)
    target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:gumcert_compile_options> ${ARG_PRIVATE} PUBLIC ${ARG_PUBLIC})
    # After the warnings of every target: a source that is included looks to the compiler like a header of the next one.
    if(CMAKE_BUILD_TYPE STREQUAL "Release")
        target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:gumcert_files_as_one>)
    endif()
    foreach(package IN LISTS ARG_HEADER_ONLY)
        target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:${package}>)
    endforeach()
    foreach(used IN LISTS ARG_USES)
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
