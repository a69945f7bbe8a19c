# GLSL becomes SPIR-V at build time, and a C++ header that says what each shader is given.
#
# lumel_kernels(<target> <file.comp> …): compute shaders. Each gets a header beside its own path in
# the include tree:
#     #include "methods/stochastic/stochastic.receive.comp.h"      lumel::shaders::StochasticReceive
#
# lumel_raster(<target> <name> <file.vert> … <file.frag>): the stages of a raster pass, first to last:
#     #include "raster/eyes/hemicube.raster.h"         lumel::shaders::Hemicube
#
# gpu/shader.h says what the headers hold. Shaders give no binding numbers: the compiler numbers what
# main() reaches in the order of declaration, and the header has the numbers.
find_program(GLSLC glslc REQUIRED)

# Stages of a pass share one set of bindings, so that each begins to number at its own.
set(LUMEL_FIRST_BINDING_comp 0)
set(LUMEL_FIRST_BINDING_vert 0)
set(LUMEL_FIRST_BINDING_tesc 8)
set(LUMEL_FIRST_BINDING_tese 16)
set(LUMEL_FIRST_BINDING_frag 24)

# The path that a shader and what is made of it are known by: below src, else below the project.
function(lumel_shader_path shader result)
    file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR}/${shader})
    if(path MATCHES "^\\.\\./")
        file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/${shader})
    endif()
    set(${result} ${path} PARENT_SCOPE)
endfunction()

# Compiles a shader for the target, once: <path>.inc is what runs, as words of an array;
# <path>.names.spv the same with the names that optimisation drops, and <path>.names.d what it
# includes, are for the header.
function(lumel_spirv target shader)
    lumel_shader_path(${shader} path)
    set(source ${CMAKE_CURRENT_SOURCE_DIR}/${shader})
    set(output ${PROJECT_BINARY_DIR}/shaders/${path})
    get_target_property(known ${target} LUMEL_SHADERS)
    if(NOT known)
        cmake_language(EVAL CODE "cmake_language(DEFER CALL lumel_spirv_source ${target})")
    elseif(path IN_LIST known)
        return()
    endif()
    set_property(TARGET ${target} APPEND PROPERTY LUMEL_SHADERS ${path})
    get_filename_component(folder ${output} DIRECTORY)
    file(MAKE_DIRECTORY ${folder})
    get_filename_component(stage ${path} LAST_EXT)
    string(SUBSTRING ${stage} 1 -1 stage)
    set(first ${LUMEL_FIRST_BINDING_${stage}})
    set(options --target-env=vulkan1.3 -I ${PROJECT_SOURCE_DIR}/src -fauto-bind-uniforms
                -fssbo-binding-base ${first} -fubo-binding-base ${first}
                -ftexture-binding-base ${first} -fsampler-binding-base ${first})
    add_custom_command(
        OUTPUT ${output}.inc ${output}.names.spv
        COMMAND ${GLSLC} ${options} -O "$<$<CONFIG:Debug>:-g>" -mfmt=num -MD -MF ${output}.d
                -o ${output}.inc ${source}
        COMMAND ${GLSLC} ${options} -O0 -MD -MF ${output}.names.d -o ${output}.names.spv ${source}
        DEPENDS ${source}
        DEPFILE ${output}.d
        COMMENT "Compiling ${path}"
        COMMAND_EXPAND_LISTS
        VERBATIM)
    target_sources(${target} PRIVATE ${output}.inc)
endfunction()

# One source with the words of all of a target's shaders, for its headers to name.
function(lumel_spirv_source target)
    get_target_property(paths ${target} LUMEL_SHADERS)
    set(source ${PROJECT_BINARY_DIR}/shaders/${target}.cpp)
    set(text "#include <cstddef>\n#include <cstdint>\n#include <iterator>\n")
    set(words "")
    foreach(path ${paths})
        string(REGEX REPLACE "[^A-Za-z0-9]" "_" symbol lumel_spirv_${path})
        set(file ${PROJECT_BINARY_DIR}/shaders/${path}.inc)
        list(APPEND words ${file})
        string(APPEND text "
extern \"C\" {
extern const std::uint32_t ${symbol}[];
extern const std::size_t ${symbol}_words;
}
const std::uint32_t ${symbol}[] = {
#include \"${file}\"
};
const std::size_t ${symbol}_words = std::size(${symbol});
")
    endforeach()
    file(CONFIGURE OUTPUT ${source} CONTENT "${text}" @ONLY)
    set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${words}"
                                SKIP_PRECOMPILE_HEADERS ON)
    target_sources(${target} PRIVATE ${source})
endfunction()

function(lumel_shader_header target header name)
    set(arguments "")
    set(modules "")
    foreach(shader ${ARGN})
        lumel_shader_path(${shader} path)
        set(output ${PROJECT_BINARY_DIR}/shaders/${path})
        list(APPEND arguments ${path} ${output}.names.spv ${output}.names.d)
        list(APPEND modules ${output}.names.spv)
    endforeach()
    set(output ${PROJECT_BINARY_DIR}/shaders/${header})
    add_custom_command(
        OUTPUT ${output}
        COMMAND lumel_shader_header ${output} ${name} ${PROJECT_SOURCE_DIR}/src ${arguments}
        DEPENDS lumel_shader_header ${modules}
        COMMENT "Writing ${header}"
        VERBATIM)
    target_sources(${target} PRIVATE ${output})
    if(LUMEL_FUZZ)
        # A header alone, without the target and all that it links.
        string(MAKE_C_IDENTIFIER ${header} alone)
        add_custom_target(${alone} DEPENDS ${output})
        set_property(GLOBAL APPEND PROPERTY LUMEL_SHADER_HEADERS ${alone})
    endif()
    target_include_directories(${target} PUBLIC ${PROJECT_BINARY_DIR}/shaders)
endfunction()

function(lumel_kernels target)
    foreach(shader ${ARGN})
        lumel_spirv(${target} ${shader})
        lumel_shader_path(${shader} path)
        get_filename_component(name ${shader} NAME_WLE)
        lumel_shader_header(${target} ${path}.h ${name} ${shader})
    endforeach()
endfunction()

function(lumel_raster target name)
    foreach(shader ${ARGN})
        lumel_spirv(${target} ${shader})
    endforeach()
    lumel_shader_path(${name} path)
    get_filename_component(name ${name} NAME)
    lumel_shader_header(${target} ${path}.raster.h ${name} ${ARGN})
endfunction()
