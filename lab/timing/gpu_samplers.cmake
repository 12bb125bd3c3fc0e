# The shaders of `nusselt-lab bench gpu-samplers` and their table: the techniques of the registry, the published
# methods, and a baseline for each kind of light. The bound on the number of vertices is the exact number of each
# polygon, as in a renderer whose lights all have that many.
set(includes)
set(rows)

# Polygons have room for the vertices that `technique` needs. `suffix` is empty, or _direction for samples without density and hit point.
# nusselt_add_technique_shader() describes the other arguments.
function(add_timed_shaders name technique light vertex_count suffix file struct)
    nusselt_snake_case(shader ${name})
    set(shader bench_${shader}_${light}_${vertex_count}${suffix})
    set(directions false)
    if(suffix)
        set(directions true)
    endif()
    nusselt_vertex_defines(vertices ${technique} ${vertex_count})
    nusselt_add_technique_shader(nusselt_lab ${shader} bench/${light}${suffix} ${file} ${struct} ${ARGN} DEFINES ${vertices})
    nusselt_shader_array(array ${shader})
    list(APPEND includes "#include \"shaders/${shader}.h\"\n")
    string(REGEX REPLACE "^(ellipse|ellipsoid)" "round" kind ${light})
    list(APPEND rows "    {\"${name}\", LightKind::${kind}, ${vertex_count}, ${directions}, shaders::${array}},\n")
    set(includes ${includes} PARENT_SCOPE)
    set(rows ${rows} PARENT_SCOPE)
endfunction()

# Adds the baseline for a kind of light and then all its techniques, each after the formulas that it replaces.
macro(add_timed_light light vertex_count)
    set(has_baseline)
    foreach(name IN LISTS nusselt_techniques)
        set(row nusselt_technique_${name})
        nusselt_geometry_of(geometry ${name})
        if(NOT geometry STREQUAL ${light} OR gpu_timing IN_LIST ${row}_exempt)
            continue()
        endif()
        if(${row}_light STREQUAL rectangle AND NOT ${vertex_count} EQUAL 4)
            continue()
        endif()
        # Published methods for polygons are compared at four vertices.
        if(${row}_is_related AND NOT ${vertex_count} MATCHES "^[24]$")
            continue()
        endif()
        if(NOT has_baseline)
            nusselt_pascal_case(struct ${light})
            string(REPLACE "OnLobe" "" struct ${struct})
            add_timed_shaders(Baseline ${name} ${light} ${vertex_count} "" bench/baselines/${light} Baseline${struct}
                FUNCTIONS baseline_${light})
            set(has_baseline ON)
        endif()
        if(${row}_published)
            nusselt_snake_case(file ${${row}_published})
            add_timed_shaders(${${row}_published} ${name} ${light} ${vertex_count} ""
                nusselt/related/${file} ${${row}_published})
            # For lines and quadrilaterals, also directions alone.
            if(${vertex_count} EQUAL 2 OR ${vertex_count} EQUAL 4)
                add_timed_shaders(${${row}_published} ${name} ${light} ${vertex_count} _direction
                    nusselt/related/${file} ${${row}_published})
            endif()
        endif()
        nusselt_shader_arguments(arguments ${name})
        add_timed_shaders(${name} ${name} ${light} ${vertex_count} "" ${arguments})
    endforeach()
endmacro()

foreach(count 3 4 5 6 7)
    add_timed_light(polygon ${count})
endforeach()
add_timed_light(polygon_on_lobe 4)
foreach(light line line_on_lobe cylinder cylinder_on_lobe)
    add_timed_light(${light} 2)
endforeach()
# Spheres and disks have the shaders of ellipsoids and ellipses.
foreach(light ellipse ellipse_on_lobe ellipsoid ellipsoid_on_lobe)
    add_timed_light(${light} 4)
endforeach()

list(JOIN includes "" includes)
list(JOIN rows "" rows)
configure_file(timing/gpu_samplers_table.h.in ${CMAKE_CURRENT_BINARY_DIR}/shaders/gpu_samplers_table.h @ONLY)
target_sources(nusselt_lab PRIVATE timing/gpu_samplers.cpp)
target_link_libraries(nusselt_lab PUBLIC nusselt_gpu)
