# Third-party packages. Each one has a single home in the sources; scripts/check_layers.py holds that.
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(pugixml REQUIRED)
find_package(CLI11 REQUIRED)
find_package(PkgConfig REQUIRED)
# By pkg-config: Debian's CMake files for OpenImageIO name Python libraries that its packages do not bring.
pkg_check_modules(OPENIMAGEIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(NLOPT REQUIRED IMPORTED_TARGET nlopt)

# Embree 4 is preferred where it is installed, 3.13 is enough.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3.13 REQUIRED)
endif()

find_path(TINYGLTF_INCLUDE_DIR tiny_gltf.h REQUIRED)

if(PHOTOPIC_TESTS)
  find_package(GTest REQUIRED)
  find_package(benchmark REQUIRED)
endif()
