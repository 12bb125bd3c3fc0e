# Compiler options of our programs, modules and tests. The installed library imposes none of them.
if(PROJECT_IS_TOP_LEVEL)
    if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CXX_FLAGS)
        set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
    endif()
    find_program(CCACHE ccache)
    if(CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
        # Without these, ccache does not cache units with precompiled headers.
        set(CMAKE_CXX_COMPILER_LAUNCHER
            ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
    endif()
endif()

add_library(nusselt_build_flags INTERFACE)
target_compile_features(nusselt_build_flags INTERFACE cxx_std_20)
# Modules of src/ are included as "module/file.h", other files by their path from the root, such as "proof/hostile/lights.h".
target_include_directories(nusselt_build_flags INTERFACE
    ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
target_compile_options(nusselt_build_flags INTERFACE
    # The baseline. The packet kernels add AVX2 and AVX-512 units of their own, chosen at run time.
    -march=x86-64-v2
    # The Python module links the objects of the programs. With hidden symbols this code is as fast as that of programs.
    -fPIC -fvisibility=hidden
    # The code calls fma explicitly, so that scalars, packs and GPUs round alike.
    -ffp-contract=off
    # Our code does not read errno. Without this option, sqrt is a function call.
    -fno-math-errno
    # The vectoriser packs neighbouring scalars of long chains, which costs more than it saves (docs/performance.md, entry 16).
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
    # ccache needs these options for units with precompiled headers.
    $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
    $<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>
    # Precompiled headers fill the heap beyond the size from which GCC collects garbage: up to a tenth of its time.
    $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>
    -Wall -Wextra -Wpedantic -Wshadow
    # GCC 12 warns of every `"text" + std::string` (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
    $<$<BOOL:${NUSSELT_WARNINGS_AS_ERRORS}>:-Werror>)

# The headers of the standard library, precompiled: reading them takes longer than compiling most units takes otherwise.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/standard_headers.cpp CONTENT "")
add_library(nusselt_standard_headers OBJECT EXCLUDE_FROM_ALL
    ${PROJECT_BINARY_DIR}/generated/standard_headers.cpp)
target_link_libraries(nusselt_standard_headers PRIVATE nusselt_build_flags)
target_precompile_headers(nusselt_standard_headers PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <functional>
    <limits> <map> <memory> <optional> <span> <stdexcept> <string> <string_view> <utility> <variant> <vector>)

# nusselt_use_standard_headers(target): compiles the target with these headers. It must have the same flags.
function(nusselt_use_standard_headers target)
    target_precompile_headers(${target} REUSE_FROM nusselt_standard_headers)
    # With them, GCC 12 has two more warnings of `"text" + std::string`.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-stringop-overflow>)
endfunction()
