#pragma once

#include "image/formats/code_rows.h"

namespace nusselt::image {

/// Whether the header makes sense. There is no mark to recognise these files by.
bool is_tga(std::string_view file);

/// See read_coded_header(). \param file is_tga()
CodedHeader read_tga_header(std::string_view file);

/// See decode_codes(). \param file its header was read
void decode_tga(std::string_view file, CodeRows& rows);

} // namespace nusselt::image
