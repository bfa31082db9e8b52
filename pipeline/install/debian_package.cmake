# cpack -G DEB: mammotwin (programs) and libmammotwin-dev (the stages' libraries). Dependencies of the
# programs are found by dpkg-shlibdeps; those of the libraries are this project's own build list.
set(documents ${CMAKE_CURRENT_BINARY_DIR}/documents)
file(MAKE_DIRECTORY ${documents})
add_custom_command(OUTPUT ${documents}/changelog.gz
  COMMAND ${GZIP} -9nc ${CMAKE_CURRENT_SOURCE_DIR}/changelog > ${documents}/changelog.gz
  DEPENDS changelog VERBATIM)
add_custom_target(changelog ALL DEPENDS ${documents}/changelog.gz)
install(FILES copyright ${documents}/changelog.gz
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/mammotwin COMPONENT runtime)
install(FILES copyright ${documents}/changelog.gz
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libmammotwin-dev COMPONENT development)

file(STRINGS debian_packages.txt build_list REGEX "-dev$")
list(FILTER build_list EXCLUDE REGEX "gtest|benchmark|cairo|mustache|cli11|tomlplusplus")
string(REPLACE ";" ", " build_list "${build_list}")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME mammotwin)
set(CPACK_PACKAGE_VENDOR "Mammotwin developers")
set(CPACK_PACKAGE_CONTACT "Mammotwin developers <mammotwin@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME mammotwin)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS make)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS slurm-client)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
"lesion positions in mammograms from a prone breast MRI
Takes one patient's prone breast MRI to a labelled volume, a tri-cubic
Hermite mesh, the breast compressed between mammography plates, and the
lesions' positions in CC and MLO views, with a page to look at. Runs
cohorts on one machine or under Slurm. For research, not for diagnosis.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmammotwin-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${build_list}")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"libraries of Mammotwin's stages
Static libraries and headers of Mammotwin's stages (segmentation, fitting,
solver, registration), and the files for find_package(Mammotwin).")
include(CPack)
