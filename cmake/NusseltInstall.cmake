# Installs the headers, the shaders and the files with which find_package(nusselt) finds them.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/nusselt)

install(DIRECTORY include/nusselt DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY shaders/nusselt/ DESTINATION ${CMAKE_INSTALL_DATADIR}/nusselt/shaders)
set(single_header ${PROJECT_BINARY_DIR}/single-header/nusselt.h)
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" -D \"OUTPUT=${single_header}\"
    -P \"${PROJECT_SOURCE_DIR}/scripts/amalgamate.cmake\" COMMAND_ERROR_IS_FATAL ANY)")
install(FILES ${single_header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY data/ DESTINATION ${CMAKE_INSTALL_DATADIR}/nusselt)
install(TARGETS nusselt EXPORT nusseltTargets)
install(EXPORT nusseltTargets NAMESPACE nusselt:: DESTINATION ${package_dir})

configure_package_config_file(cmake/nusseltConfig.cmake.in ${PROJECT_BINARY_DIR}/nusseltConfig.cmake
    INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/nusseltConfigVersion.cmake
    COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${PROJECT_BINARY_DIR}/nusseltConfig.cmake ${PROJECT_BINARY_DIR}/nusseltConfigVersion.cmake
    DESTINATION ${package_dir})
