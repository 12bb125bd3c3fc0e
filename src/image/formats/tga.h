#pragma once

#include "image/formats/code_rows.h"

namespace nusselt::image {

/// See read_coded_header(). There is no mark to recognise these files by.
/// \throws std::runtime_error  also if the header of the file, which is neither PNG nor JPG nor BMP, is not that of TGA
CodedHeader read_tga_header(std::istream& file);

/// See decode_codes(). \param file its header was read
void decode_tga(std::istream& file, CodeRows& rows);

} // namespace nusselt::image
