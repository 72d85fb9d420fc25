# Writes pages of explanations as a source: cmake -D PAGES=A.md;B.md -D OUTPUT=FILE.cpp -P WriteExplanations.cmake
set(text "#include \"reduce/common/explanations.hpp\"

std::vector<std::string_view> bielle::explanation_pages() {
  return {
")
foreach(page ${PAGES})
  file(READ ${page} content)
  string(APPEND text "R\"page(${content})page\",\n")
endforeach()
file(WRITE ${OUTPUT} "${text}  };\n}\n")
