# Everything comes from Debian 12; nothing is fetched while configuring.
find_package(Threads REQUIRED)
find_package(OpenSSL 3 REQUIRED COMPONENTS Crypto)
find_package(fmt REQUIRED)
find_package(JPEG REQUIRED)
find_package(pugixml REQUIRED)
find_package(xsimd REQUIRED)
find_package(ZLIB REQUIRED)
# Debian's target asks to link `-lxtl`, a header-only library that only complex numbers
# need and that the package does not bring.
set_target_properties(xsimd PROPERTIES INTERFACE_LINK_LIBRARIES "")

# LLVM as one shared library: its own CMake package lists static components,
# and all we need is a header folder and libLLVM.so.
find_package(LLVM 19.1 REQUIRED CONFIG HINTS /usr/lib/llvm-19/lib/cmake/llvm)
add_library(nacre_llvm INTERFACE)
target_include_directories(nacre_llvm SYSTEM INTERFACE ${LLVM_INCLUDE_DIRS})
target_compile_definitions(nacre_llvm INTERFACE ${LLVM_DEFINITIONS})
find_library(NACRE_LLVM_LIBRARY NAMES LLVM-19 LLVM HINTS ${LLVM_LIBRARY_DIRS} REQUIRED)
target_link_libraries(nacre_llvm INTERFACE ${NACRE_LLVM_LIBRARY})

# Debian's OpenImageIO package configuration names OpenCV's include folder,
# which is not installed with it; so we name header and libraries ourselves.
if(NACRE_WITH_OPENIMAGEIO)
  find_path(NACRE_OIIO_INCLUDE OpenImageIO/imageio.h REQUIRED)
  find_library(NACRE_OIIO_LIBRARY OpenImageIO REQUIRED)
  find_library(NACRE_OIIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)
  add_library(nacre_oiio INTERFACE)
  target_include_directories(nacre_oiio SYSTEM INTERFACE
    ${NACRE_OIIO_INCLUDE} ${NACRE_OIIO_INCLUDE}/Imath)
  target_link_libraries(nacre_oiio INTERFACE ${NACRE_OIIO_LIBRARY} ${NACRE_OIIO_UTIL_LIBRARY})
endif()

# Debian's OpenColorIO package has no CMake configuration.
if(NACRE_WITH_OPENCOLORIO)
  find_path(NACRE_OCIO_INCLUDE OpenColorIO/OpenColorIO.h REQUIRED)
  find_library(NACRE_OCIO_LIBRARY OpenColorIO REQUIRED)
  add_library(nacre_opencolorio INTERFACE)
  target_include_directories(nacre_opencolorio SYSTEM INTERFACE ${NACRE_OCIO_INCLUDE})
  target_link_libraries(nacre_opencolorio INTERFACE ${NACRE_OCIO_LIBRARY})
endif()

if(NACRE_BUILD_TESTS)
  find_package(GTest REQUIRED)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  include(GoogleTest)
endif()
if(NACRE_BUILD_BENCH)
  find_package(benchmark REQUIRED)
endif()
if(NACRE_BUILD_EXAMPLES)
  find_package(nlohmann_json REQUIRED)
  find_package(CLI11 REQUIRED)
  find_package(draco REQUIRED)
  find_package(embree 3 REQUIRED)
  find_package(meshoptimizer REQUIRED)
  # Debian's libdeflate has no CMake configuration.
  find_path(NACRE_LIBDEFLATE_INCLUDE libdeflate.h REQUIRED)
  find_library(NACRE_LIBDEFLATE_LIBRARY deflate REQUIRED)
  add_library(nacre_libdeflate INTERFACE)
  target_include_directories(nacre_libdeflate SYSTEM INTERFACE ${NACRE_LIBDEFLATE_INCLUDE})
  target_link_libraries(nacre_libdeflate INTERFACE ${NACRE_LIBDEFLATE_LIBRARY})
endif()
