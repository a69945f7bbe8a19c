# lumel_shaders(<target> <file> …): compiles GLSL to SPIR-V at build time and puts each shader into
# a header <path>.inc next to its own path in the include tree, as a comma-separated list of words:
#     constexpr std::uint32_t kSpirv[] = {
#     #include "solve/stochastic.receive.comp.inc"
#     };
find_program(GLSLC glslc REQUIRED)
function(lumel_shaders target)
    foreach(shader ${ARGN})
        set(source ${CMAKE_CURRENT_SOURCE_DIR}/${shader})
        file(RELATIVE_PATH relative ${PROJECT_SOURCE_DIR}/src ${source})
        set(output ${PROJECT_BINARY_DIR}/shaders/${relative}.inc)
        get_filename_component(folder ${output} DIRECTORY)
        file(MAKE_DIRECTORY ${folder})
        add_custom_command(
            OUTPUT ${output}
            COMMAND ${GLSLC} --target-env=vulkan1.3 -O -mfmt=num -I ${PROJECT_SOURCE_DIR}/src
                    -MD -MF ${output}.d -o ${output} ${source}
            DEPENDS ${source}
            DEPFILE ${output}.d
            COMMENT "Compiling ${relative}"
            VERBATIM)
        target_sources(${target} PRIVATE ${output})
    endforeach()
    target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/shaders)
endfunction()
