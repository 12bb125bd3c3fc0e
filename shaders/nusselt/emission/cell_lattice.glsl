#ifndef NUSSELT_EMISSION_CELL_LATTICE_GLSL
#define NUSSELT_EMISSION_CELL_LATTICE_GLSL
// Follows include/nusselt/emission/cell_lattice.h @ 2af571ead029
/// Projected solid angles of all cells of a lattice in the plane of a light. Twin of
/// include/nusselt/emission/cell_lattice.h, which explains the method. Cells are lanes there; here, one row is computed
/// after the other, so that the projected solid angles are the only array with a number per cell.

#include "../emission/term_line.glsl"
#include "../emission/textured_light.glsl"

/// Where a line of the lattice is, in texture coordinates.
float lattice_position(int i) { return float(i) * (1.0 / float(kNusseltCells)); }

/// The line along which the horizon cuts a lattice. It closes the cells that it cuts.
struct LatticeHorizon {
    float height;                 ///< of the corner (0, 0)
    vec2 slope;                   ///< rise along the sides of the texture
    float to_lowest, to_highest;  ///< rise in a cell
    vec2 begin, inverse;          ///< texture coordinates of position 0 of the line, reciprocals of its direction
    float len;                    ///< of a step [m]
    TermLine line;
};

/// \param plane that the horizon cuts between corners of the texture.
LatticeHorizon lattice_horizon_prepare(const TexturePlane plane, uint light) {
    const float least = 8.673617379884035e-19; // 2^-60
    LatticeHorizon self;
    vec2 rise = vec2(plane.side_x.z, plane.side_y.z);
    self.height = plane.corner.z;
    self.slope = rise;
    self.to_lowest = (nusselt_min(rise.x, 0.0) + nusselt_min(rise.y, 0.0)) * (1.0 / float(kNusseltCells));
    self.to_highest = (nusselt_max(rise.x, 0.0) + nusselt_max(rise.y, 0.0)) * (1.0 / float(kNusseltCells));

    // A point of the line and its direction, in texture coordinates. Upwards is on its left.
    float scale = 1.0 / nusselt_max(nusselt_max(abs(rise.x), abs(rise.y)), kNusseltTiny);
    vec2 direction = vec2(scale * rise.y, -scale * rise.x);
    bool across = abs(rise.x) > abs(rise.y);
    float steepest = across ? rise.x : rise.y;
    float middle = -(self.height + 0.5 * (across ? rise.y : rise.x)) / (steepest != 0.0 ? steepest : 1.0);
    self.begin = across ? vec2(middle, 0.5) : vec2(0.5, middle);
    self.inverse = vec2(1.0 / copysign(nusselt_max(abs(direction.x), least), direction.x),
                        1.0 / copysign(nusselt_max(abs(direction.y), least), direction.y));

    // The part inside of the outline.
    float from = -4.0;
    float to = 4.0;
    int count = textured_light_vertices(light);
    for (int k = 0; k < count; ++k) {
        vec2 vertex = textured_light_vertex(light, k);
        vec2 along = textured_light_end_of(light, k) - vertex;
        float inside = det(along, self.begin - vertex);
        float slope = det(along, direction);
        if (slope > 0.0) {
            from = nusselt_max(from, -inside / slope);
        } else if (slope < 0.0) {
            to = nusselt_min(to, -inside / slope);
        } else if (inside < 0.0) {
            to = from;
        }
    }
    vec3 q = texture_plane_point_at(plane, self.begin);
    vec3 in_space = texture_plane_offset_of(plane, direction);
    self.len = sqrt(dot(in_space.xy, in_space.xy));
    float inverse = self.len > 0.0 ? 1.0 / self.len : 0.0;
    self.line = make_term_line(vec3(q.xy, 0.0), vec3(inverse * in_space.xy, 0.0), self.len * from,
                               self.len * nusselt_max(from, to));
    return self;
}

/// Height of the corner of a cell with the least texture coordinates.
float lattice_horizon_height(const LatticeHorizon self, int column, int row) {
    return nusselt_fma(lattice_position(column), self.slope.x, self.height + lattice_position(row) * self.slope.y);
}

/// Whether some part of a cell is above the horizon.
bool lattice_horizon_reaches_above(const LatticeHorizon self, int column, int row) {
    return lattice_horizon_height(self, column, row) > -self.to_highest;
}

