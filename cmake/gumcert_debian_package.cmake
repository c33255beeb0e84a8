# cpack -G DEB, in the folder of a build: the package gumcert for Debian 12. It is the component program of
# cmake --install, and what Debian asks of a package beside it (component debian).
set(GUMCERT_DEBIAN_MAINTAINER "gumcert contributors <contributors@gumcert.invalid>" CACHE STRING
    "Maintainer of the Debian package: name and address of whoever passes it on")
set(gumcert_debian_release 1)

# Documents are made when the package is: the commit may have changed since CMake was run.
install(CODE "
    if(NOT EXISTS \"${PROJECT_SOURCE_DIR}/node_modules\")
        message(FATAL_ERROR \"${PROJECT_SOURCE_DIR}/node_modules: missing — the package brings the module that sets \"
                            \"PDF — run scripts/setup\")
    endif()
    set(doc_dir \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}\")
    set(GZIP \"${GUMCERT_GZIP}\")
    set(SOURCE_DIR \"${PROJECT_SOURCE_DIR}\")
    set(BUILD_INFO \"${gumcert_build_info_dir}/gumcert_build_info.h\")
    set(VERSION \"${PROJECT_VERSION}-${gumcert_debian_release}\")
    set(MAINTAINER \"${GUMCERT_DEBIAN_MAINTAINER}\")"
    COMPONENT debian EXCLUDE_FROM_ALL)
install(SCRIPT ${CMAKE_CURRENT_LIST_DIR}/debian/documents.cmake COMPONENT debian EXCLUDE_FROM_ALL)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/debian/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT debian EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program debian)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian/open_to_all.cmake)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${gumcert_debian_release})
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${GUMCERT_DEBIAN_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE zstd)
# Libraries: found in the program and in the module. Programs and fonts that they start and read: by name.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "nodejs (>= 18), fonts-noto-cjk")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS fonts-dejavu-core)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
string(JOIN "\n" CPACK_DEBIAN_PACKAGE_DESCRIPTION
       "gumcert turns the readings of a calibration into a certificate whose every"
       "digit can be followed back to the reading it came from. It evaluates"
       "measurement uncertainty as the Guide to the expression of uncertainty in"
       "measurement (GUM) describes, by the law of propagation and by Monte Carlo,"
       "writes everything it found into one record, and prints the certificate from"
       "that record: HTML, PDF/A-3, text and the digital calibration certificate."
       "."
       "It evaluates budgets of any measurement model, calibrations of rotary tables,"
       "circle closures and comparisons of laboratories.")
include(CPack)
