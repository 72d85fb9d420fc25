# Uses ccache if it is installed.
#
# GCC's precompiled headers can be cached if ccache may ignore that macros (and __TIME__) of a precompiled header are
# not visible in the preprocessed source; the header itself is compared by its content. The user's settings of ccache
# are kept.
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
