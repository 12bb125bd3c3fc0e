# Writes each file of shaders/nusselt with the files that it includes in place of its #include lines, so that one file
# per technique can be copied into an engine. Include guards stay: several of these files go together.
# Usage: cmake -D OUTPUT=FOLDER [-D SHADERS=FOLDER] -P scripts/flatten-glsl.cmake
cmake_minimum_required(VERSION 3.25)

get_filename_component(root "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)
if(NOT SHADERS)
    set(SHADERS "${root}/shaders/nusselt")
endif()
if(NOT OUTPUT)
    message(FATAL_ERROR "flatten-glsl: name the folder to write: cmake -D OUTPUT=FOLDER -P scripts/flatten-glsl.cmake")
endif()

# Appends the lines of a file to the property `text`, its includes in place, each file once.
function(append_file file)
    get_property(done GLOBAL PROPERTY seen_files)
    if(file IN_LIST done)
        return()
    endif()
    set_property(GLOBAL APPEND PROPERTY seen_files ${file})
    get_filename_component(folder "${file}" DIRECTORY)
    file(READ "${file}" rest)
    # Only strings, no lists: semicolons and brackets of GLSL are special in lists.
    while(NOT rest STREQUAL "")
        string(FIND "${rest}" "\n" end)
        string(SUBSTRING "${rest}" 0 ${end} line)
        math(EXPR next "${end} + 1")
        string(SUBSTRING "${rest}" ${next} -1 rest)
        if(line MATCHES "^#include \"([^\"]+)\"$")
            get_filename_component(included "${folder}/${CMAKE_MATCH_1}" ABSOLUTE)
            append_file("${included}")
        else()
            set_property(GLOBAL APPEND_STRING PROPERTY text "${line}\n")
        endif()
    endwhile()
endfunction()

file(READ "${root}/CMakeLists.txt" project)
if(NOT project MATCHES "project\\(nusselt VERSION ([0-9.]+)")
    message(FATAL_ERROR "flatten-glsl: CMakeLists.txt states no version")
endif()
set(version ${CMAKE_MATCH_1})
file(READ "${root}/LICENSE" licence)
string(STRIP "${licence}" licence)
string(REPLACE "\n" "\n// " licence "// ${licence}")
string(REGEX REPLACE " +\n" "\n" licence "${licence}\n")

file(GLOB_RECURSE files RELATIVE "${SHADERS}" "${SHADERS}/*.glsl")
foreach(file IN LISTS files)
    set_property(GLOBAL PROPERTY seen_files "")
    set_property(GLOBAL PROPERTY text "")
    append_file("${SHADERS}/${file}")
    get_property(text GLOBAL PROPERTY text)
    get_filename_component(name "${file}" NAME)
    file(WRITE "${OUTPUT}/${name}" "// Nusselt ${version}: ${file} and what it needs, for GLSL 4.50 and GLSL ES 3.00.
// Generated from shaders/nusselt by scripts/flatten-glsl.cmake.
//
${licence}
${text}")
endforeach()
