// SPDX-License-Identifier: AGPL-3.0-or-later
#include "faces.h"

#include <deal.II/base/numbers.h>

#include <algorithm>

namespace tetradapt::estimate
{
  CellFaces::CellFaces(const mesh::TetMesh &mesh) : sides(mesh.n_cells())
  {
    const mesh::FaceTable table(mesh);
    const unsigned int    first_listed = 4 * mesh.n_cells();
    boundary.reserve(2 * mesh.n_cells() + mesh.faces.size() / 2);
    table.for_each_triangle(
      [&](const mesh::FaceTable::Entry *first, const mesh::FaceTable::Entry *last) {
        unsigned int listed = dealii::numbers::invalid_unsigned_int;
        const auto   corner = [&](const unsigned int slot, const unsigned int s) {
          return mesh.cells[slot / 4][mesh::face_vertices[slot % 4][s]];
        };
        for (const auto *entry = first; entry != last; ++entry)
          if (entry->slot >= first_listed)
            listed = entry->slot - first_listed;
          else
            {
              Side &side  = sides[entry->slot / 4][entry->slot % 4];
              side.face   = n_faces;
              side.second = entry != first;
              for (unsigned int s = 0; s < 3; ++s)
                for (unsigned int r = 0; r < 3; ++r)
                  if (corner(entry->slot, s) == corner(first->slot, r))
                    side.corner[s] = r;
            }
        boundary.push_back(listed);
        ++n_faces;
      });
  }
} // namespace tetradapt::estimate
