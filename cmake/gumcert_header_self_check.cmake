# Every public header compiles alone.
#
# A guarded header whose own source (x.cpp beside x.h) includes it before anything else is compiled alone there. Every
# other one gets a source here that includes it twice and nothing else. The target is part of the ordinary build when the
# tests are, so a header that leans on what its neighbours included stops the build with its own name. Which headers have
# a source of their own is seen when the build is configured.

# Whether a header is guarded and the first #include of the source beside it.
function(gumcert_is_first_in_its_source header answer)
    set(${answer} FALSE PARENT_SCOPE)
    string(REGEX REPLACE "\\.h$" ".cpp" source ${PROJECT_SOURCE_DIR}/${header})
    if(EXISTS ${source})
        file(STRINGS ${source} first REGEX "^#include" LIMIT_COUNT 1)
        file(STRINGS ${PROJECT_SOURCE_DIR}/${header} guard REGEX "^#pragma once" LIMIT_COUNT 1)
        if(guard AND first STREQUAL "#include \"${header}\"")
            set(${answer} TRUE PARENT_SCOPE)
        endif()
    endif()
endfunction()

function(gumcert_header_self_check)
    get_property(layers GLOBAL PROPERTY GUMCERT_LAYERS)
    # CMake wants a source also where every header has one of its own.
    set(none ${CMAKE_CURRENT_BINARY_DIR}/header_self_check/none.cpp)
    file(CONFIGURE OUTPUT ${none} CONTENT "")
    add_library(header_self_check OBJECT ${none})
    set(any FALSE)
    foreach(layer IN LISTS layers)
        string(REPLACE "/" "_" name ${layer})
        target_link_libraries(header_self_check PRIVATE ${name})
        gumcert_public_headers(${layer} headers)
        foreach(header IN LISTS headers)
            set(any TRUE)
            gumcert_is_first_in_its_source(${header} compiled)
            if(compiled)
                continue()
            endif()
            set(unit ${CMAKE_CURRENT_BINARY_DIR}/header_self_check/${header}.cpp)
            file(CONFIGURE OUTPUT ${unit} CONTENT "#include \"${header}\"\n#include \"${header}\"\n")
            target_sources(header_self_check PRIVATE ${unit})
        endforeach()
    endforeach()
    if(NOT any)
        message(FATAL_ERROR "header_self_check: no public header found — a layer has headers — look at GUMCERT_LAYERS")
    endif()
    target_link_libraries(header_self_check PRIVATE $<BUILD_INTERFACE:gumcert_compile_options>)
    target_compile_options(header_self_check PRIVATE -O0 -g0)
endfunction()
