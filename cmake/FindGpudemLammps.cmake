# LAMMPS' headers (from its sources, which alone are complete) and its installed library.
# Target GpudemLammps::lammps; variables GPUDEM_LAMMPS_VERSION (yyyymmdd), LAMMPS_SOURCE_ROOT.
set(LAMMPS_SOURCE_ROOT "${LAMMPS_SOURCE_DIR}")
if(LAMMPS_SOURCE_ROOT AND EXISTS "${LAMMPS_SOURCE_ROOT}/version.h")
  get_filename_component(LAMMPS_SOURCE_ROOT "${LAMMPS_SOURCE_ROOT}" DIRECTORY)
endif()
unset(GPUDEM_LAMMPS_INCLUDE CACHE)   # follows LAMMPS_SOURCE_DIR when that changes
find_path(GPUDEM_LAMMPS_INCLUDE version.h PATHS "${LAMMPS_SOURCE_ROOT}/src" NO_DEFAULT_PATH)
find_library(GPUDEM_LAMMPS_LIBRARY NAMES lammps liblammps.so.0)
find_program(GPUDEM_STOCK_LMP NAMES lmp)
if(NOT GPUDEM_LAMMPS_INCLUDE)
  message(FATAL_ERROR "LAMMPS' sources were not found: run scripts/setup, or set -D LAMMPS_SOURCE_DIR=/path/to/lammps "
                      "(the folder that holds src/version.h)")
endif()
if(NOT GPUDEM_LAMMPS_LIBRARY)
  message(FATAL_ERROR "liblammps was not found: install Debian's liblammps-dev, or set CMAKE_PREFIX_PATH")
endif()

# "29 Sep 2021" -> 20210929
file(STRINGS "${GPUDEM_LAMMPS_INCLUDE}/version.h" _lines REGEX "LAMMPS_VERSION")
string(REGEX MATCH "([0-9]+) ([A-Z][a-z][a-z])[a-z]* ([0-9]+)" _match "${_lines}")
set(_day ${CMAKE_MATCH_1})
set(_month_name ${CMAKE_MATCH_2})
set(_year ${CMAKE_MATCH_3})
set(_months Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec)
list(FIND _months "${_month_name}" _month)
if(_month LESS 0)
  message(FATAL_ERROR "cannot read the LAMMPS version from ${GPUDEM_LAMMPS_INCLUDE}/version.h: ${_lines}")
endif()
math(EXPR GPUDEM_LAMMPS_VERSION "${_year} * 10000 + (${_month} + 1) * 100 + ${_day}")
message(STATUS "GPUDEM: LAMMPS ${GPUDEM_LAMMPS_VERSION}, library ${GPUDEM_LAMMPS_LIBRARY}")

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(GpudemLammps REQUIRED_VARS GPUDEM_LAMMPS_INCLUDE GPUDEM_LAMMPS_LIBRARY)
if(NOT TARGET GpudemLammps::lammps)
  add_library(GpudemLammps::lammps INTERFACE IMPORTED)
  target_include_directories(GpudemLammps::lammps SYSTEM INTERFACE
    ${GPUDEM_LAMMPS_INCLUDE} ${GPUDEM_LAMMPS_INCLUDE}/GRANULAR)
  target_link_libraries(GpudemLammps::lammps INTERFACE ${GPUDEM_LAMMPS_LIBRARY})
  target_compile_definitions(GpudemLammps::lammps INTERFACE
    LAMMPS_SMALLBIG GPUDEM_LAMMPS_VERSION=${GPUDEM_LAMMPS_VERSION})
  # LAMMPS brings its own fmt, compiled into liblammps: the library's header-only setting would compile it again
  # here and, since the plugin is searched first, replace the one of liblammps
  target_compile_options(GpudemLammps::lammps INTERFACE -UFMT_HEADER_ONLY)
endif()
