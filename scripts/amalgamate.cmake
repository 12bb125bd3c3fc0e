# Writes the library as a single header: every header of include/nusselt that is reachable from the umbrella, the packs
# and the splitting of outlines, once, below those that it includes. CMake's own language, so that it runs wherever the library installs.
# Usage: cmake -D OUTPUT=FILE -P scripts/amalgamate.cmake
cmake_minimum_required(VERSION 3.25)

include("${CMAKE_CURRENT_LIST_DIR}/one-file.cmake")
set(roots nusselt/nusselt.h nusselt/simd/pack.h nusselt/geometry/split_convex.h)
if(NOT OUTPUT)
    message(FATAL_ERROR "amalgamate: OUTPUT is missing; use cmake -D OUTPUT=FILE -P scripts/amalgamate.cmake")
endif()

# Appends the text of a header to `body` after that of the headers it includes. System headers that no block of
# #if guards go to `system_includes`; the others need their condition and stay where they are.
function(append_header header)
    get_property(done GLOBAL PROPERTY seen_headers)
    if(header IN_LIST done)
        return()
    endif()
    set_property(GLOBAL APPEND PROPERTY seen_headers ${header})
    file(READ "${root}/include/${header}" rest)
    set(text "")
    set(depth 0)
    while(NOT rest STREQUAL "")
        take_line(rest line)
        if(line MATCHES "^#if")
            math(EXPR depth "${depth} + 1")
        elseif(line MATCHES "^#endif")
            math(EXPR depth "${depth} - 1")
        endif()
        if(line MATCHES "^#include <(nusselt/[^>]+)>")
            append_header(${CMAKE_MATCH_1})
        elseif(line MATCHES "^#include <([^>]+)>" AND depth EQUAL 0)
            set_property(GLOBAL APPEND PROPERTY system_headers ${CMAKE_MATCH_1})
        elseif(NOT line STREQUAL "#pragma once")
            string(APPEND text "${line}\n")
        endif()
    endwhile()
    string(STRIP "${text}" text)
    set_property(GLOBAL APPEND_STRING PROPERTY body "\n// ${header}\n${text}\n")
endfunction()

foreach(header IN LISTS roots)
    append_header(${header})
endforeach()

read_version_and_licence()

get_property(system_headers GLOBAL PROPERTY system_headers)
list(SORT system_headers)
list(REMOVE_DUPLICATES system_headers)
list(TRANSFORM system_headers PREPEND "#include <")
list(TRANSFORM system_headers APPEND ">")
list(JOIN system_headers "\n" system_includes)
get_property(body GLOBAL PROPERTY body)

file(WRITE "${OUTPUT}" "// Nusselt ${version}: importance sampling of polygonal and linear lights, in one header.
// Generated from include/nusselt by scripts/amalgamate.cmake. A program includes either this file or the folder.
//
${licence}
#pragma once

${system_includes}
${body}")
