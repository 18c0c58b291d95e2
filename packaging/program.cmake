# Installs the program: with its completion, its examples and the documentation.
include(GNUInstallDirs)

install(TARGETS program COMPONENT program)
install(TARGETS poise_mesh poise_data LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/poise
  COMPONENT program)
set_target_properties(program PROPERTIES
  INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}/poise")
install(FILES ${PROJECT_BINARY_DIR}/completion.bash RENAME poise
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
  PATTERN "CMakeLists.txt" EXCLUDE)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
  FILES_MATCHING PATTERN "*.md" PATTERN "*.svg")
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
# The page of `poise view`, if ./dev web has built it.
install(FILES web/dist/playground.html DESTINATION ${CMAKE_INSTALL_DATADIR}/poise
  COMPONENT program OPTIONAL)
