# Functions that the scripts that write several files into one share.
get_filename_component(root "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)

# Moves the first line of the text in one variable to another one, without its end. Works on strings:
# semicolons and brackets of C++ and GLSL are special in lists.
function(take_line text_variable line_variable)
    string(FIND "${${text_variable}}" "\n" end)
    if(end EQUAL -1)
        set(${line_variable} "${${text_variable}}" PARENT_SCOPE)
        set(${text_variable} "" PARENT_SCOPE)
        return()
    endif()
    string(SUBSTRING "${${text_variable}}" 0 ${end} first)
    math(EXPR next "${end} + 1")
    string(SUBSTRING "${${text_variable}}" ${next} -1 others)
    set(${line_variable} "${first}" PARENT_SCOPE)
    set(${text_variable} "${others}" PARENT_SCOPE)
endfunction()

# Sets `version` to that of the project, and `licence` to the text of the licence as comments.
function(read_version_and_licence)
    file(READ "${root}/CMakeLists.txt" project)
    if(NOT project MATCHES "project\\(nusselt VERSION ([0-9.]+)")
        message(FATAL_ERROR "CMakeLists.txt states no version")
    endif()
    set(version ${CMAKE_MATCH_1} PARENT_SCOPE)
    file(READ "${root}/LICENSE" text)
    string(STRIP "${text}" text)
    string(REPLACE "\n" "\n// " text "// ${text}")
    string(REGEX REPLACE " +\n" "\n" text "${text}\n")
    set(licence "${text}" PARENT_SCOPE)
endfunction()
