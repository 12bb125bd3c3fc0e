#pragma once

#include "image/formats/code_rows.h"

namespace nusselt::image {

/// See read_coded_header(). \param file begins as a PNG file does
CodedHeader read_png_header(std::istream& file);

/// See decode_codes(). \param file its header was read
void decode_png(std::istream& file, CodeRows& rows);

} // namespace nusselt::image
