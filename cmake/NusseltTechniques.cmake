# The registry of techniques, include/nusselt/techniques.json, for CMake files and as C++.
# docs/techniques/README.md describes its fields.

set(nusselt_techniques_file ${PROJECT_SOURCE_DIR}/include/nusselt/techniques.json)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${nusselt_techniques_file})

# Each field of each technique becomes a variable nusselt_technique_<name>_<field>, empty where the row lacks the field.
# nusselt_techniques lists the names, nusselt_column_techniques those of the packages for other languages, whose lights are
# columns of numbers.
set(nusselt_technique_fields
    light measure horizon header density source renders published approximates clips_twice iterates cyclic)
file(READ ${nusselt_techniques_file} registry)
string(JSON count LENGTH "${registry}")
math(EXPR last "${count} - 1")
set(nusselt_techniques)
set(nusselt_column_techniques)
foreach(i RANGE ${last})
    string(JSON row GET "${registry}" ${i})
    string(JSON name GET "${row}" name)
    list(APPEND nusselt_techniques ${name})
    foreach(field IN LISTS nusselt_technique_fields)
        string(JSON nusselt_technique_${name}_${field} ERROR_VARIABLE absent GET "${row}" ${field})
        if(absent)
            set(nusselt_technique_${name}_${field})
        endif()
    endforeach()
    foreach(field file struct functions prepare queries)
        string(JSON nusselt_technique_${name}_glsl_${field} ERROR_VARIABLE absent GET "${row}" glsl ${field})
        if(absent)
            set(nusselt_technique_${name}_glsl_${field})
        endif()
    endforeach()
    # Whether it is a published method, there to compare with.
    set(nusselt_technique_${name}_is_related false)
    if(nusselt_technique_${name}_header MATCHES "^related/")
        set(nusselt_technique_${name}_is_related true)
    endif()
    # The suites that leave the technique out. The reasons are for readers and for scripts/check-techniques.py.
    set(nusselt_technique_${name}_exempt)
    string(JSON exemptions ERROR_VARIABLE absent LENGTH "${row}" exempt)
    if(NOT absent)
        math(EXPR last_exemption "${exemptions} - 1")
        foreach(k RANGE ${last_exemption})
            string(JSON suites MEMBER "${row}" exempt ${k})
            separate_arguments(suites)
            list(APPEND nusselt_technique_${name}_exempt ${suites})
        endforeach()
    endif()
    if(NOT nusselt_technique_${name}_is_related AND NOT wasm IN_LIST nusselt_technique_${name}_exempt)
        list(APPEND nusselt_column_techniques ${name})
    endif()
endforeach()

# nusselt_snake_case(variable PascalCase): pascal_case.
function(nusselt_snake_case variable name)
    string(REGEX REPLACE "([A-Z])" "_\\1" name ${name})
    string(TOLOWER ${name} name)
    string(SUBSTRING ${name} 1 -1 name)
    set(${variable} ${name} PARENT_SCOPE)
endfunction()

# nusselt_pascal_case(variable snake_case): SnakeCase.
function(nusselt_pascal_case variable name)
    string(REGEX MATCHALL "[^_]+" words ${name})
    set(result)
    foreach(word IN LISTS words)
        string(SUBSTRING ${word} 0 1 first)
        string(TOUPPER ${first} first)
        string(SUBSTRING ${word} 1 -1 rest)
        string(APPEND result ${first}${rest})
    endforeach()
    set(${variable} ${result} PARENT_SCOPE)
endfunction()

# nusselt_geometry_of(variable technique): the light that functions of GLSL and C++ take: rectangles are polygons.
function(nusselt_geometry_of variable technique)
    string(REPLACE rectangle polygon geometry ${nusselt_technique_${technique}_light})
    set(${variable} ${geometry} PARENT_SCOPE)
endfunction()

# nusselt_class_of(variable technique real): the class in a number type, for at most four vertices.
function(nusselt_class_of variable technique real)
    set(arguments ${real})
    if(nusselt_technique_${technique}_light MATCHES "^polygon")
        set(arguments "${real}, 4")
    endif()
    set(${variable} "nusselt::${technique}<${arguments}>" PARENT_SCOPE)
endfunction()

# nusselt_vertex_defines(variable technique bound): the definitions with which the GLSL of a technique takes polygons of at
# most `bound` vertices.
function(nusselt_vertex_defines variable technique bound)
    set(defines)
    nusselt_geometry_of(geometry ${technique})
    if(geometry MATCHES "polygon")
        set(capacity ${bound})
        if(nusselt_technique_${technique}_clips_twice)
            math(EXPR capacity "${bound} + 1")
        endif()
        set(defines NUSSELT_MAX_VERTICES=${capacity} LIGHT_VERTICES=${bound})
    endif()
    set(${variable} ${defines} PARENT_SCOPE)
endfunction()

# nusselt_shader_arguments(variable technique): what nusselt_add_technique_shader() takes after the entry point, without
# definitions.
function(nusselt_shader_arguments variable technique)
    set(row nusselt_technique_${technique})
    set(arguments nusselt/${${row}_glsl_file} ${${row}_glsl_struct})
    if(${row}_glsl_functions)
        list(APPEND arguments FUNCTIONS ${${row}_glsl_functions})
    endif()
    if(${row}_glsl_prepare)
        list(APPEND arguments PREPARE ${${row}_glsl_prepare})
    endif()
    if(${row}_glsl_queries)
        list(APPEND arguments QUERIES ${${row}_glsl_queries})
    endif()
    set(${variable} ${arguments} PARENT_SCOPE)
