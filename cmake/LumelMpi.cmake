# liblumel-mpi.so: the module by which `lumel bake` runs as several processes (docs/cluster.md). The program opens it
# only where mpirun or srun has started it, and does not link to MPI.
find_package(MPI QUIET COMPONENTS C)
option(LUMEL_MPI "Build the module for MPI" ${MPI_C_FOUND})
if(NOT LUMEL_MPI)
    return()
endif()
if(NOT MPI_C_FOUND)
    message(FATAL_ERROR "MPI (Debian package libopenmpi-dev) is not installed; it is needed with -DLUMEL_MPI=ON.")
endif()

add_library(lumel_mpi MODULE ${PROJECT_SOURCE_DIR}/src/base/ranks/mpi_transport.cpp)
lumel_flags(lumel_mpi)
target_compile_definitions(lumel_mpi PRIVATE LUMEL_VERSION="${PROJECT_VERSION}" OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
target_link_libraries(lumel_mpi PRIVATE MPI::MPI_C)
set_target_properties(lumel_mpi PROPERTIES OUTPUT_NAME lumel-mpi LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
install(TARGETS lumel_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/lumel COMPONENT mpi)
