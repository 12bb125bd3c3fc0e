# Finds the dependencies of the viewer beside the GPU side. NUSSELT_BUILD_VIEWER is true if it can be built; everything
# else does not need it.

find_package(glfw3 3.3 CONFIG QUIET)
find_path(IMGUI_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui)
find_library(IMGUI_LIBRARY imgui)
# The fonts of Debian's ImGui are drawn by libstb, which comes with it.
find_library(STB_LIBRARY stb)
set(missing_viewer_packages)
if(NOT glfw3_FOUND)
    list(APPEND missing_viewer_packages libglfw3-dev)
endif()
if(NOT IMGUI_INCLUDE_DIR OR NOT IMGUI_LIBRARY OR NOT STB_LIBRARY)
    list(APPEND missing_viewer_packages libimgui-dev)
endif()
set(NUSSELT_BUILD_VIEWER ${NUSSELT_BUILD_GPU})
if(NUSSELT_BUILD_GPU AND missing_viewer_packages)
    set(NUSSELT_BUILD_VIEWER OFF)
    list(JOIN missing_viewer_packages " " missing_viewer_packages)
    message(WARNING "The viewer is not built because these Debian packages are missing: ${missing_viewer_packages}")
endif()