/// The term of the side of a cell along the horizon; 0 if the horizon does not cut the cell.
float lattice_horizon_term(const LatticeHorizon self, int column, int row) {
    float z = lattice_horizon_height(self, column, row);
    if (!(z < -self.to_lowest && z > -self.to_highest)) return 0.0;
    float left = (lattice_position(column) - self.begin.x) * self.inverse.x;
    float right = (lattice_position(column + 1) - self.begin.x) * self.inverse.x;
    float bottom = (lattice_position(row) - self.begin.y) * self.inverse.y;
    float top = (lattice_position(row + 1) - self.begin.y) * self.inverse.y;
    float from = nusselt_max(nusselt_min(left, right), nusselt_min(bottom, top));
    float to = nusselt_max(nusselt_min(nusselt_max(left, right), nusselt_max(bottom, top)), from);
    return term_line_term(self.line, self.len * from, self.len * to);
}

struct CellLattice {
    TexturePlane plane;
    uint light; ///< first word
    float length_x, length_y;
    vec3 direction_x, direction_y;
    float signed_distance; ///< of the plane from the origin [m], as plane_distance(); 0 if nothing can be seen
    float lowest, highest; ///< z of corners
};

/// \param plane of the light in shading space, or in the cosine space of a lobe, with coordinates of order one.
/// \param light first word.
CellLattice cell_lattice_prepare(const TexturePlane plane, uint light) {
    CellLattice self;
    self.plane = plane;
    self.light = light;
    self.length_x = nusselt_length(plane.side_x);
    self.length_y = nusselt_length(plane.side_y);
    self.direction_x = nusselt_normalize(plane.side_x);
    self.direction_y = nusselt_normalize(plane.side_y);
    // The triple product of the corner and the sides tells which way around the sides of cells go.
    self.signed_distance = plane_distance(texture_plane_outline(plane));
    vec4 height = vec4(plane.corner.z, texture_plane_point_at(plane, vec2(1.0, 0.0)).z,
                       texture_plane_point_at(plane, vec2(1.0)).z, texture_plane_point_at(plane, vec2(0.0, 1.0)).z);
    self.lowest = nusselt_min(nusselt_min(height.x, height.y), nusselt_min(height.z, height.w));
    self.highest = nusselt_max(nusselt_max(height.x, height.y), nusselt_max(height.z, height.w));
    return self;
}

/// Line i of those along y. Positions on it begin at its lowest texture coordinate.
TermLine cell_lattice_column_line(const CellLattice self, int i) {
    vec2 chord = self.length_y * textured_light_column_line(self.light, i);
    vec3 q = nusselt_fma(lattice_position(i), self.plane.side_x, self.plane.corner);
    return make_term_line(q, self.direction_y, chord.x, chord.y);
}

/// Line j of those along x.
TermLine cell_lattice_row_line(const CellLattice self, int j) {
    vec2 chord = self.length_x * textured_light_row_line(self.light, j);
    vec3 q = nusselt_fma(lattice_position(j), self.plane.side_y, self.plane.corner);
    return make_term_line(q, self.direction_x, chord.x, chord.y);
}

/// The Taylor series of the cosine around the centre up to the second order, and the mean height over the corners and the
/// centre for cells that the horizon cuts.
void cell_lattice_find_far_angles(const CellLattice self, inout float angle[kNusseltCells * kNusseltCells]) {
    const float s = 1.0 / float(kNusseltCells);
    vec2 rise = 0.5 * s * vec2(self.plane.side_x.z, self.plane.side_y.z);
    float area = abs(self.signed_distance) * s * s *
                 nusselt_length(nusselt_cross(self.direction_x, self.direction_y)) * self.length_x * self.length_y;
    vec3 a = s * self.plane.side_x; // sides of a cell
    vec3 b = s * self.plane.side_y;
    float spread = 1.0 / 6.0 * (dot(a, a) + dot(b, b));
    for (int cell = 0; cell < kNusseltCells * kNusseltCells; ++cell) {
        vec2 middle = s * (vec2(cell % kNusseltCells, cell / kNusseltCells) + 0.5);
        vec3 p = texture_plane_point_at(self.plane, middle);
        float inverse = 1.0 / dot(p, p);
        float corners = (nusselt_max(p.z + (rise.x + rise.y), 0.0) + nusselt_max(p.z + (rise.x - rise.y), 0.0)) +
                        (nusselt_max(p.z + (rise.y - rise.x), 0.0) + nusselt_max(p.z + (-rise.x - rise.y), 0.0));
        float height = 2.0 / 3.0 * nusselt_max(p.z, 0.0) + 1.0 / 12.0 * corners;
        vec2 along = vec2(dot(p, a), dot(p, b));
        float growth = nusselt_fma(inverse, dot(along, along) * inverse - spread, 1.0);
        float fall = (a.z * along.x + b.z * along.y) * (inverse * (1.0 / 3.0));
        // Where the horizon cuts a cell, the series is wrong.
        float mean = nusselt_min(nusselt_max(height * growth - fall, 0.5 * height), 2.0 * height);
        angle[cell] = (area * textured_light_cover(self.light, cell)) * (mean * inverse) * inverse;
    }
}

