# Compiles the timing program for scalar code with the compilers that lab/timing/scalar_programs.cpp names, as a user
# would: without any option of ours but the folders of headers. A compiler that is missing leaves its program out.
find_program(NUSSELT_TIMED_GXX g++)
find_program(NUSSELT_TIMED_CLANG clang++-19)
set(folder ${PROJECT_BINARY_DIR}/apps/nusselt-lab/scalar-timing)
set(source ${CMAKE_CURRENT_SOURCE_DIR}/timing/scalar/scalar_timing.cpp)
set(programs)
function(add_scalar_program name compiler)
    if(NOT compiler)
        message(VERBOSE "The timing program ${name} is not built because its compiler is missing")
        return()
    endif()
    set(program ${folder}/scalar-timing-${name})
    file(MAKE_DIRECTORY ${folder})
    add_custom_command(OUTPUT ${program}.o
        COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} ${compiler} -std=c++17 ${ARGN}
            -I${PROJECT_SOURCE_DIR}/include -I${PROJECT_SOURCE_DIR} -MD -MF ${program}.d -c ${source} -o ${program}.o
        DEPENDS ${source} DEPFILE ${program}.d
        COMMENT "Compiling the timing program ${name}" VERBATIM)
    add_custom_command(OUTPUT ${program}
        COMMAND ${compiler} ${program}.o -o ${program}
        DEPENDS ${program}.o VERBATIM)
    set(programs ${programs} ${program} PARENT_SCOPE)
endfunction()
add_scalar_program(g++-O2 "${NUSSELT_TIMED_GXX}" -O2)
add_scalar_program(g++-O3-native "${NUSSELT_TIMED_GXX}" -O3 -march=native)
add_scalar_program(clang19-O3-native "${NUSSELT_TIMED_CLANG}" -O3 -march=native)
add_custom_target(nusselt_scalar_timing DEPENDS ${programs})
