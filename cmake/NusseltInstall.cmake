# Installs the headers and the files with which find_package(nusselt) finds them.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/nusselt)

install(DIRECTORY include/nusselt DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(TARGETS nusselt EXPORT nusseltTargets)
install(EXPORT nusseltTargets NAMESPACE nusselt:: DESTINATION ${package_dir})

configure_package_config_file(cmake/nusseltConfig.cmake.in ${PROJECT_BINARY_DIR}/nusseltConfig.cmake
    INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/nusseltConfigVersion.cmake
    COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${PROJECT_BINARY_DIR}/nusseltConfig.cmake ${PROJECT_BINARY_DIR}/nusseltConfigVersion.cmake
    DESTINATION ${package_dir})
