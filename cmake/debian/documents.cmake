# Run when the package is made: changelog.gz, which says what changed in gumcert, changelog.Debian.gz, which says what
# the package was built from, and the notices of libraries that became part of the program: of headers, of Ceres and of musl.
file(MAKE_DIRECTORY ${doc_dir})
configure_file(${SOURCE_DIR}/CHANGELOG.md ${doc_dir}/changelog COPYONLY)

file(READ ${BUILD_INFO} build_info)
string(REGEX MATCH "k_commit = \"([^\"]*)\"" _ "${build_info}")
set(commit ${CMAKE_MATCH_1})
string(REGEX MATCH "k_day_of_commit = \"([^\"]*)\"" _ "${build_info}")
set(day ${CMAKE_MATCH_1})
if(NOT day)  # outside a repository
    string(TIMESTAMP day "%Y-%m-%d" UTC)
endif()
execute_process(COMMAND date --utc --rfc-email --date=${day} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${doc_dir}/changelog.Debian "gumcert (${VERSION}) bookworm; urgency=medium

  * Built from commit ${commit}. What changed in gumcert: changelog.gz.

 -- ${MAINTAINER}  ${date}
")
file(CHMOD ${doc_dir}/changelog ${doc_dir}/changelog.Debian FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
execute_process(COMMAND ${GZIP} -9 --no-name --force ${doc_dir}/changelog ${doc_dir}/changelog.Debian
                COMMAND_ERROR_IS_FATAL ANY)

foreach(library IN ITEMS libceres-dev libcli11-dev libeigen3-dev libkainjow-mustache-dev librandom123-dev libvalijson-dev
                         musl-dev nlohmann-json3-dev)
    configure_file(/usr/share/doc/${library}/copyright ${doc_dir}/licences/${library} COPYONLY)
endforeach()
# libboost-dev is but a name for the package of one version, which has the headers and their notice.
file(GLOB boost /usr/share/doc/libboost1.*-dev/copyright)
list(GET boost 0 boost)
configure_file(${boost} ${doc_dir}/licences/libboost-dev COPYONLY)
