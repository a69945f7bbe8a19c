# Finds packages. On failure, one sentence names the package, the version found and the versions that work.

# lumel_find(<Debian package> <name> [<least version> [<below version>]]): find_package. tools/setup.sh reads these
# lines too, to check the versions that apt offers.
macro(lumel_find package name)
    find_package(${name} QUIET)
    set(lumel_least "${ARGV2}")
    set(lumel_below "${ARGV3}")
    if(NOT ${name}_FOUND)
        lumel_not_found(${package} ${name} "is not installed" "${lumel_least}" "${lumel_below}")
    elseif((lumel_least AND ${name}_VERSION VERSION_LESS lumel_least)
           OR (lumel_below AND ${name}_VERSION VERSION_GREATER_EQUAL lumel_below))
        lumel_not_found(${package} ${name} "is ${${name}_VERSION}" "${lumel_least}" "${lumel_below}")
    endif()
endmacro()

# lumel_find_module(<Debian package> <pkg-config module> <prefix>): gives PkgConfig::<prefix>.
macro(lumel_find_module package module prefix)
    pkg_check_modules(${prefix} QUIET IMPORTED_TARGET ${module})
    if(NOT ${prefix}_FOUND)
        lumel_not_found(${package} ${module} "is not installed" "" "")
    endif()
endmacro()

function(lumel_not_found package name state least below)
    set(wanted "")
    if(least)
        string(APPEND wanted " ${least} or newer")
    endif()
    if(below)
        string(APPEND wanted ", below ${below}")
    endif()
    message(FATAL_ERROR "${name} (Debian package ${package}) ${state}; Lumel needs ${name}${wanted}. "
                        "${${name}_NOT_FOUND_MESSAGE}")
endfunction()

if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12)
    message(FATAL_ERROR "g++ is ${CMAKE_CXX_COMPILER_VERSION}; Lumel needs g++ 12 or newer.")
endif()
