# Writes the GLSL of each technique as HLSL (shader model 6) and as Metal Shading Language 2.3, one file per technique.
# glslang compiles the entry points of shaders/parity, and spirv-cross translates their SPIR-V. In each file, main() (main0()
# in Metal) computes a sample, its density, the inverse and the measure for lights in a buffer: an example of how to call the
# functions above it.
# Usage: cmake -D LIST=FILE -D OUTPUT=FOLDER -P scripts/convert-shaders.cmake
# LIST is build/release/lab/parity/shaders.txt, which names entry points, their sources and definitions.
cmake_minimum_required(VERSION 3.25)

include("${CMAKE_CURRENT_LIST_DIR}/one-file.cmake")
if(NOT LIST OR NOT OUTPUT)
    message(FATAL_ERROR "convert-shaders: use cmake -D LIST=FILE -D OUTPUT=FOLDER -P scripts/convert-shaders.cmake")
endif()
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_CROSS spirv-cross REQUIRED)
read_version_and_licence()

# Writes what spirv-cross makes of some SPIR-V, with a head.
function(translate spirv file language notes)
    execute_process(COMMAND ${SPIRV_CROSS} ${ARGN} ${spirv} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
    get_filename_component(name ${file} NAME_WE)
    file(WRITE ${file} "// Nusselt ${version}: the technique ${name} and what it needs, in ${language}.
// Generated from shaders/nusselt by scripts/convert-shaders.cmake.
${notes}//
${licence}
${text}")
endfunction()

# An error of a few roundings in mad() would make small and edge-on lights noisy.
set(hlsl_notes "// Leave SPIRV_CROSS_CONSTANT_ID_0 false: mad() of HLSL need not round once.\n")
set(msl_notes "// fma() of Metal rounds once: the function constant 0, kNusseltFusedFma, may be true, which takes fewer instructions.\n")

file(STRINGS ${LIST} rows)
set(done)
foreach(row IN LISTS rows)
    # Techniques of the library, for polygons of up to four vertices where there is a choice.
    if(row MATCHES "^twin_rolled" OR NOT row MATCHES "^twin_([a-z_0-9]+)_([0-9])\t([^\t]+)\t?(.*)$")
        continue()
    endif()
    set(name ${CMAKE_MATCH_1})
    set(bound ${CMAKE_MATCH_2})
    set(source ${CMAKE_MATCH_3})
    string(REPLACE "\t" ";" defines "${CMAKE_MATCH_4}")
    if(name IN_LIST done OR row MATCHES "^twin_polygon" AND NOT bound EQUAL 4)
        continue()
    endif()
    list(APPEND done ${name})
    list(TRANSFORM defines PREPEND -D)
    set(spirv ${OUTPUT}/${name}.spv)
    file(MAKE_DIRECTORY ${OUTPUT}/hlsl ${OUTPUT}/msl)
    execute_process(COMMAND ${GLSLANG_VALIDATOR} --quiet --target-env vulkan1.1 -I${root}/shaders ${defines} -o ${spirv} ${source}
        COMMAND_ERROR_IS_FATAL ANY)
    translate(${spirv} ${OUTPUT}/hlsl/${name}.hlsl "HLSL for shader model 6" ${hlsl_notes} --hlsl --shader-model 60)
    translate(${spirv} ${OUTPUT}/msl/${name}.metal "Metal Shading Language 2.3" ${msl_notes} --msl --msl-version 20300)
    file(REMOVE ${spirv})
endforeach()
if(NOT done)
    message(FATAL_ERROR "convert-shaders: ${LIST} names no techniques")
endif()
