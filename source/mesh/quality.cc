// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/quality.h"

#include "tetradapt/mesh/edges.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::mesh
{
  CellQuality
  cell_quality(const TetMesh &mesh, const unsigned int cell)
  {
    const auto  &v = mesh.cells[cell];
    Tensor<1, 3> edges[6];
    double       squares[6];
    for (unsigned int e = 0; e < 6; ++e)
      {
        edges[e]   = mesh.points[v[edge_vertices[e][1]]] - mesh.points[v[edge_vertices[e][0]]];
        squares[e] = edges[e].norm_square();
      }

    // Area vectors of the faces opposite the vertices; all point outwards or,
    // in a negative cell, all inwards: their mutual angles are the same.
    const Tensor<1, 3> a        = edges[0];
    const Tensor<1, 3> b        = -edges[2];
    const Tensor<1, 3> c        = edges[3];
    const Tensor<1, 3> twice_bc = dealii::cross_product_3d(b, c);
    const Tensor<1, 3> normals[4]{dealii::cross_product_3d(edges[1], edges[4]),
                                  -twice_bc,
                                  -dealii::cross_product_3d(c, a),
                                  -dealii::cross_product_3d(a, b)};
    const double       six_volumes = std::abs(a * twice_bc);
    double             areas[4]; // twice the areas
    for (unsigned int i = 0; i < 4; ++i)
      areas[i] = normals[i].norm();

    CellQuality quality;
    double      largest_cosine = -1., smallest_cosine = 1.;
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < i; ++j)
        {
          const double cosine = -(normals[i] * normals[j]) / (areas[i] * areas[j]);
          largest_cosine      = std::max(largest_cosine, cosine);
          smallest_cosine     = std::min(smallest_cosine, cosine);
        }
    quality.min_dihedral = std::acos(std::min(1., largest_cosine)) * 180. / dealii::numbers::PI;
    quality.max_dihedral = std::acos(std::max(-1., smallest_cosine)) * 180. / dealii::numbers::PI;

    quality.shortest_edge   = std::sqrt(*std::min_element(squares, squares + 6));
    quality.longest_edge    = std::sqrt(*std::max_element(squares, squares + 6));
    quality.smallest_height = six_volumes / *std::max_element(areas, areas + 4);
    quality.aspect_ratio    = quality.longest_edge / quality.smallest_height;

    // Centre of the circumscribed sphere, seen from vertex 0:
    // (|a|^2 b x c + |b|^2 c x a + |c|^2 a x b) / (2 a . b x c).
    const Tensor<1, 3> numerator
      = squares[0] * normals[1] + squares[2] * normals[2] + squares[3] * normals[3];
    const double circumradius = numerator.norm() / (2. * six_volumes);
    const double inradius     = six_volumes / (areas[0] + areas[1] + areas[2] + areas[3]);
    quality.radius_edge       = circumradius / quality.shortest_edge;
    quality.radius_ratio      = circumradius / (3. * inradius);
    return quality;
  }



  void
  Histogram::add(const double value)
  {
    const double n     = counts.size();
    const double place = std::floor((value - lower) / (upper - lower) * n);
    ++counts[static_cast<std::size_t>(std::min(std::max(place, 0.), n - 1.))];
  }



  namespace
  {
    /** Takes the value of one cell into a range. */
    void
    add(QualityRange &range, const double value, const unsigned int cell, const bool small_is_bad)
    {
      if (cell == 0)
        range.min = range.max = value;
      if (small_is_bad ? value < range.min : value > range.max)
        range.worst_cell = cell;
      range.min = std::min(range.min, value);
      range.max = std::max(range.max, value);
      range.mean += value;
    }
  } // namespace



  MeshQuality
  mesh_quality(const TetMesh &mesh)
  {
    MeshQuality quality;
    quality.min_dihedral_histogram = {0., 180., std::vector<unsigned int>(36, 0)};
    quality.max_dihedral_histogram = quality.min_dihedral_histogram;
    quality.aspect_ratio_histogram = {1., 11., std::vector<unsigned int>(20, 0)};
    quality.radius_ratio_histogram = quality.aspect_ratio_histogram;

    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const CellQuality cell = cell_quality(mesh, c);
        add(quality.min_dihedral, cell.min_dihedral, c, true);
        add(quality.max_dihedral, cell.max_dihedral, c, false);
        add(quality.radius_edge, cell.radius_edge, c, false);
        add(quality.aspect_ratio, cell.aspect_ratio, c, false);
        add(quality.radius_ratio, cell.radius_ratio, c, false);
        quality.min_dihedral_histogram.add(cell.min_dihedral);
        quality.max_dihedral_histogram.add(cell.max_dihedral);
        quality.aspect_ratio_histogram.add(cell.aspect_ratio);
        quality.radius_ratio_histogram.add(cell.radius_ratio);
        quality.shortest_edge
          = c == 0 ? cell.shortest_edge : std::min(quality.shortest_edge, cell.shortest_edge);
        quality.longest_edge = std::max(quality.longest_edge, cell.longest_edge);
      }
    if (mesh.n_cells() > 0)
      for (QualityRange *range : {&quality.min_dihedral,
                                  &quality.max_dihedral,
                                  &quality.radius_edge,
                                  &quality.aspect_ratio,
                                  &quality.radius_ratio})
        range->mean /= mesh.n_cells();
    return quality;
  }
} // namespace tetradapt::mesh
