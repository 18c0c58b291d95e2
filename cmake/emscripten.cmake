# What Debian's emscripten lacks. Its headers must not be shadowed by those of /usr/include, so the
# header-only libraries are linked, one by one, into a folder of their own.
set(headers ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${headers})
file(CREATE_LINK /usr/include/eigen3/Eigen ${headers}/Eigen SYMBOLIC)
file(CREATE_LINK /usr/include/nlohmann ${headers}/nlohmann SYMBOLIC)

foreach(name Eigen3::Eigen nlohmann_json::nlohmann_json)
  add_library(${name} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${name} SYSTEM INTERFACE ${headers})
endforeach()

add_compile_options(-fwasm-exceptions)
add_link_options(-fwasm-exceptions)

# Debian compiles yaml-cpp for the machine alone; ./dev web gets its source.
set(POISE_YAML_CPP ${PROJECT_SOURCE_DIR}/build/yaml-cpp CACHE PATH "The source of yaml-cpp 0.7")
file(GLOB yaml_cpp ${POISE_YAML_CPP}/src/*.cpp)
if(NOT yaml_cpp)
  message(FATAL_ERROR "No source of yaml-cpp in ${POISE_YAML_CPP}: use ./dev web, or name its folder "
    "with -DPOISE_YAML_CPP=")
endif()
add_library(yaml-cpp STATIC ${yaml_cpp})
target_include_directories(yaml-cpp SYSTEM PUBLIC ${POISE_YAML_CPP}/include)
