# find_package(lumel) gives the target lumel::lumel.
include(${CMAKE_CURRENT_LIST_DIR}/lumelTargets.cmake)
