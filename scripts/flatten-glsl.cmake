# Writes each file of shaders/nusselt with the files that it includes in place of its #include lines, so that one file
# per technique can be copied into an engine. Include guards stay: several of these files go together.
# Usage: cmake -D OUTPUT=FOLDER [-D SHADERS=FOLDER] -P scripts/flatten-glsl.cmake
cmake_minimum_required(VERSION 3.25)

include("${CMAKE_CURRENT_LIST_DIR}/one-file.cmake")
if(NOT SHADERS)
    set(SHADERS "${root}/shaders/nusselt")
endif()
if(NOT OUTPUT)
    message(FATAL_ERROR "flatten-glsl: OUTPUT is missing; use cmake -D OUTPUT=FOLDER -P scripts/flatten-glsl.cmake")
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
    while(NOT rest STREQUAL "")
        take_line(rest line)
        if(line MATCHES "^#include \"([^\"]+)\"$")
            get_filename_component(included "${folder}/${CMAKE_MATCH_1}" ABSOLUTE)
            append_file("${included}")
        else()
            set_property(GLOBAL APPEND_STRING PROPERTY text "${line}\n")
        endif()
    endwhile()
endfunction()

read_version_and_licence()

file(GLOB_RECURSE files RELATIVE "${SHADERS}" "${SHADERS}/*.glsl")
set(names)
foreach(file IN LISTS files)
    get_filename_component(name "${file}" NAME)
    if(name IN_LIST names)
        message(FATAL_ERROR "flatten-glsl: two files are called ${name}; rename one of them")
    endif()
    list(APPEND names "${name}")
    set_property(GLOBAL PROPERTY seen_files "")
    set_property(GLOBAL PROPERTY text "")
    append_file("${SHADERS}/${file}")
    get_property(text GLOBAL PROPERTY text)
    file(WRITE "${OUTPUT}/${name}" "// Nusselt ${version}: ${file} and what it needs, for GLSL 4.50 and GLSL ES 3.00.
// Generated from shaders/nusselt by scripts/flatten-glsl.cmake.
//
${licence}
${text}")
endforeach()
