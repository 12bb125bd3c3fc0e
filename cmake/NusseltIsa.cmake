# Units that are compiled once for each instruction set. base/isa.h chooses between them at run time.

set(nusselt_isas sse42 avx2 avx512)
set(nusselt_level_sse42 x86-64-v2)
set(nusselt_level_avx2 x86-64-v3)
set(nusselt_level_avx512 x86-64-v4)

# nusselt_add_isa_units(name [ONLY isa] source...): object libraries <name>_sse42, <name>_avx2 and <name>_avx512, or one of
# them. Sources see the instruction set as NUSSELT_UNIT_ISA, the name of a member of base::Isa. They throw nothing: if they
# could, clang would add handlers that the linker shares between instruction sets. The global property NUSSELT_ISA_UNITS
# lists all these libraries for checks.weak_symbols.
function(nusselt_add_isa_units name)
    cmake_parse_arguments(arg "" "ONLY" "" ${ARGN})
    set(isas ${nusselt_isas})
    if(arg_ONLY)
        set(isas ${arg_ONLY})
    endif()
    foreach(isa IN LISTS isas)
        add_library(${name}_${isa} OBJECT ${arg_UNPARSED_ARGUMENTS})
        # The last -march wins: it comes after the build flags.
        target_link_libraries(${name}_${isa} PRIVATE nusselt_build_flags nusselt::nusselt nusselt_level_${isa})
        target_compile_definitions(${name}_${isa} PRIVATE NUSSELT_UNIT_ISA=${isa})
        set_property(GLOBAL APPEND PROPERTY NUSSELT_ISA_UNITS ${name}_${isa})
    endforeach()
endfunction()

foreach(isa IN LISTS nusselt_isas)
    add_library(nusselt_level_${isa} INTERFACE)
    target_compile_options(nusselt_level_${isa} INTERFACE -march=${nusselt_level_${isa}} -fno-exceptions)
endforeach()
