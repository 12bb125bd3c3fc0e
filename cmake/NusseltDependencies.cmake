# Finds the packages that the renderer and the tests use, and names all missing ones in one message.

# Appends packages that are not found to `missing`; arguments are the name for find_package and that of the Debian package.
macro(nusselt_find name debian_package)
    # Debian's Imath reports that Python bindings, which we do not use, are not installed.
    set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
    find_package(${name} ${ARGN} CONFIG QUIET)
    unset(CMAKE_MESSAGE_LOG_LEVEL)
    if(NOT ${name}_FOUND)
        list(APPEND missing ${debian_package})
    endif()
endmacro()

# The same for packages without CMake files.
macro(nusselt_find_system name debian_package)
    find_package(${name} QUIET)
    if(NOT ${name}_FOUND)
        list(APPEND missing ${debian_package})
    endif()
endmacro()

function(nusselt_report_missing what alternative missing)
    if(missing)
        list(JOIN missing " " packages)
        message(FATAL_ERROR "${what} cannot be built because these Debian packages are missing: ${packages}\n"
            "`make test` and `make demo` install what they need on Debian 12 and 13. ${alternative}")
    endif()
endfunction()

macro(nusselt_require_renderer_dependencies)
    set(missing)
    # Each version of Embree calls itself compatible with its own major version only.
    nusselt_find(embree libembree-dev)
    if(embree_FOUND AND (embree_VERSION VERSION_LESS 3.13 OR embree_VERSION VERSION_GREATER_EQUAL 5))
        message(FATAL_ERROR "Embree ${embree_VERSION} in ${embree_DIR} is not supported; 3.13 or 4 is needed "
            "(Debian: libembree-dev). -Dembree_DIR=FOLDER names the folder of another embree-config.cmake.")
    endif()
    nusselt_find(TBB libtbb-dev)
    nusselt_find(OpenEXR libopenexr-dev 3)
    nusselt_find(CLI11 libcli11-dev)
    nusselt_find(fmt libfmt-dev)
    nusselt_find(nlohmann_json nlohmann-json3-dev)
    nusselt_find_system(PNG libpng-dev)
    nusselt_find_system(JPEG libjpeg62-turbo-dev)
    nusselt_find_system(ZLIB zlib1g-dev)
    find_library(NLOPT_LIBRARY nlopt)
    if(NOT NLOPT_LIBRARY)
        list(APPEND missing libnlopt-dev)
    endif()
    nusselt_report_missing("The renderer" "-DNUSSELT_BUILD_RENDERER=OFF -DNUSSELT_BUILD_TESTS=OFF installs the library alone." "${missing}")
endmacro()

macro(nusselt_require_test_dependencies)
    set(missing)
    nusselt_find(GTest libgtest-dev)
    # A second reader and writer of images, for comparison.
    find_library(STB_LIBRARY stb)
    if(NOT STB_LIBRARY)
        list(APPEND missing libstb-dev)
    endif()
    nusselt_report_missing("The tests" "-DNUSSELT_BUILD_TESTS=OFF leaves the tests out." "${missing}")
endmacro()
