# cmake --install: the program, the libraries with their headers for find_package(gumcert), and what the program reads
# at run time, under share/gumcert.
include(CMakePackageConfigHelpers)

get_property(layers GLOBAL PROPERTY GUMCERT_LAYERS)
set(gumcert_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gumcert)
set(gumcert_share_dir ${CMAKE_INSTALL_DATADIR}/gumcert)

foreach(layer IN LISTS layers)
    string(REPLACE "/" "_" name ${layer})
    install(TARGETS ${name} EXPORT gumcertTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    gumcert_public_headers(${layer} headers)
    install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gumcert/${layer})
endforeach()
install(EXPORT gumcertTargets NAMESPACE gumcert:: DESTINATION ${gumcert_package_dir})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/gumcert-config.cmake.in
                              ${PROJECT_BINARY_DIR}/gumcert-config.cmake INSTALL_DESTINATION ${gumcert_package_dir}
                              PATH_VARS gumcert_share_dir)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gumcert-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gumcert-config.cmake ${PROJECT_BINARY_DIR}/gumcert-config-version.cmake
              ${CMAKE_CURRENT_LIST_DIR}/gumcert_libraries.cmake
        DESTINATION ${gumcert_package_dir})

install(TARGETS gumcert RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY templates schemas DESTINATION ${gumcert_share_dir})
install(FILES LICENSE NOTICE DESTINATION ${gumcert_share_dir})
# The PDF step runs in Node with a pinned module. Without the module (scripts/setup brings it) everything but PDF works.
install(FILES package.json package-lock.json DESTINATION ${gumcert_share_dir})
install(DIRECTORY node_modules DESTINATION ${gumcert_share_dir} OPTIONAL)

install(DIRECTORY ${GUMCERT_MANUAL_DIR}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
foreach(completion IN ITEMS gumcert:bash-completion/completions _gumcert:zsh/vendor-completions
                            gumcert.fish:fish/vendor_completions.d)
    string(REGEX MATCH "([^:]+):(.+)" _ ${completion})
    install(FILES ${GUMCERT_MANUAL_DIR}/completion/${CMAKE_MATCH_1} DESTINATION ${CMAKE_INSTALL_DATADIR}/${CMAKE_MATCH_2})
endforeach()
