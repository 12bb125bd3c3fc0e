# What all our own programs, modules and tests are compiled with. The installed library imposes none of it.
if(PROJECT_IS_TOP_LEVEL)
    if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CXX_FLAGS)
        set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
    endif()
    find_program(CCACHE ccache)
    if(CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
        # Without these ccache leaves units with precompiled headers alone.
        set(CMAKE_CXX_COMPILER_LAUNCHER
            ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
    endif()
endif()

add_library(nusselt_build_flags INTERFACE)
target_compile_features(nusselt_build_flags INTERFACE cxx_std_20)
# Modules of src/ are included as "module/file.h", all else by its path from the root, such as "proof/hostile/lights.h".
target_include_directories(nusselt_build_flags INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
target_compile_options(nusselt_build_flags INTERFACE
    # The baseline. The packet kernels add AVX2 and AVX-512 units of their own, chosen at run time.
    -march=x86-64-v2
    # fma is written where it is meant: scalars, packs and GPUs shall round alike.
    -ffp-contract=off
    # Nobody reads errno; without this a sqrt is a call.
    -fno-math-errno
    # It packs neighbouring scalars of long chains, which costs more than it saves (docs/performance.md, entry 16).
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
    # ccache needs it for units with precompiled headers.
    $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
    -Wall -Wextra -Wpedantic -Wshadow
    # GCC 12 warns of every `"text" + std::string` (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
    $<$<BOOL:${NUSSELT_WARNINGS_AS_ERRORS}>:-Werror>)
