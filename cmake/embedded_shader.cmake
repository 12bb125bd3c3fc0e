# cmake -D INPUT=file -D OUTPUT=name.h -D ARRAY=kName -D SYMBOL=symbol -P embedded_shader.cmake: declares the words of a
# SPIR-V file that the assembler embeds at a symbol, as an array of namespace nusselt::shaders.
file(SIZE ${INPUT} size)
math(EXPR size "${size} / 4")
file(WRITE ${OUTPUT} "#pragma once\n#include <cstdint>\n\nnamespace nusselt::shaders {\n\nextern const std::uint32_t ${ARRAY}[${size}] asm(\"${SYMBOL}\");\n\n} // namespace nusselt::shaders\n")
