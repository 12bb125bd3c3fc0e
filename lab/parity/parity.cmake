# Parity of GLSL and C++ on a device: `nusselt-lab parity` and the tests run these comparisons. A library of its own, because
# it takes long to compile and nothing else of the laboratory needs it.
add_library(nusselt_lab_parity STATIC
    parity/emission/environment_parity.cpp
    parity/emission/textured_line_parity.cpp
    parity/emission/textured_parity.cpp
    parity/emission/windowed_parity.cpp
    parity/groups/estimate_groups.cpp
    parity/groups/function_groups.cpp
    parity/groups/ltc_groups.cpp
    parity/groups/random_numbers.cpp
    parity/parity.cpp
    parity/parity_check.cpp
    parity/techniques.cpp
    parity/twin_shader.cpp
    parity/vertex_bounds.cpp
    parity/vulkan_platform.cpp)
# Most of the time is spent on reading headers and instantiating templates.
target_compile_options(nusselt_lab_parity PRIVATE -O1)
# Compiling this unit takes 58 s instead of 95 s, and its tests, which take less than that, become a little slower only.
set_source_files_properties(parity/vertex_bounds.cpp PROPERTIES COMPILE_OPTIONS -Og)
target_link_libraries(nusselt_lab_parity
    PUBLIC nusselt_build_flags nusselt::nusselt nusselt_gpu nusselt_proof nusselt_render nusselt_tables fmt::fmt TBB::tbb)
# Tests take the shaders of the comparisons, too.
target_include_directories(nusselt_lab_parity PUBLIC ${CMAKE_CURRENT_BINARY_DIR})

# Adds a row to the table of twins of a target. `name` is the name of a technique, or of the published method that it replaces.
# nusselt_add_technique_shader() describes the other arguments.
set(includes)
set(rows)
function(add_twin target name technique bound entry)
    cmake_parse_arguments(arg "" "" "DEFINES" ${ARGN})
    nusselt_vertex_defines(vertices ${technique} ${bound})
    nusselt_snake_case(shader ${name})
    set(shader twin_${shader}_${bound})
    nusselt_add_technique_shader(${target} ${shader} parity/${entry} ${arg_UNPARSED_ARGUMENTS}
        DEFINES ${arg_DEFINES} ${vertices})
    nusselt_shader_array(array ${shader})
    list(APPEND includes "#include \"shaders/${shader}.h\"\n")
    list(APPEND rows "    {\"${name}\", ${bound}, {\"${shader}\", shaders::${array}}},\n")
    set(includes ${includes} PARENT_SCOPE)
    set(rows ${rows} PARENT_SCOPE)
endfunction()

# The bounds on the number of vertices to judge. vertex_bounds.cpp runs polygons with each of them.
set(bounds_of_polygon 3 4 5 6 7 8)
set(bounds_of_polygon_on_lobe 4 8)
set(bounds_of_rectangle 4)
set(bounds_of_textured_polygon 8)
set(bounds_of_textured_polygon_on_lobe 8)
set(bounds_of_windowed_polygon 8)
set(bounds_of_windowed_polygon_on_lobe 8)
foreach(light line line_on_lobe cylinder cylinder_on_lobe ellipse ellipse_on_lobe ellipsoid ellipsoid_on_lobe environment environment_on_lobe
    textured_line textured_line_on_lobe textured_tube textured_tube_on_lobe)
    set(bounds_of_${light} 2)
endforeach()
foreach(name IN LISTS nusselt_techniques)
    set(row nusselt_technique_${name})
    # tests/parity has the published methods, which nobody runs elsewhere.
    if(parity IN_LIST ${row}_exempt OR ${row}_is_related)
        continue()
    endif()
    nusselt_geometry_of(light ${name})
    nusselt_shader_arguments(arguments ${name})
    set(entry ${light})
    if(light MATCHES "^textured|^windowed|^environment")
        set(entry emission/${light})
    endif()
    set(bounds ${bounds_of_${${row}_light}})
    if(${row}_clips_twice)
        list(TRANSFORM bounds REPLACE 8 7)
    endif()
    foreach(bound IN LISTS bounds)
        add_twin(nusselt_lab_parity ${name} ${name} ${bound} ${entry} ${arguments})
    endforeach()
endforeach()

# A twin whose loops are not marked with [[unroll]].
nusselt_shader_arguments(arguments PolygonProjectedSolidAngle)
foreach(bound 4 8)
    add_twin(nusselt_lab_parity RolledPolygonProjectedSolidAngle PolygonProjectedSolidAngle ${bound} polygon ${arguments}
        DEFINES NUSSELT_UNROLL=)
endforeach()

list(JOIN includes "" includes)
list(JOIN rows "" rows)
configure_file(parity/twins.h.in ${CMAKE_CURRENT_BINARY_DIR}/shaders/twins.h @ONLY)

foreach(functions arithmetic brdf_direct_light bsdf clip engine_table frame light_random line line_direct_light
    line_shading lobe ltc_table mis phong polygon polygon_brdf polygon_direct_light polygon_shading random shading_frame
    trig visible_normals visible_part)
    nusselt_add_shader(nusselt_lab_parity ${functions} ${PROJECT_SOURCE_DIR}/shaders/parity/functions/${functions}.comp)
endforeach()

# The entry points that scripts/convert-shaders.cmake translates.
get_target_property(shaders nusselt_lab_parity NUSSELT_SHADERS)
file(CONFIGURE OUTPUT parity/shaders.txt CONTENT "${shaders}" @ONLY)
