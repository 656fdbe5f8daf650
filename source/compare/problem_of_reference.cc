// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/problem_of_reference.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/edges.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace tetradapt::compare
{
  namespace
  {
    bool
    is_finite(const std::vector<dealii::Tensor<1, 3>> &values)
    {
      return std::all_of(values.begin(), values.end(), [](const auto &value) {
        return std::isfinite(value[0]) && std::isfinite(value[1]) && std::isfinite(value[2]);
      });
    }

    bool
    is_finite(const std::vector<double> &values)
    {
      return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
    }

    /** What is wrong with a mesh whose indices nobody has looked at, or nothing. */
    std::string
    problem_of(const mesh::TetMesh &mesh)
    {
      const auto n_points = mesh.points.size();
      if (n_points == 0 || n_points > std::numeric_limits<unsigned int>::max() / 8
          || mesh.cells.size() > std::numeric_limits<unsigned int>::max() / 8)
        return "its mesh has an impossible number of points or cells";
      if (mesh.regions.size() != mesh.cells.size())
        return "its mesh has another number of regions than of cells";
      for (const auto &point : mesh.points)
        if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
          return "its mesh has a point that is not finite";
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        {
          for (const unsigned int v : mesh.cells[cell])
            if (v >= n_points)
              return "its mesh names a point that does not exist";
          if (!(mesh::cell_volume(mesh, cell) > 0.))
            return "its mesh has a cell without volume";
        }
      for (const auto &face : mesh.faces)
        {
          for (const unsigned int v : face.vertices)
            if (v >= n_points)
              return "its mesh names a point that does not exist";
          if (face.patch >= mesh.patches.size())
            return "its mesh names a patch that does not exist";
        }
      return "";
    }

    std::string
    problem_of_tetrahedra(const CachedReference &reference)
    {
      if (const std::string problem = problem_of(reference.mesh); !problem.empty())
        return problem;
      if (reference.degree != 1 && reference.degree != 2)
        return "its degree is " + std::to_string(reference.degree);
      std::size_t n_nodes = reference.mesh.n_points();
      if (reference.degree == 2)
        n_nodes += mesh::build_edges(reference.mesh).edges.size();
      if (reference.values.size() != n_nodes)
        return "its displacement does not fit its mesh";
      if (!reference.pressures.empty() && reference.pressures.size() != reference.mesh.n_points())
        return "its pressure does not fit its mesh";
      return "";
    }

    std::string
    problem_of_hexahedra(const CachedReference &reference)
    {
      if (reference.degree < 1 || reference.degree > 3)
        return "its degree is " + std::to_string(reference.degree);
      const std::size_t edge = reference.degree + 1;
      if (!reference.mesh.points.empty()
          || reference.values.size() != reference.hexahedra.size() * edge * edge * edge)
        return "its displacement does not fit its cells";
      for (const auto &planes : reference.planes)
        if (planes.size() < 2 || !is_finite(planes)
            || std::adjacent_find(planes.begin(), planes.end(), std::greater_equal<double>())
                 != planes.end())
          return "its grid is not in order";
      double n_bricks = 1.;
      for (const auto &planes : reference.planes)
        n_bricks *= planes.size() - 1.;
      if (n_bricks > 1000. * (reference.hexahedra.size() + 1000.))
        return "its grid has far more bricks than there are cells";
      for (const auto &cell : reference.hexahedra)
        for (unsigned int d = 0; d < 3; ++d)
          {
            const double front = reference.planes[d].front(), back = reference.planes[d].back();
            const double rounding = 1e-9 * (back - front);
            if (!(cell.size[d] > 0.) || !(cell.lower[d] >= front - rounding)
                || !(cell.lower[d] + cell.size[d] <= back + rounding))
              return "it has a cell outside of its grid";
          }
      try
        {
          const mesh::HexahedralField field(reference.degree,
                                            reference.planes,
                                            reference.hexahedra,
                                            reference.values);
        }
      catch (const core::NumericalError &)
        {
          return "its cells do not fit into its grid";
        }
      return "";
    }
  } // namespace

  std::string
  problem_of_reference(const CachedReference &reference)
  {
    if (!is_finite(reference.values) || !is_finite(reference.pressures)
        || !(std::isfinite(reference.energy) && std::isfinite(reference.estimated_error)
             && std::isfinite(reference.known_energy) && std::isfinite(reference.seconds))
        || reference.estimated_error < 0.)
      return "it holds a number that is not finite";
    return reference.hexahedra.empty() ? problem_of_tetrahedra(reference)
                                       : problem_of_hexahedra(reference);
  }
} // namespace tetradapt::compare
