include(${CMAKE_CURRENT_LIST_DIR}/CameraDirectorClientTargets.cmake)
