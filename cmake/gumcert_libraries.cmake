# Libraries that bring no package file of their own that CMake reads: targets for the build and for whoever links the
# installed libraries.
find_package(PkgConfig REQUIRED)
foreach(pair qpdf=libqpdf qrencode=libqrencode xmlsec=xmlsec1-openssl zip=libzip)
    string(REPLACE "=" ";" pair ${pair})
    list(GET pair 0 name)
    list(GET pair 1 module)
    if(NOT TARGET gumcert::${name})
        pkg_check_modules(GUMCERT_${name} REQUIRED IMPORTED_TARGET ${module})
        add_library(gumcert::${name} INTERFACE IMPORTED)
        target_link_libraries(gumcert::${name} INTERFACE PkgConfig::GUMCERT_${name})
    endif()
endforeach()
