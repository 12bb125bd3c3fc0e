# Finds the dependencies of the GPU side and compiles shaders to SPIR-V that is embedded into programs.

# NUSSELT_BUILD_GPU is true if the GPU side can be built. Everything else does not need it.
find_path(Vulkan_INCLUDE_DIR vulkan/vulkan_raii.hpp)
find_program(GLSLANG_VALIDATOR glslangValidator)
set(missing_gpu_packages)
if(NOT Vulkan_INCLUDE_DIR)
    list(APPEND missing_gpu_packages libvulkan-dev)
endif()
if(NOT GLSLANG_VALIDATOR)
    list(APPEND missing_gpu_packages glslang-tools)
endif()
if(missing_gpu_packages)
    set(NUSSELT_BUILD_GPU OFF)
    list(JOIN missing_gpu_packages " " missing_gpu_packages)
    message(WARNING "The GPU side and its tests are not built because these Debian packages are missing: ${missing_gpu_packages}")
else()
    set(NUSSELT_BUILD_GPU ON)
endif()

# nusselt_add_shader(target name source [ENVIRONMENT environment] [DEFINES define...]): compiles a source for vulkan1.1 or
# another environment of glslang and makes `#include "shaders/<name>.h"` available to the sources of the target. The header
# has the array k<Name>, with name in PascalCase: the words of the SPIR-V. They are not compressed: xz finds what variants of
# a shader share, which makes archives smaller. A relative source is one of the current source directory; shaders include
# others relative to shaders/. The property NUSSELT_SHADERS of the target lists its shaders: lines with the name, the source and
# the definitions, with tabs between them.
function(nusselt_add_shader target name source)
    cmake_parse_arguments(arg "" "ENVIRONMENT" "DEFINES" ${ARGN})
    if(NOT arg_ENVIRONMENT)
        set(arg_ENVIRONMENT vulkan1.1)
    endif()
    cmake_path(ABSOLUTE_PATH source)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/shaders)
    nusselt_shader_array(array ${name})
    set(spirv ${folder}/${name}.spv)
    set(header ${folder}/${name}.h)
    set(symbol ${target}_shader_${name})
    list(JOIN arg_DEFINES "\t" defines)
    set_property(TARGET ${target} APPEND_STRING PROPERTY NUSSELT_SHADERS "${name}\t${source}\t${defines}\n")
    list(TRANSFORM arg_DEFINES PREPEND -D)
    file(MAKE_DIRECTORY ${folder})
    # ninja expects that the depfile names the first output; otherwise it compiles the shader in each build.
    add_custom_command(OUTPUT ${spirv} ${header}
        COMMAND ${GLSLANG_VALIDATOR} --quiet --target-env ${arg_ENVIRONMENT} -g0 -I${PROJECT_SOURCE_DIR}/shaders ${arg_DEFINES}
            --depfile ${spirv}.d -o ${spirv} ${source}
        COMMAND ${CMAKE_COMMAND} -D INPUT=${spirv} -D OUTPUT=${header} -D ARRAY=${array} -D SYMBOL=${symbol}
            -P ${PROJECT_SOURCE_DIR}/cmake/embedded_shader.cmake
        DEPENDS ${source} ${PROJECT_SOURCE_DIR}/cmake/embedded_shader.cmake
        DEPFILE ${spirv}.d
        COMMENT "Compiling shader ${name}"
        VERBATIM)
    nusselt_embed(${target} ${symbol} ${spirv})
    target_sources(${target} PRIVATE ${header})
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()

# nusselt_embed(target symbol file): the linker finds the bytes of the file at the symbol. Reading them as C++ would take
# longer than compiling the shaders.
function(nusselt_embed target symbol file)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/shaders/${target}.cpp)
    get_target_property(embedded ${target} NUSSELT_EMBEDDED)
    if(NOT embedded)
        file(GENERATE OUTPUT ${source} CONTENT "$<JOIN:$<TARGET_PROPERTY:${target},NUSSELT_EMBEDDED>,;\n>;\n")
        target_sources(${target} PRIVATE ${source})
    endif()
    set_property(TARGET ${target} APPEND PROPERTY NUSSELT_EMBEDDED
        "asm(\".section .rodata\\n.balign 4\\n.globl ${symbol}\\n.hidden ${symbol}\\n${symbol}:\\n.incbin \\\"${file}\\\"\\n.previous\")")
    set_property(SOURCE ${source} APPEND PROPERTY OBJECT_DEPENDS ${file})
endfunction()

# nusselt_shader_array(variable name): the name of the array that nusselt_add_shader() makes of a shader.
function(nusselt_shader_array variable name)
    nusselt_pascal_case(array ${name})
    set(${variable} k${array} PARENT_SCOPE)
endfunction()

# nusselt_add_technique_shader(target name entry file struct [FUNCTIONS prefix] [PREPARE function] [QUERIES prefix]
# [DEFINES define...]): likewise, for an entry point that runs any technique. shaders/<entry>.glsl calls the technique by the
# names Technique, technique_prepare and so on; shaders/<file>.glsl has functions on a struct that begin with FUNCTIONS, or
# else with the name of the file. PREPARE names that of a variant that shares the rest, QUERIES how the names of pdf, invert
# and measure begin in a variant that shares these.
function(nusselt_add_technique_shader target name entry file struct)
    cmake_parse_arguments(arg "" "FUNCTIONS;PREPARE;QUERIES" "DEFINES" ${ARGN})
    set(prefix ${arg_FUNCTIONS})
    if(NOT prefix)
        cmake_path(GET file STEM prefix)
    endif()
    if(NOT arg_PREPARE)
        set(arg_PREPARE ${prefix}_prepare)
    endif()
    if(NOT arg_QUERIES)
        set(arg_QUERIES ${prefix})
    endif()
    set(source ${CMAKE_CURRENT_BINARY_DIR}/shaders/${name}.comp)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/technique_shader.comp.in ${source} @ONLY)
    nusselt_add_shader(${target} ${name} ${source} DEFINES ${arg_DEFINES})
endfunction()

# nusselt_use_vulkan_headers(target): compiles the target with the precompiled vulkan_raii.hpp of nusselt_gpu, which takes
# longer to read than most units take otherwise. Both have to have the same flags.
function(nusselt_use_vulkan_headers target)
    target_precompile_headers(${target} REUSE_FROM nusselt_gpu)
endfunction()
