# cmake -DOUT=file.cpp -DFOLDER=shaders -DFILES="a.vert,b.frag" -P embed_shaders.cmake
# Writes a source file that holds the text of the shaders, so that the program needs no file of theirs.
string(REPLACE "," ";" files "${FILES}")
set(text "// Made by ui/render/embed_shaders.cmake from the folder shaders/.\n")
string(APPEND text "#include \"ui/render/internal/embedded_shaders.h\"\n\nnamespace millwright::render {\n\n")
string(APPEND text "std::string_view embedded_shader(std::string_view file) {\n")
foreach(file IN LISTS files)
    file(READ "${FOLDER}/${file}" source)
    string(APPEND text "    if (file == \"${file}\") {\n        return R\"glsl(${source})glsl\";\n    }\n")
endforeach()
string(APPEND text "    return {};\n}\n\n} // namespace millwright::render\n")
file(WRITE "${OUT}" "${text}")
