# What Debian's emscripten lacks. Its headers must not be shadowed by those of /usr/include, so the
# header-only libraries are linked, one by one, into a folder of their own.
set(headers ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${headers})
file(CREATE_LINK /usr/include/eigen3/Eigen ${headers}/Eigen SYMBOLIC)
file(CREATE_LINK /usr/include/nlohmann ${headers}/nlohmann SYMBOLIC)
file(CREATE_LINK /usr/include/rapidcheck.h ${headers}/rapidcheck.h SYMBOLIC)
file(CREATE_LINK /usr/include/rapidcheck ${headers}/rapidcheck SYMBOLIC)

foreach(name Eigen3::Eigen nlohmann_json::nlohmann_json)
  add_library(${name} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${name} SYSTEM INTERFACE ${headers})
endforeach()

add_compile_options(-fexceptions)
add_link_options(-fexceptions)
