// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/finalize.h"

#include "tetradapt/core/exceptions.h"

#include <algorithm>

namespace tetradapt::mesh
{
  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;



    std::string
    describe_triangle(const TetMesh &mesh, const std::array<unsigned int, 3> &vertices)
    {
      return "the triangle " + to_string(mesh.points[vertices[0]]) + ", "
             + to_string(mesh.points[vertices[1]]) + ", " + to_string(mesh.points[vertices[2]]);
    }



    /** Whether going from a to b to c is an even permutation of sorted order. */
    bool
    even(const unsigned int a, const unsigned int b, const unsigned int c)
    {
      return (a < b) == ((b < c) == (a < c));
    }



    /** Outward vertices of face @p slot % 4 of cell @p slot / 4. */
    std::array<unsigned int, 3>
    outward_face(const TetMesh &mesh, const unsigned int slot)
    {
      const auto &cell = mesh.cells[slot / 4];
      const auto &face = face_vertices[slot % 4];
      return {{cell[face[0]], cell[face[1]], cell[face[2]]}};
    }



    /** What is to become of a listed face, found while triangles are compared. */
    struct ListedFaces
    {
      std::vector<unsigned int> boundary_slot; ///< per listed face: its cell face, or none
      std::vector<unsigned int> missing;       ///< cell faces on the boundary, not listed
    };



    /** Looks at one triangle, its cells and the listed faces equal to it. */
    void
    check_triangle(const TetMesh          &mesh,
                   const std::string      &what,
                   const FaceTable::Entry *first,
                   const FaceTable::Entry *last,
                   ListedFaces            &listed,
                   FinalizeReport         &report)
    {
      const unsigned int n_slots = 4 * mesh.n_cells();
      unsigned int       n_cells = 0;
      while (first + n_cells < last && first[n_cells].slot < n_slots)
        ++n_cells;
      const FaceTable::Entry *first_listed = first + n_cells;

      if (n_cells == 0)
        {
          const unsigned int f = first->slot - n_slots;
          throw core::InputError(what + ": boundary triangle " + std::to_string(f) + ", "
                                 + describe_triangle(mesh, mesh.faces[f].vertices)
                                 + ", is not a face of any tetrahedron. Remove it, or write the "
                                   "tetrahedra that it bounds.");
        }
      if (n_cells > 2)
        throw core::InputError(
          what + ": " + describe_triangle(mesh, outward_face(mesh, first->slot)) + " belongs to "
          + std::to_string(n_cells) + " tetrahedra, the first three being "
          + std::to_string(first[0].slot / 4) + ", " + std::to_string(first[1].slot / 4) + " and "
          + std::to_string(first[2].slot / 4) + " (counted from 0). Remove the ones that overlap.");
      if (n_cells == 2)
        {
          const auto a = outward_face(mesh, first[0].slot);
          const auto b = outward_face(mesh, first[1].slot);
          if (even(a[0], a[1], a[2]) == even(b[0], b[1], b[2]))
            throw core::InputError(what + ": tetrahedra " + std::to_string(first[0].slot / 4)
                                   + " and " + std::to_string(first[1].slot / 4)
                                   + " (counted from 0) overlap: both lie on the same side of "
                                   + describe_triangle(mesh, a) + ". Remove one of them.");
          report.dropped_interior_faces += last - first_listed;
          return;
        }

      if (first_listed == last)
        listed.missing.push_back(first->slot);
      else
        listed.boundary_slot[first_listed->slot - n_slots] = first->slot;
      for (const FaceTable::Entry *other = first_listed + 1; other < last; ++other)
        {
          const Patch &a = mesh.patches[mesh.faces[first_listed->slot - n_slots].patch];
          const Patch &b = mesh.patches[mesh.faces[other->slot - n_slots].patch];
          if (a.boundary_id != b.boundary_id || a.name != b.name || a.selections != b.selections)
            throw core::InputError(
              what + ": " + describe_triangle(mesh, outward_face(mesh, first->slot))
              + " is listed twice, with boundary id " + std::to_string(a.boundary_id)
              + (a.name.empty() ? "" : " (" + a.name + ")") + " and with "
              + std::to_string(b.boundary_id) + (b.name.empty() ? "" : " (" + b.name + ")")
              + ". Put each triangle into one group.");
          ++report.dropped_repeated_faces;
        }
    }



    /** Makes mesh.faces the boundary, each triangle once and turned outwards. */
    void
    rebuild_faces(TetMesh &mesh, ListedFaces &listed, FinalizeReport &report)
    {
      std::vector<BoundaryFace> faces;
      faces.reserve(mesh.faces.size() + listed.missing.size());
      for (unsigned int f = 0; f < mesh.faces.size(); ++f)
        if (const unsigned int slot = listed.boundary_slot[f]; slot != none)
          {
            BoundaryFace face    = mesh.faces[f];
            const auto   outward = outward_face(mesh, slot);
            const auto  &v       = face.vertices;
            if (even(v[0], v[1], v[2]) != even(outward[0], outward[1], outward[2]))
              std::swap(face.vertices[1], face.vertices[2]);
            faces.push_back(face);
          }

      if (!listed.missing.empty())
        {
          const auto unnamed
            = std::find_if(mesh.patches.begin(), mesh.patches.end(), [](const Patch &patch) {
                return patch.boundary_id == 0 && patch.name.empty() && patch.selections.empty();
              });
          unsigned int patch = unnamed - mesh.patches.begin();
          if (unnamed == mesh.patches.end())
            mesh.patches.emplace_back();
          std::sort(listed.missing.begin(), listed.missing.end());
          for (const unsigned int slot : listed.missing)
            faces.push_back({outward_face(mesh, slot), patch});
        }
      report.added_faces = listed.missing.size();
      mesh.faces         = std::move(faces);
    }
  } // namespace



  void
  complete_boundary(TetMesh &mesh, const std::string &what, FinalizeReport &report)
  {
    ListedFaces listed;
    listed.boundary_slot.assign(mesh.faces.size(), none);
    const FaceTable table(mesh);
    table.for_each_triangle([&](const FaceTable::Entry *first, const FaceTable::Entry *last) {
      check_triangle(mesh, what, first, last, listed, report);
    });
    rebuild_faces(mesh, listed, report);
  }
} // namespace tetradapt::mesh
