# The Debian package: target `deb` makes lumel_<version>_<architecture>.deb with the program (shaders inside), liblumel
# with its headers and its CMake and pkg-config files, the manual page, completions and docs; and lumel-mpi, with the
# module for MPI alone. They need the libraries of the release that they were built on.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lumel)
set(CPACK_PACKAGE_VENDOR Lumel)
set(CPACK_PACKAGE_CONTACT "The authors of Lumel")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "light baker: radiosity lightmaps of glTF scenes")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Bakes global illumination: reads a glTF scene and writes a lightmap in
lux and a lit glTF, by rays on the CPU or on a Vulkan GPU.
The package has the program, and the library for C++ and C with its headers.")
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})

# One package of these components; `bundle` is in none.
set(CPACK_COMPONENTS_ALL program library documentation)
foreach(component PROGRAM LIBRARY DOCUMENTATION)
    set(CPACK_COMPONENT_${component}_GROUP main)
endforeach()
set(CPACK_DEBIAN_MAIN_PACKAGE_NAME lumel)
if(LUMEL_MPI)
    list(APPEND CPACK_COMPONENTS_ALL mpi)
    set(CPACK_COMPONENT_MPI_GROUP mpi)
    set(CPACK_DEBIAN_MPI_PACKAGE_NAME lumel-mpi)
    set(CPACK_DEBIAN_MPI_DESCRIPTION "light baker: one bake by several machines
The module by which lumel runs as several processes that MPI starts.")
    set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "lumel (= ${PROJECT_VERSION})")
    set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS openmpi-bin)
endif()
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(document_folder ${CMAKE_INSTALL_DATAROOTDIR}/doc/lumel)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE RENAME copyright DESTINATION ${document_folder}
        COMPONENT documentation EXCLUDE_FROM_ALL)
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${document_folder}
        COMPONENT documentation EXCLUDE_FROM_ALL)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${document_folder}
        COMPONENT documentation EXCLUDE_FROM_ALL)
include(LumelLicences)
foreach(package ${LUMEL_HEADER_PACKAGES})
    install(FILES /usr/share/doc/${package}/copyright RENAME ${package}.txt
            DESTINATION ${document_folder}/licences COMPONENT documentation EXCLUDE_FROM_ALL OPTIONAL)
endforeach()
foreach(module ${LUMEL_PAGE_MODULES})
    install(FILES ${PROJECT_SOURCE_DIR}/build/npm/node_modules/${module}/LICENSE RENAME ${module}.txt
            DESTINATION ${document_folder}/licences COMPONENT documentation EXCLUDE_FROM_ALL OPTIONAL)
endforeach()

# Libraries that are linked, by dpkg-shlibdeps; then those that are opened at run time.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS libvulkan1)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd, libopenblas0-pthread | libopenblas0")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS ffmpeg)
include(CPack)

add_custom_target(deb
    COMMAND ${CMAKE_CPACK_COMMAND} --config ${PROJECT_BINARY_DIR}/CPackConfig.cmake
    DEPENDS lumel lumel_library lumel_manual $<TARGET_NAME_IF_EXISTS:lumel_mpi>
    WORKING_DIRECTORY ${PROJECT_BINARY_DIR}
    COMMENT "Making the Debian package"
    VERBATIM)
