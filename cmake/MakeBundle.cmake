# cmake -DBUILD=<build folder> -DNAME=<name> -DOPENED=<libraries opened at run time> -P MakeBundle.cmake
# Installs the component `bundle` into <build>/<name>, adds the shared libraries it needs and their
# licences, and packs it as <build>/<name>.tar.gz.

set(stage ${BUILD}/${NAME})
file(REMOVE_RECURSE ${stage})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component bundle --prefix ${stage} --strip
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

# Left to the system: the C library family, the Vulkan loader (opened at run time), and the C++
# runtime and zlib. Every distribution has the last two, and a graphics driver loaded into the same
# process must find its own, possibly newer, version of them rather than ours.
file(GLOB programs ${stage}/bin/*)
file(GET_RUNTIME_DEPENDENCIES
    EXECUTABLES ${programs}
    LIBRARIES ${OPENED}
    RESOLVED_DEPENDENCIES_VAR libraries
    UNRESOLVED_DEPENDENCIES_VAR unresolved
    PRE_EXCLUDE_REGEXES
        "^ld-linux" "^lib(c|m|dl|rt|pthread|resolv|util|anl|nsl|mvec|BrokenLocale)\\.so"
        "^libvulkan\\.so" "^lib(stdc\\+\\+|gcc_s|z)\\.so")
list(APPEND libraries ${OPENED})
if(unresolved)
    message(FATAL_ERROR "These libraries are nowhere to be found: ${unresolved}")
endif()

# The package that a Debian file belongs to; with a merged /usr a file has two names.
function(find_package_of library result)
    string(REGEX REPLACE "^/usr" "" short ${library})
    execute_process(COMMAND dpkg-query -S /usr${short} OUTPUT_VARIABLE found ERROR_QUIET)
    if(NOT found)
        execute_process(COMMAND dpkg-query -S ${short} OUTPUT_VARIABLE found ERROR_QUIET)
    endif()
    string(REGEX REPLACE ":.*" "" package "${found}")
    set(${result} "${package}" PARENT_SCOPE)
endfunction()

include(${CMAKE_CURRENT_LIST_DIR}/LumelLicences.cmake)
set(packages ${LUMEL_HEADER_PACKAGES})
foreach(library ${libraries})
    file(COPY ${library} DESTINATION ${stage}/lib FOLLOW_SYMLINK_CHAIN)
    file(REAL_PATH ${library} real)
    find_package_of(${real} package)
    list(APPEND packages "${package}")
endforeach()
list(REMOVE_DUPLICATES packages)
file(MAKE_DIRECTORY ${stage}/licences)
foreach(package ${packages})
    if(EXISTS /usr/share/doc/${package}/copyright)
        file(COPY_FILE /usr/share/doc/${package}/copyright ${stage}/licences/${package}.txt)
    else()
        message(WARNING "No licence text found for ${package}")
    endif()
endforeach()

# Pages for a browser have three.js in them, and what it reads textures with.
set(modules ${CMAKE_CURRENT_LIST_DIR}/../build/npm/node_modules)
foreach(module ${LUMEL_PAGE_MODULES})
    if(EXISTS ${modules}/${module}/LICENSE)
        file(COPY_FILE ${modules}/${module}/LICENSE ${stage}/licences/${module}.txt)
    endif()
endforeach()

file(ARCHIVE_CREATE OUTPUT ${BUILD}/${NAME}.tar.gz PATHS ${NAME} FORMAT gnutar COMPRESSION GZip)
file(SIZE ${BUILD}/${NAME}.tar.gz bytes)
math(EXPR mebibytes "(${bytes} + 524288) / 1048576")
message(STATUS "${BUILD}/${NAME}.tar.gz, ${mebibytes} MiB")
