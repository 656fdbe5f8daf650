// SPDX-License-Identifier: AGPL-3.0-or-later
#include "local_smoothing.h"

#include "tetradapt/mesh/point_moves.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::mesh
{
  namespace
  {
    /** How far a cell is from good: (good/q - 1)^2 of its mean ratio q, linear below
     * a tenth of good. */
    double
    defect(double q)
    {
      constexpr double low = 0.1 * good_mean_ratio;
      if (q >= good_mean_ratio)
        return 0.;
      if (q < low)
        return 81. + 180. * (low - q) / low;
      const double lack = good_mean_ratio / q - 1.;
      return lack * lack;
    }
  } // namespace

  double
  mean_ratio(const TetMesh &mesh, unsigned int cell)
  {
    const auto &v = mesh.cells[cell];
    return mean_ratio(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]);
  }

  LocalSmoothing::LocalSmoothing(TetMesh &mesh)
    : mesh(mesh), first(mesh.n_points() + 1, 0), around(4 * mesh.cells.size()),
      free_points(mesh.n_points(), 1)
  {
    for (const auto &cell : mesh.cells)
      for (const unsigned int v : cell)
        ++first[v + 1];
    for (unsigned int p = 0; p < mesh.n_points(); ++p)
      first[p + 1] += first[p];
    std::vector<unsigned int> place(first.begin(), first.end() - 1);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (const unsigned int v : mesh.cells[c])
        around[place[v]++] = c;

    for (const auto &face : mesh.faces)
      for (const unsigned int v : face.vertices)
        fix(v);
    for (unsigned int p = 0; p < mesh.n_points(); ++p)
      for (unsigned int k = first[p]; k < first[p + 1]; ++k)
        if (mesh.regions[around[k]] != mesh.regions[around[first[p]]])
          fix(p);
  }

  std::vector<unsigned int>
  LocalSmoothing::free_points_near(const std::vector<unsigned int> &seeds,
                                   unsigned int                     n_layers) const
  {
    std::vector<char>         seen(mesh.n_points(), 0);
    std::vector<unsigned int> found, front = seeds, next;
    for (unsigned int layer = 0; layer < n_layers; ++layer, front.swap(next), next.clear())
      for (const unsigned int p : front)
        for (unsigned int k = first[p]; k < first[p + 1]; ++k)
          for (const unsigned int v : mesh.cells[around[k]])
            if (seen[v] == 0 && is_free(v))
              {
                seen[v] = 1;
                found.push_back(v);
                next.push_back(v);
              }
    return found;
  }

  // (The worst cell alone would be bettered by making all others as bad.)
  double
  LocalSmoothing::defect_around(unsigned int point) const
  {
    double sum = 0.;
    for (unsigned int k = first[point]; k < first[point + 1]; ++k)
      sum += defect(mean_ratio(mesh, around[k]));
    return sum;
  }

  Point<3>
  LocalSmoothing::centre_around(unsigned int point) const
  {
    Point<3> sum;
    double   n = 0.;
    for (unsigned int k = first[point]; k < first[point + 1]; ++k)
      for (const unsigned int v : mesh.cells[around[k]])
        if (v != point)
          {
            sum += mesh.points[v];
            n += 1.;
          }
    return sum / n;
  }

  // The normal of a cell's face opposite a corner towards that corner, half as long as
  // the face is wide.
  Tensor<1, 3>
  LocalSmoothing::away_from_opposite(unsigned int cell, unsigned int point) const
  {
    std::array<unsigned int, 3> f{};
    unsigned int                n = 0;
    for (const unsigned int v : mesh.cells[cell])
      if (v != point)
        f[n++ % 3] = v;
    const Tensor<1, 3> area = dealii::cross_product_3d(mesh.points[f[1]] - mesh.points[f[0]],
                                                       mesh.points[f[2]] - mesh.points[f[0]]);
    return 0.5 * area / std::sqrt(area.norm());
  }

  bool
  LocalSmoothing::improve(unsigned int cell, unsigned int point)
  {
    const Point<3>     here   = mesh.points[point];
    const Tensor<1, 3> to_mid = centre_around(point) - here;
    const Tensor<1, 3> away   = away_from_opposite(cell, point);
    Point<3>           best   = here;
    double             value  = defect_around(point);
    for (const Tensor<1, 3> &direction : {to_mid, away, -away})
      for (const double part : {1., 0.5, 0.25, 0.125})
        {
          mesh.points[point]     = here + part * direction;
          const double candidate = defect_around(point);
          if (candidate < 0.99 * value)
            {
              value = candidate;
              best  = mesh.points[point];
            }
        }
    mesh.points[point] = best;
    return best != here;
  }
} // namespace tetradapt::mesh
