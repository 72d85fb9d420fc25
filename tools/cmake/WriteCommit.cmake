# Writes the source that tells the commit: cmake -D SOURCE=FOLDER -D OUTPUT=FILE.cpp -P WriteCommit.cmake
#
# Sources without a repository of their own (an archive, also one that is unpacked within another repository) have the
# commit "unknown".
set(commit unknown)
find_program(git git)
if(git AND EXISTS ${SOURCE}/.git)
  # (No tag is looked for: tags would be written in place of the commit.)
  execute_process(COMMAND ${git} --no-optional-locks -C ${SOURCE} describe --always --abbrev=12 --exclude=* --dirty=-modified
                  OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
  if(status EQUAL 0)
    set(commit ${described})
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#include \"reduce/common/build.hpp\"

const char* bielle::commit() { return \"${commit}\"; }
")
