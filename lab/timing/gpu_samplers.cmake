# The shaders of `nusselt-lab bench gpu-samplers`, and the table of them. Polygons have their exact number of vertices as
# bound, as in a renderer whose lights have that many.
set(includes)
set(rows)

# For devices whose fma rounds twice or once. For further arguments see nusselt_add_technique_shader().
function(add_timed_shaders name kind vertex_count file struct)
    string(REGEX REPLACE "([A-Z])" "_\\1" shader ${name})
    string(TOLOWER bench${shader}_${kind}_${vertex_count} shader)
    set(bound)
    if(kind STREQUAL polygon)
        set(bound NUSSELT_MAX_VERTICES=${vertex_count})
    endif()
    foreach(fused 0 1)
        nusselt_add_technique_shader(nusselt_lab ${shader}_${fused} bench/${kind} ${file} ${struct} ${ARGN}
            DEFINES ${bound} NUSSELT_FUSED_FMA=${fused})
        string(TOUPPER ${kind} upper_kind)
        string(SUBSTRING ${kind} 1 -1 rest)
        string(SUBSTRING ${upper_kind} 0 1 initial)
        list(APPEND includes "#include \"shaders/${shader}_${fused}.h\"\n")
        list(APPEND rows "    {\"${name}\", LightKind::${kind}, ${vertex_count}, ${fused} == 1, shaders::kBench${name}${initial}${rest}${vertex_count}${fused}},\n")
    endforeach()
    set(includes ${includes} PARENT_SCOPE)
    set(rows ${rows} PARENT_SCOPE)
endfunction()

foreach(count 3 4 5 6 7)
    add_timed_shaders(Baseline polygon ${count} bench/baseline_polygon BaselinePolygon)
    add_timed_shaders(PolygonArea polygon ${count} nusselt/sampling/polygon_area PolygonArea)
    add_timed_shaders(PolygonSolidAnglePeters polygon ${count}
        nusselt/related/polygon_solid_angle_peters PolygonSolidAnglePeters)
    add_timed_shaders(PolygonSolidAngle polygon ${count} nusselt/sampling/polygon_solid_angle PolygonSolidAngle)
    add_timed_shaders(PolygonClippedSolidAngle polygon ${count}
        nusselt/sampling/polygon_clipped_solid_angle PolygonSolidAngle)
    add_timed_shaders(PolygonProjectedSolidAnglePeters polygon ${count}
        nusselt/related/polygon_projected_solid_angle_peters PolygonProjectedSolidAnglePeters)
    add_timed_shaders(PolygonProjectedSolidAngle polygon ${count}
        nusselt/sampling/polygon_projected_solid_angle PolygonProjectedSolidAngle)
    add_timed_shaders(PolygonProjectedSolidAngleBiased polygon ${count}
        nusselt/sampling/polygon_projected_solid_angle_biased PolygonProjectedSolidAngleBiased)
endforeach()
add_timed_shaders(Baseline line 2 bench/baseline_line BaselineLine)
add_timed_shaders(LineArea line 2 nusselt/sampling/line_area LineArea)
add_timed_shaders(LineSolidAngle line 2 nusselt/sampling/line_solid_angle LineSolidAngle)
add_timed_shaders(LineClippedSolidAngle line 2 nusselt/sampling/line_solid_angle LineSolidAngle
    PREPARE line_clipped_solid_angle_prepare)
add_timed_shaders(LineProjectedSolidAnglePeters line 2
    nusselt/related/line_projected_solid_angle_peters LineProjectedSolidAnglePeters)
add_timed_shaders(LineProjectedSolidAngle line 2
    nusselt/sampling/line_projected_solid_angle LineProjectedSolidAngle)

list(JOIN includes "" includes)
list(JOIN rows "" rows)
configure_file(timing/gpu_samplers_table.h.in ${CMAKE_CURRENT_BINARY_DIR}/shaders/gpu_samplers_table.h @ONLY)
target_sources(nusselt_lab PRIVATE timing/gpu_samplers.cpp)
target_link_libraries(nusselt_lab PUBLIC nusselt_gpu)
