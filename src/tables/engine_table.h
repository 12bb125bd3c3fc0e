#pragma once
/// A small table for engines.

#include "tables/ltc_table.h"

namespace nusselt::tables {

/// A table of one lobe for all f0 in half floats: for each roughness and, innermost, inclination (both as in
/// LtcTableView) the numbers 1024 m00 / m11, 1024 m20 / m11, 1024 m02 / m11, 1024 m22 / m11 of cosine_from_shading,
/// then scale and bias of the albedo f0 scale + bias. A matrix means the same after multiplication by any number: with
/// 1024 for m11, entries of narrow lobes keep away from the smallest half float.
///
/// 64 x 64 samples take 48 KiB. \param f0 whose lobe it is, the nearest one of the table.
std::string encode_for_engines(const LtcTable& table, float f0);

/// The table that an engine reconstructs, with two samples of f0.
/// \throws std::runtime_error naming the source if its length is not that of such numbers of samples
LtcTable decode_for_engines(std::string_view bytes, int roughnesses, int inclinations,
                            const std::string& name);

} // namespace nusselt::tables
