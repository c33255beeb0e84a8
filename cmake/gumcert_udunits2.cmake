# UDUNITS-2, the second opinion of the tests on the sizes of units; it brings no package file of its own.
if(NOT TARGET gumcert::udunits2)
    find_path(GUMCERT_UDUNITS2_INCLUDE_DIR NAMES udunits2.h PATH_SUFFIXES udunits2 DOC "Folder of udunits2.h")
    find_library(GUMCERT_UDUNITS2_LIBRARY NAMES udunits2 DOC "UDUNITS-2")
    if(NOT GUMCERT_UDUNITS2_INCLUDE_DIR OR NOT GUMCERT_UDUNITS2_LIBRARY)
        message(FATAL_ERROR "UDUNITS-2: not found — the tests compare units with it — install libudunits2-dev, or run scripts/setup")
    endif()
    add_library(gumcert::udunits2 UNKNOWN IMPORTED)
    set_target_properties(gumcert::udunits2 PROPERTIES IMPORTED_LOCATION ${GUMCERT_UDUNITS2_LIBRARY}
                                                       INTERFACE_INCLUDE_DIRECTORIES ${GUMCERT_UDUNITS2_INCLUDE_DIR})
endif()
