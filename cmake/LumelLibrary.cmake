# liblumel: the rooms behind include/lumel as one shared library, and what installs it.
#     cmake --install build/release --component library --prefix PREFIX
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

add_library(lumel_library SHARED $<TARGET_OBJECTS:lumel_api>)
add_library(lumel::lumel ALIAS lumel_library)
get_target_property(uses lumel_api LINK_LIBRARIES)
target_link_libraries(lumel_library PRIVATE ${uses})
target_include_directories(lumel_library INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                                   $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(lumel_library INTERFACE cxx_std_20)
# Before version 1.0 any minor version may change the binary interface.
set_target_properties(lumel_library PROPERTIES
    OUTPUT_NAME lumel EXPORT_NAME lumel LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib
    LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/lumel.map)
# Only the interface is seen from outside: no room, and no library that is linked in.
target_link_options(lumel_library PRIVATE LINKER:--version-script=${PROJECT_SOURCE_DIR}/cmake/lumel.map)
if(LUMEL_SANITIZE)
    # The sanitizer's library is the program's.
    target_link_options(lumel_library INTERFACE -fsanitize=${LUMEL_SANITIZE})
else()
    target_link_options(lumel_library PRIVATE LINKER:--no-undefined)
endif()

# ./run builds the program alone; what is up to date is not built again.
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" --build \"${PROJECT_BINARY_DIR}\" --target lumel_library
                              OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)"
    COMPONENT library)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lumel)
install(TARGETS lumel_library EXPORT lumelTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
        NAMELINK_COMPONENT library)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/lumel DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        COMPONENT library)
install(EXPORT lumelTargets NAMESPACE lumel:: DESTINATION ${package_folder} COMPONENT library)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lumelConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/lumelConfig.cmake
              ${PROJECT_BINARY_DIR}/lumelConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT library)
# The prefix is found from where the file is, so that the whole may be moved.
file(RELATIVE_PATH LUMEL_PREFIX_FROM_PC /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(${PROJECT_SOURCE_DIR}/cmake/lumel.pc.in ${PROJECT_BINARY_DIR}/lumel.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lumel.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT library)
