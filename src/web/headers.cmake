# The libraries of the page consist of headers only. Links to them in a folder of the build, because the folder of the
# system has the headers of another C library, too.
set(headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(header boost/version.hpp fmt/format.h nlohmann/json.hpp toml++/toml.h xsimd/xsimd.hpp xxhash.h)
  string(REGEX MATCH "^[^/]+" name ${header})
  find_path(folder_of_${name} ${header} PATHS /usr/include NO_CMAKE_FIND_ROOT_PATH)
  if(NOT folder_of_${name})
    message(FATAL_ERROR "${header} was not found. On Debian: tools/install_dependencies web")
  endif()
  file(CREATE_LINK ${folder_of_${name}}/${name} ${headers}/${name} SYMBOLIC)
endforeach()

add_library(overturn_headers_of_web INTERFACE)
target_include_directories(overturn_headers_of_web SYSTEM INTERFACE ${CMAKE_CURRENT_LIST_DIR}/headers ${headers})
target_compile_definitions(overturn_headers_of_web INTERFACE FMT_HEADER_ONLY TOML_HEADER_ONLY=0 XXH_INLINE_ALL
                           BOOST_DISABLE_THREADS _LIBCPP_ENABLE_CXX17_REMOVED_UNARY_BINARY_FUNCTION)
foreach(library Boost::headers fmt::fmt nlohmann_json::nlohmann_json tomlplusplus::tomlplusplus xsimd PkgConfig::xxhash)
  add_library(${library} INTERFACE IMPORTED GLOBAL)
  target_link_libraries(${library} INTERFACE overturn_headers_of_web)
endforeach()
set(Boost_FOUND TRUE)
set(fmt_FOUND TRUE)
set(xsimd_FOUND TRUE)
