# What `cmake --install` brings beside the programs and the library, and the Debian package of all of it (cpack).
set(documents ${CMAKE_INSTALL_DATADIR}/doc/triad)
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${documents})
install(FILES LICENSE DESTINATION ${documents} RENAME copyright) # where Debian looks for it
install(DIRECTORY docs DESTINATION ${documents})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME triad)
set(CPACK_PACKAGE_CONTACT "The authors of Triad")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Without an OpenCL device there is no picture; plots of reports are made by gnuplot.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS gnuplot-nox)
include(CPack)
