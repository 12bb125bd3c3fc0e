# cmake -D INPUT=file -D OUTPUT=name.h -D ARRAY=kName -D SYMBOL=symbol -D TYPE=type -P embedded_shader.cmake: declares the
# contents of a file that the assembler embeds at a symbol, as an array of namespace nusselt::shaders. TYPE is
# std::uint32_t for SPIR-V, else unsigned char.
file(SIZE ${INPUT} size)
if(TYPE STREQUAL "std::uint32_t")
    math(EXPR size "${size} / 4")
endif()
file(WRITE ${OUTPUT} "#pragma once\n#include <cstdint>\n\nnamespace nusselt::shaders {\n\nextern const ${TYPE} ${ARRAY}[${size}] asm(\"${SYMBOL}\");\n\n} // namespace nusselt::shaders\n")
