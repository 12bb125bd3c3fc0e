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

# The same for a library without any description, and for a program, by one of several names.
macro(nusselt_find_library variable debian_package name)
    find_library(${variable} ${name})
    if(NOT ${variable})
        list(APPEND missing ${debian_package})
    endif()
endmacro()
macro(nusselt_find_program variable debian_package)
    find_program(${variable} NAMES ${ARGN})
    if(NOT ${variable})
        list(APPEND missing ${debian_package})
    endif()
endmacro()

# nusselt_decide(option what missing): replaces AUTO, the value of an option, by ON or OFF. If packages are missing, AUTO
# leaves the part out with one line; ON is an error, so that nothing drops out unnoticed where somebody asked for it.
function(nusselt_decide option what missing)
    set(decision ON)
    if(missing)
        list(JOIN missing " " packages)
        if(NOT ${option} STREQUAL "AUTO")
            message(FATAL_ERROR "${what} cannot be built because these Debian packages are missing: ${packages}\n"
                "`make test` and `make demo` install what they need on Debian 12 and 13. -D${option}=OFF does without.")
        endif()
        message(STATUS "${what} are left out because these Debian packages are missing: ${packages}")
        set(decision OFF)
    endif()
    set(${option} ${decision} PARENT_SCOPE)
endfunction()

macro(nusselt_find_renderer_dependencies)
    set(missing)
    # Each version of Embree calls itself compatible with its own major version only.
    nusselt_find(embree libembree-dev)
    if(embree_FOUND AND (embree_VERSION VERSION_LESS 3.13 OR embree_VERSION VERSION_GREATER_EQUAL 5))
        if(NOT NUSSELT_BUILD_RENDERER STREQUAL "AUTO")
            message(FATAL_ERROR "Embree ${embree_VERSION} in ${embree_DIR} is not supported; 3.13 or 4 is needed "
                "(Debian: libembree-dev). -Dembree_DIR=FOLDER names the folder of another embree-config.cmake.")
        endif()
        list(APPEND missing "libembree-dev (3.13 or 4)")
    endif()
    nusselt_find(TBB libtbb-dev)
    nusselt_find(OpenEXR libopenexr-dev 3)
    nusselt_find(CLI11 libcli11-dev)
    nusselt_find(fmt libfmt-dev)
    nusselt_find(nlohmann_json nlohmann-json3-dev)
    nusselt_find_system(PNG libpng-dev)
    nusselt_find_system(JPEG libjpeg62-turbo-dev)
    nusselt_find_system(ZLIB zlib1g-dev)
    nusselt_find_library(NLOPT_LIBRARY libnlopt-dev nlopt)
    nusselt_decide(NUSSELT_BUILD_RENDERER "The programs" "${missing}")
endmacro()

macro(nusselt_find_test_dependencies)
    set(missing)
    nusselt_find(GTest libgtest-dev)
    if(NUSSELT_BUILD_RENDERER)
        # A second reader and writer of images, for comparison.
        nusselt_find_library(STB_LIBRARY libstb-dev stb)
    endif()
    if(NOT NUSSELT_TEST_LIBRARY_ONLY)
        nusselt_find_program(CLANG_CXX clang-14 clang++-14 clang++-19 clang++)
        nusselt_find_program(CLANG_19 clang-19 clang++-19)
        nusselt_find_program(PYTHON python3 python3)
        nusselt_find_program(QEMU qemu-user qemu-x86_64)
    endif()
    nusselt_decide(NUSSELT_BUILD_TESTS "The tests" "${missing}")
endmacro()
