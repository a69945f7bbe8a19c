# How every target is compiled: warnings, sanitizers, a precompiled header, ccache where it is present.

option(LUMEL_WERROR "Stop at warnings" OFF)
option(LUMEL_JOINT "Compile many sources at a time" ON)
set(LUMEL_SANITIZE "" CACHE STRING "Sanitizers to build with, e.g. address,undefined")

# A user's own launcher stays. Paths are kept relative, so that copies of the tree share results.
find_program(LUMEL_CCACHE ccache)
mark_as_advanced(LUMEL_CCACHE)
foreach(language C CXX)
    if(LUMEL_CCACHE AND NOT CMAKE_${language}_COMPILER_LAUNCHER)
        set(CMAKE_${language}_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
            CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
            CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
            ${LUMEL_CCACHE})
    endif()
endforeach()

# lumel_flags(<target> [HEADERS <target>]): what all of Lumel is compiled with. HEADERS: whose
# precompiled header it uses; none with HEADERS itself.
function(lumel_flags target)
    cmake_parse_arguments(FLAGS "" "HEADERS" "" ${ARGN})
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/src)
    # -fPIC for programs too: one precompiled header serves all. -fpch-preprocess is ccache's wish.
    target_compile_options(${target} PRIVATE -fPIC -Wall -Wextra -Wshadow -Wconversion
        -Wno-sign-conversion -Wno-missing-field-initializers
        $<$<BOOL:${LUMEL_WERROR}>:-Werror>
        $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)
    target_compile_definitions(${target} PUBLIC GLM_FORCE_CTOR_INIT GLM_ENABLE_EXPERIMENTAL)
    if(LUMEL_SANITIZE)
        target_compile_options(${target} PUBLIC -fsanitize=${LUMEL_SANITIZE} -fno-omit-frame-pointer
                                                -fno-sanitize-recover=all)
        target_link_options(${target} PUBLIC -fsanitize=${LUMEL_SANITIZE})
    endif()
    if(LUMEL_FUZZ)
        target_compile_options(${target} PRIVATE
            -fsanitize-coverage-ignorelist=${PROJECT_SOURCE_DIR}/fuzz/uncovered.txt)
    endif()
    if(NOT DEFINED FLAGS_HEADERS)
        set(FLAGS_HEADERS lumel_headers)
    endif()
    if(NOT FLAGS_HEADERS STREQUAL target)
        target_precompile_headers(${target} REUSE_FROM ${FLAGS_HEADERS})
    endif()
endfunction()

# Sources per compilation with LUMEL_JOINT, which cuts the processor time of a first build to a third. With LUMEL_JOINT
# off, an edit recompiles only its own file.
set(LUMEL_SOURCES_AT_A_TIME 20)

# lumel_joint(<target>): compiles its sources jointly. Names in unnamed namespaces must differ between its files.
function(lumel_joint target)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ${LUMEL_JOINT}
                                               UNITY_BUILD_BATCH_SIZE ${LUMEL_SOURCES_AT_A_TIME})
endfunction()

# lumel_headers(<target> <header> …): a target whose precompiled header others use.
function(lumel_headers target)
    set(source ${PROJECT_BINARY_DIR}/${target}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "")
    add_library(${target} OBJECT ${source})
    lumel_flags(${target} HEADERS ${target})
    target_precompile_headers(${target} PRIVATE ${ARGN})
endfunction()

# What most files include and what no edit changes.
set(LUMEL_HEADERS <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits>
                  <map> <memory> <numbers> <numeric> <optional> <random> <set> <span> <string>
                  <string_view> <utility> <variant> <vector> <glm/glm.hpp>
                  <glm/gtc/matrix_transform.hpp>)
lumel_headers(lumel_headers ${LUMEL_HEADERS})
