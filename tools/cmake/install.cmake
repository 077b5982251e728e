# What `cmake --install` puts where: libraries, public headers under include/touchstone/<half>/, one export
# set a component, so that the core's consumer needs nothing of the exact half.
include(CMakePackageConfigHelpers)
set(touchstone_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/touchstone)

function(touchstone_install_half half)
  install(TARGETS touchstone_${half} EXPORT touchstone_${half}_targets COMPONENT ${half}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT touchstone_${half}_targets NAMESPACE touchstone:: COMPONENT ${half}
          DESTINATION ${touchstone_cmake_dir})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${half}/ COMPONENT ${half}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/touchstone/${half}
          FILES_MATCHING PATTERN "*.h" PATTERN "*_internal.h" EXCLUDE)
endfunction()

touchstone_install_half(core)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE COMPONENT core DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(TOUCHSTONE_BUILD_EXACT)
  touchstone_install_half(exact)
  install(FILES ${PROJECT_SOURCE_DIR}/exact/COPYING COMPONENT exact DESTINATION ${CMAKE_INSTALL_DOCDIR})
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/tools/cmake/touchstoneConfig.cmake.in
  ${PROJECT_BINARY_DIR}/touchstoneConfig.cmake INSTALL_DESTINATION ${touchstone_cmake_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/touchstoneConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/touchstoneConfig.cmake ${PROJECT_BINARY_DIR}/touchstoneConfigVersion.cmake
        COMPONENT core DESTINATION ${touchstone_cmake_dir})
