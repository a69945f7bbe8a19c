# The relocatable release archive: target `bundle` makes lumel-<version>-linux-x86_64.tar.gz with the
# programs (shaders inside), the libraries that are not part of a base system, their licences, the
# scenes and the README. It needs a Vulkan driver and a C library no older than the build machine's.

set(LUMEL_PROGRAMS lumel)
if(TARGET lumel_bench)
    list(APPEND LUMEL_PROGRAMS lumel_bench lumel_papers)
endif()

# DT_RPATH, not DT_RUNPATH: it also holds for what the bundled libraries themselves need.
set_target_properties(${LUMEL_PROGRAMS} PROPERTIES INSTALL_RPATH "$ORIGIN/../lib")
foreach(program ${LUMEL_PROGRAMS})
    target_link_options(${program} PRIVATE -Wl,--disable-new-dtags)
endforeach()

# What lumel prints of itself: its manual page, and what completes its options in shells. Laid out as
# below share/.
set(LUMEL_SHARE ${PROJECT_BINARY_DIR}/share)
add_custom_command(
    OUTPUT ${LUMEL_SHARE}/man/man1/lumel.1
    COMMAND ${CMAKE_COMMAND} -E make_directory ${LUMEL_SHARE}/man/man1
            ${LUMEL_SHARE}/bash-completion/completions ${LUMEL_SHARE}/zsh/site-functions
    COMMAND lumel completion bash > ${LUMEL_SHARE}/bash-completion/completions/lumel
    COMMAND lumel completion zsh > ${LUMEL_SHARE}/zsh/site-functions/_lumel
    COMMAND lumel man > ${LUMEL_SHARE}/man/man1/lumel.1
    DEPENDS lumel
    COMMENT "Printing the manual page"
    VERBATIM)
add_custom_target(lumel_manual ALL DEPENDS ${LUMEL_SHARE}/man/man1/lumel.1)

# The archive has a layout of its own: a plain `cmake --install` leaves it out.
install(TARGETS ${LUMEL_PROGRAMS} RUNTIME DESTINATION bin COMPONENT bundle EXCLUDE_FROM_ALL)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION . COMPONENT bundle EXCLUDE_FROM_ALL
        PATTERN "*.py" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION .
        COMPONENT bundle EXCLUDE_FROM_ALL)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION . COMPONENT bundle EXCLUDE_FROM_ALL)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/addons/three DESTINATION addons COMPONENT bundle EXCLUDE_FROM_ALL)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/threejs DESTINATION examples COMPONENT bundle EXCLUDE_FROM_ALL
        PATTERN "node_modules" EXCLUDE PATTERN "*.glb" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/bench/papers.md ${PROJECT_SOURCE_DIR}/bench/performance.md
        DESTINATION bench COMPONENT bundle EXCLUDE_FROM_ALL)
install(DIRECTORY ${LUMEL_SHARE} DESTINATION . COMPONENT bundle EXCLUDE_FROM_ALL OPTIONAL)
install(TARGETS lumel RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY ${LUMEL_SHARE}/ DESTINATION ${CMAKE_INSTALL_DATAROOTDIR} COMPONENT program
        OPTIONAL)  # there are none where only lumel was built

string(TOLOWER "${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}" LUMEL_PLATFORM)
set(LUMEL_BUNDLE_NAME lumel-${PROJECT_VERSION}-${LUMEL_PLATFORM})
# Opened while the program runs, see src/solve/matrix/blas.cpp.
find_library(LUMEL_OPENBLAS libopenblas.so.0 HINTS ${OPENBLAS_LIBRARY_DIRS})
add_custom_target(bundle
    COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DNAME=${LUMEL_BUNDLE_NAME} -DOPENED=${LUMEL_OPENBLAS}
            -P ${PROJECT_SOURCE_DIR}/cmake/MakeBundle.cmake
    DEPENDS ${LUMEL_PROGRAMS} lumel_manual
    COMMENT "Making ${LUMEL_BUNDLE_NAME}.tar.gz"
    VERBATIM)

# The Blender add-on, as one zip for all versions.
set(LUMEL_BLENDER_ZIP ${PROJECT_BINARY_DIR}/lumel-blender-${PROJECT_VERSION}.zip)
add_custom_target(blender-addon
    COMMAND ${PROJECT_SOURCE_DIR}/tools/blender_addon ${LUMEL_BLENDER_ZIP}
    COMMENT "Making ${LUMEL_BLENDER_ZIP}"
    VERBATIM)
