# ccache, where there is one.
#
# GCC's precompiled headers are cached when ccache may overlook that macros (and __TIME__) of a precompiled header are not
# seen in the preprocessed source; the header itself is compared by its content. What the user lets it overlook stays.
find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
  if(BIELLE_PRECOMPILE)
    execute_process(COMMAND ${CCACHE} --get-config sloppiness OUTPUT_VARIABLE sloppiness ERROR_QUIET)
    string(REGEX MATCHALL "[a-z_]+" sloppiness "${sloppiness}")
    list(APPEND sloppiness pch_defines time_macros)
    list(REMOVE_DUPLICATES sloppiness)
    list(JOIN sloppiness "," sloppiness)
    set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=${sloppiness} ${CCACHE})
  endif()
endif()
