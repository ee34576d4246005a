# cmake -DOUT=file.cpp -DHEADER=ui/render/internal/embedded_shaders.h -DSPACE=render -DFUNCTION=embedded_shader
#       -DFOLDER=shaders -DFILES="a.vert,b.frag" -P embed_texts.cmake
# Writes a source file that holds the text of the files, so that the program needs none of them.
string(REPLACE "," ";" files "${FILES}")
set(text "// Made by ui/embed_texts.cmake.\n#include \"${HEADER}\"\n\n")
string(APPEND text "namespace millwright::${SPACE} {\n\nstd::string_view ${FUNCTION}(std::string_view file) {\n")
foreach(file IN LISTS files)
    file(READ "${FOLDER}/${file}" source)
    string(APPEND text "    if (file == \"${file}\") {\n        return R\"embedded(${source})embedded\";\n    }\n")
endforeach()
string(APPEND text "    return {};\n}\n\n} // namespace millwright::${SPACE}\n")
file(WRITE "${OUT}" "${text}")