endfunction()

# Writes a row as a member of the lists in proof/techniques/registry.h.in.
function(nusselt_describe_technique name)
    set(row nusselt_technique_${name})
    set(light ${${row}_light})
    nusselt_pascal_case(kind ${light})
    set(arguments Real)
    set(template)
    set(kind_name ${name}Kind)
    if(light MATCHES "^polygon")
        set(arguments "Real, N")
        set(template "template <int N>\n")
        set(base "${kind}Kind<N>")
        set(kind_name ${name}KindOf)
    else()
        set(base "${kind}Kind")
    endif()
    set(technique ${name}<${arguments}>)
    set(reference ${name})
    if(${row}_approximates)
        set(reference ${${row}_approximates})
    endif()
    set(exact "${reference}<Real")
    if(light MATCHES "^polygon")
        string(APPEND exact ", N")
    endif()
    set(precise "${exact}>")
    set(few_steps Absent)
    if(nusselt_technique_${reference}_iterates)
        set(precise "${exact}, 6>")
        if(NOT ${row}_approximates)
            set(few_steps "${exact}, 2>")
        endif()
    endif()
    set(published Absent)
    if(${row}_published)
        set(published "${${row}_published}<${arguments}>")
    endif()
    set(competitor ${${row}_published})
    if(NOT competitor)
        set(competitor ${nusselt_technique_${reference}_published})
    endif()
    if(light MATCHES "_on_lobe$")
        set(technique "WithLobe<${technique}>")
        set(precise "WithLobe<${precise}>")
    endif()
    set(cyclic false)
    if(${row}_cyclic)
        set(cyclic true)
    endif()
    set(biased false)
    if(${row}_approximates)
        set(biased true)
    endif()
    list(JOIN ${row}_exempt " " exempt)
    set(text "${template}struct ${kind_name} : ${base} {
    static constexpr const char* kName = \"${name}\";
    static constexpr Measure kMeasure = Measure::${${row}_measure};
    static constexpr Horizon kHorizon = Horizon::${${row}_horizon};
    static constexpr bool kCyclic = ${cyclic};
    static constexpr bool kBiased = ${biased};
    static constexpr bool kIsRelated = ${${row}_is_related};
    static constexpr const char* kPublishedName = \"${${row}_published}\";
    static constexpr const char* kCompetitorName = \"${competitor}\";
    static constexpr std::string_view kExemptions = \"${exempt}\";
    template <class Real>
    using Technique = ${technique};
    template <class Real>
    using Reference = ${precise};
    template <class Real>
    using FewSteps = ${few_steps};
    template <class Real>
    using Published = ${published};
};\n")
    if(light MATCHES "^polygon")
        string(APPEND text "using ${name}Kind = ${kind_name}<4>;\n")
        set(member "${kind_name}<N>")
        if(${row}_clips_twice)
            set(member "${kind_name}<(N < 7 ? N : 7)>")
        endif()
    else()
        set(member ${kind_name})
    endif()
    set(text ${text} PARENT_SCOPE)
    set(member ${member} PARENT_SCOPE)
endfunction()

# The C++ of the registry in a folder of the build: types in proof/techniques/registry.h, rows for users in
# techniques_table.h.
set(headers)
set(kinds)
set(rows)
foreach(name IN LISTS nusselt_techniques)
    set(light ${nusselt_technique_${name}_light})
    list(APPEND headers "#include <nusselt/${nusselt_technique_${name}_header}>\n")
    if(nusselt_technique_${name}_published)
        nusselt_snake_case(file ${nusselt_technique_${name}_published})
        list(APPEND headers "#include <nusselt/related/${file}.h>\n")
    endif()
    set(row nusselt_technique_${name})
    # Published methods are there to compare with, not to use.
    if(NOT ${row}_is_related)
        string(APPEND rows "    {\"${name}\", \"${light}\", \"${${row}_density}\", \"${${row}_source}\", \"${${row}_header}\", \"${${row}_renders}\"},\n")
    endif()
    # No light of the proofs comes with a BRDF or with radiance.
    if(NOT light MATCHES "_on_brdf$|^textured|^windowed|^environment")
        nusselt_describe_technique(${name})
        string(APPEND kinds "${text}\n")
        if(${row}_is_related AND light STREQUAL polygon)
            string(REPLACE "<N>" "<4>" member "${member}")
            list(APPEND members_related_polygon ${member})
        else()
            # Round lights of all shapes are in one list.
            string(REGEX REPLACE "^(sphere|disk|ellipse|ellipsoid)" round list_of_light ${light})
            list(APPEND members_${list_of_light} ${member})
        endif()
    endif()
endforeach()
list(SORT headers)
list(REMOVE_DUPLICATES headers)
list(JOIN headers "" headers)
foreach(light polygon related_polygon polygon_on_lobe rectangle line line_on_lobe cylinder cylinder_on_lobe round
    round_on_lobe)
    list(JOIN members_${light} ", " members_${light})
endforeach()
configure_file(${PROJECT_SOURCE_DIR}/proof/techniques/registry.h.in
    ${PROJECT_BINARY_DIR}/generated/proof/techniques/registry.h @ONLY)
configure_file(${PROJECT_SOURCE_DIR}/cmake/techniques_table.h.in
    ${PROJECT_BINARY_DIR}/generated/techniques_table.h @ONLY)
