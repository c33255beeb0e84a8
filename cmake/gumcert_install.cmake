# cmake --install: the program with what it reads at run time, under share/gumcert, its manual and examples (component
# program, which is also the Debian package); the libraries with their headers for find_package(gumcert) (component
# development).
include(CMakePackageConfigHelpers)

get_property(layers GLOBAL PROPERTY GUMCERT_LAYERS)
set(gumcert_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gumcert)
set(gumcert_share_dir ${CMAKE_INSTALL_DATADIR}/gumcert)

foreach(layer IN LISTS layers)
    string(REPLACE "/" "_" name ${layer})
    install(TARGETS ${name} EXPORT gumcertTargets
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
    gumcert_public_headers(${layer} headers)
    install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gumcert/${layer} COMPONENT development)
endforeach()
install(TARGETS elementary_functions EXPORT gumcertTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT gumcertTargets NAMESPACE gumcert:: DESTINATION ${gumcert_package_dir} COMPONENT development)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/gumcert-config.cmake.in
                              ${PROJECT_BINARY_DIR}/gumcert-config.cmake INSTALL_DESTINATION ${gumcert_package_dir}
                              PATH_VARS gumcert_share_dir)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gumcert-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gumcert-config.cmake ${PROJECT_BINARY_DIR}/gumcert-config-version.cmake
              ${CMAKE_CURRENT_LIST_DIR}/gumcert_libraries.cmake
        DESTINATION ${gumcert_package_dir} COMPONENT development)

install(TARGETS gumcert RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY templates schemas DESTINATION ${gumcert_share_dir} COMPONENT program)
# The published cases of gumcert self-test.
file(GLOB reference_cases CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/reference/cases/*.json)
install(FILES ${reference_cases} DESTINATION ${gumcert_share_dir}/reference_cases COMPONENT program)
# The second verifier of archives: for whoever has Python and no gumcert.
install(FILES tools/verify_archive.py DESTINATION ${gumcert_share_dir}/tools COMPONENT program)
install(FILES LICENSE NOTICE DESTINATION ${gumcert_share_dir} COMPONENT program)

# The PDF step runs in Node with a pinned module. Without the module (scripts/setup brings it) everything but PDF works.
# The module holds machine code, which lies below lib; a link stands where the program looks for it.
install(FILES package.json package-lock.json DESTINATION ${gumcert_share_dir} COMPONENT program)
set(gumcert_modules_dir ${CMAKE_INSTALL_LIBDIR}/gumcert/node_modules)
file(RELATIVE_PATH gumcert_modules_link /prefix/${gumcert_share_dir} /prefix/${gumcert_modules_dir})
install(CODE "
    set(modules \"${PROJECT_SOURCE_DIR}/node_modules\")
    set(prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
    file(REMOVE_RECURSE \"\${prefix}/${gumcert_share_dir}/node_modules\" \"\${prefix}/${gumcert_modules_dir}\")
    if(EXISTS \"\${modules}\")
        # Hidden files are notes of npm and of scripts/setup about this machine.
        file(INSTALL \"\${modules}/\" DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${gumcert_modules_dir}\" PATTERN \".*\" EXCLUDE)
        file(CREATE_LINK ${gumcert_modules_link} \"\${prefix}/${gumcert_share_dir}/node_modules\" SYMBOLIC)
    endif()"
    COMPONENT program)

# Manual, completion, documents, examples.
install(DIRECTORY ${GUMCERT_MANUAL_DIR}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
foreach(completion IN ITEMS gumcert:bash-completion/completions _gumcert:zsh/vendor-completions
                            gumcert.fish:fish/vendor_completions.d)
    string(REGEX MATCH "([^:]+):(.+)" _ ${completion})
    install(FILES ${GUMCERT_MANUAL_DIR}/completion/${CMAKE_MATCH_1}
            DESTINATION ${CMAKE_INSTALL_DATADIR}/${CMAKE_MATCH_2} COMPONENT program)
endforeach()
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
# What scripts/demo and the commands of the documents write beside the jobs stays here.
install(DIRECTORY docs examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
        PATTERN "*-out" EXCLUDE PATTERN "*-record.json" EXCLUDE)

include(gumcert_debian_package)
