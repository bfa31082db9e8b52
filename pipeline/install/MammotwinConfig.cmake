# find_package(Mammotwin): targets Mammotwin::mammotwin_segmentation, _mesh, _fitting, _solver, _registration.
# Headers are included as in Mammotwin itself: #include "fitting/mesh/hermite_mesh.h".
# The project that asks must have enabled C and C++ (ITK's HDF5 probe needs C).
include(CMakeFindDependencyMacro)
find_dependency(Eigen3)
find_dependency(TBB)
find_dependency(ZLIB)
find_dependency(nlohmann_json)
find_dependency(GDCM)
find_dependency(CGAL)
find_dependency(OpenMP)
# The components that the stages' own CMakeLists.txt ask for; all of VTK and ITK would need Qt.
find_dependency(VTK COMPONENTS CommonCore CommonDataModel CommonExecutionModel FiltersCore IOXML)
find_dependency(ITK COMPONENTS ITKCommon ITKIOImageBase ITKIONRRD ITKIONIFTI ITKIOMeta ITKIOPNG
  ITKBiasCorrection ITKSmoothing ITKThresholding ITKConnectedComponents)
include(${CMAKE_CURRENT_LIST_DIR}/MammotwinTargets.cmake)