/// Terms of the pieces of the outline.
void cell_lattice_add_outline(const CellLattice self, inout float angle[kNusseltCells * kNusseltCells]) {
    int pieces = textured_light_pieces(self.light);
    int edge = -1;
    TermLine along = TermLine(0.0, 0.0, 0.0, 0.0, 0.0);
    float edge_length = 0.0;
    for (int k = 0; k < pieces; ++k) {
        OutlinePiece piece = textured_light_piece(self.light, k);
        if (piece.edge != edge) {
            edge = piece.edge;
            vec2 begin = textured_light_vertex(self.light, edge);
            vec3 offset = texture_plane_offset_of(self.plane, textured_light_end_of(self.light, edge) - begin);
            edge_length = nusselt_length(offset);
            along =
                make_term_line(texture_plane_point_at(self.plane, begin), nusselt_normalize(offset), 0.0, edge_length);
        }
        angle[piece.cell] = angle[piece.cell] +
                            term_line_term(along, edge_length * piece.interval.x, edge_length * piece.interval.y);
    }
}

/// \param angle zeros.
void cell_lattice_find_near_angles(const CellLattice self, inout float angle[kNusseltCells * kNusseltCells]) {
    cell_lattice_add_outline(self, angle);
    TermLine columns[kNusseltCells + 1];
    NUSSELT_UNROLL for (int i = 0; i <= kNusseltCells; ++i) columns[i] = cell_lattice_column_line(self, i);
    bool cut = !(self.lowest >= 0.0);
    LatticeHorizon horizon;
    if (cut) horizon = lattice_horizon_prepare(self.plane, self.light);
    float side = copysign(1.0, self.signed_distance);

    float step_x = self.length_x * (1.0 / float(kNusseltCells));
    float below[kNusseltCells]; // terms of the sides between the last row and the next one
    TermLine line = cell_lattice_row_line(self, 0);
    NUSSELT_UNROLL for (int i = 0; i < kNusseltCells; ++i)
        below[i] = term_line_term(line, step_x * float(i), step_x * float(i + 1));
    for (int row = 0; row < kNusseltCells; ++row) {
        float from = self.length_y * lattice_position(row);
        float to = self.length_y * lattice_position(row + 1);
        line = cell_lattice_row_line(self, row + 1);
        float left = term_line_term(columns[0], from, to);
        NUSSELT_UNROLL for (int column = 0; column < kNusseltCells; ++column) {
            int cell = row * kNusseltCells + column;
            float right = term_line_term(columns[column + 1], from, to);
            float bottom = below[column];
            float top = term_line_term(line, step_x * float(column), step_x * float(column + 1));
            float sum = (right - left) - (top - bottom) + angle[cell];
            if (cut) sum = sum + lattice_horizon_term(horizon, column, row);
            float least = (8.0 * kNusseltEpsilon) * ((abs(left) + abs(right)) + (abs(bottom) + abs(top)));
            angle[cell] = 0.5 * nusselt_max(side * sum, least);
            if (cut && !lattice_horizon_reaches_above(horizon, column, row)) angle[cell] = 0.0;
            left = right;
            below[column] = top;
        }
    }
}

/// Projected solid angles [sr] of the parts of all cells that are above the horizon and inside of the light. They are
/// never zero where the light is: at least as large as their rounding errors.
/// \param angle 8 x 8 of them, in the order of cells: cell (i, j) has the index 8 j + i.
void cell_lattice_find_angles(const CellLattice self, out float angle[kNusseltCells * kNusseltCells]) {
    const float far = 1.0 / 16.0; // kFarIfCut of C++ for float; kFar is 1
    for (int cell = 0; cell < kNusseltCells * kNusseltCells; ++cell) angle[cell] = 0.0;
    if (self.signed_distance == 0.0 || !(self.highest > 0.0)) return;
    vec3 centre = texture_plane_point_at(self.plane, vec2(0.5));
    float size = self.length_x + self.length_y;
    float squared = dot(centre, centre);
    bool is_cut = textured_light_pieces(self.light) > 0 || !(self.lowest >= 0.0);
    if (size * size < (is_cut ? far * far : 1.0) * squared) {
        cell_lattice_find_far_angles(self, angle);
    } else {
        cell_lattice_find_near_angles(self, angle);
    }
}

#endif
