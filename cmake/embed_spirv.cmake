# cmake -D INPUT=name.spv -D OUTPUT=name.h -D ARRAY=kName -P embed_spirv.cmake: writes the words of a SPIR-V file as
# a C++ array of namespace nusselt::shaders.
file(READ ${INPUT} bytes HEX)
# Words are stored with the least significant byte first.
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
# Compilers keep less track of files with very many lines.
string(REPEAT "[^,]+," 8 line)
string(REGEX REPLACE "(${line})" "\\1\n" words "${words}")
file(WRITE ${OUTPUT} "#pragma once\n#include <cstdint>\n\nnamespace nusselt::shaders {\n\ninline constexpr std::uint32_t ${ARRAY}[] = {\n${words}\n};\n\n} // namespace nusselt::shaders\n")
