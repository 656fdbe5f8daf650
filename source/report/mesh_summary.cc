// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/mesh_summary.h"

#include "tetradapt/mesh/mesh_totals.h"
#include "tetradapt/mesh/quality.h"
#include "tetradapt/report/record_columns.h"

namespace tetradapt::report
{
  namespace
  {
    std::string
    number(const double value)
    {
      return format_number(value, 4);
    }

    std::string
    describe_point(const mesh::Point<3> &p)
    {
      return "(" + number(p[0]) + ", " + number(p[1]) + ", " + number(p[2]) + ")";
    }

    std::string
    shape_lines(const mesh::TetMesh &mesh)
    {
      const mesh::MeshQuality quality = mesh::mesh_quality(mesh);

      mesh::Point<3> worst;
      for (const unsigned int vertex : mesh.cells[quality.min_dihedral.worst_cell])
        worst += 0.25 * mesh.points[vertex];
      return "edges " + number(quality.shortest_edge) + " to " + number(quality.longest_edge)
             + ", dihedral angles " + number(quality.min_dihedral.min) + " (at "
             + describe_point(worst) + ") to " + number(quality.max_dihedral.max)
             + " degrees\nradius-edge ratio " + number(quality.radius_edge.mean) + " on average, "
             + number(quality.radius_edge.max) + " at most; longest edge over smallest height "
             + number(quality.aspect_ratio.mean) + " on average, "
             + number(quality.aspect_ratio.max) + " at most";
    }
  } // namespace

  std::string
  mesh_line(const mesh::TetMesh &mesh, const adapt::MeshRecord &record)
  {
    return std::to_string(mesh.n_points()) + " points, " + std::to_string(mesh.n_cells())
           + " tetrahedra, dihedral angles " + number(record.min_dihedral) + " to "
           + number(record.max_dihedral) + " degrees";
  }

  std::string
  mesh_summary(const mesh::TetMesh &mesh)
  {
    const mesh::MeshTotals totals = mesh::mesh_totals(mesh);
    const auto             box    = mesh::bounding_box(mesh);

    std::string text = std::to_string(totals.n_points) + " points, "
                       + std::to_string(totals.n_cells) + " tetrahedra, "
                       + std::to_string(totals.n_faces) + " boundary faces\nwithin "
                       + describe_point(box.first) + " and " + describe_point(box.second)
                       + ", volume " + number(totals.volume) + ", surface " + number(totals.area);
    for (const auto &[id, region] : totals.regions)
      text += "\nregion " + std::to_string(id)
              + (region.name.empty() ? "" : " (" + region.name + ")") + ": "
              + std::to_string(region.n_cells) + " tetrahedra, volume " + number(region.volume);
    for (unsigned int p = 0; p < totals.patches.size(); ++p)
      text += "\npatch " + std::to_string(p) + " with " + mesh::describe(totals.patches[p].patch)
              + ": " + std::to_string(totals.patches[p].n_faces) + " faces, area "
              + number(totals.patches[p].area);
    return text + "\n" + shape_lines(mesh);
  }
} // namespace tetradapt::report
