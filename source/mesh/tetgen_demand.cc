// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/tetgen_demand.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/finalize.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    using core::InputError;

    /** Least memory of TetGen a cell, bytes: measured 120 to 240. */
    constexpr double bytes_per_cell = 120.;

    /** Largest number of cells that is asked for: TetGen counts in int. */
    constexpr double most_cells = 2e8;

    /** Mean volume by volume bound, about, at every quality bound. */
    constexpr double mean_volume_by_bound = 0.4;

    /** Tetrahedra of a thin plate, by its area on all sides and the square of its thickness:
     * measured 1.7 for plates 10, 33 and 100 times wider than thick, at TetGen's bounds on
     * shapes that a scene has if it sets none. */
    constexpr double cells_by_area = 1.7;

    /** How many tetrahedra TetGen makes a second, at most a third of what was measured. */
    constexpr double cells_per_second = 4000.;

    /** So few take no time to speak of. */
    constexpr double few_cells = 1e5;

    template <typename... Parts>
    std::string
    text(const Parts &...parts)
    {
      std::ostringstream stream;
      (stream << ... << parts);
      return stream.str();
    }

    /** A cell's wanted edge length: the mean of its nodes'. */
    double
    wanted_size(const TetMesh &mesh, const std::vector<double> &node_sizes, unsigned int cell)
    {
      double sum = 0.;
      for (const unsigned int v : mesh.cells[cell])
        sum += node_sizes[v];
      return sum / 4.;
    }

  } // namespace

  SizeDemand
  assess(const TetMesh &mesh, const Sizing &sizing)
  {
    SizeDemand demand;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        const double volume = cell_volume(mesh, cell);
        double       pieces = 1.;
        double       bound  = sizing.cell_volumes.empty() ? 0. : sizing.cell_volumes[cell];
        if (sizing.max_volume > 0. && (bound <= 0. || bound > sizing.max_volume))
          bound = sizing.max_volume;
        if (bound > 0. && volume > bound)
          {
            demand.nothing_new = false;
            pieces             = expected_cells(volume, bound);
          }
        if (!sizing.node_sizes.empty())
          {
            // A regular tetrahedron with edge h has the volume h^3 / (6 sqrt 2).
            const double h     = wanted_size(mesh, sizing.node_sizes, cell);
            const double ratio = volume * 6. * std::sqrt(2.) / (h * h * h);
            demand.nothing_new = demand.nothing_new && ratio <= 1.;
            pieces             = std::max(pieces, ratio);
          }
        demand.n_cells += pieces;
      }
    return demand;
  }


  double
  expected_cells(double volume, double volume_bound)
  {
    return volume / (mean_volume_by_bound * volume_bound);
  }

  double
  least_cells(double volume, double area)
  {
    const double thickness = 2. * volume / area;
    return cells_by_area * area / (thickness * thickness);
  }

  void
  check_thickness(double volume, double area, double time_limit, const std::string &what)
  {
    const double n_cells = least_cells(volume, area);
    if (n_cells <= std::max(few_cells, cells_per_second * time_limit))
      return;
    throw InputError(text("TetGen would need about ",
                          n_cells,
                          " tetrahedra for ",
                          what,
                          ", whatever the wanted size: its mean thickness is ",
                          2. * volume / area,
                          " for an area of ",
                          area,
                          ", and tetrahedra of a good shape are not longer than the body is "
                          "thick. Make it thicker, mesh a smaller piece of it, use bricks "
                          "(Mesh/Type = bricks), or raise TetGen/Time limit above ",
                          std::ceil(n_cells / cells_per_second),
                          " s."));
  }

  void
  check_number_of_cells(double n_cells, double memory_limit, const std::string &what)
  {
    const double most = std::min(most_cells, memory_limit * 1048576. / bytes_per_cell);
    if (n_cells > most)
      throw InputError(text("The wanted size asks for about ",
                            n_cells,
                            " tetrahedra in ",
                            what,
                            "; TetGen can make at most ",
                            std::floor(most),
                            " within its memory limit of ",
                            memory_limit,
                            " MiB. Ask for larger tetrahedra",
                            most < most_cells ? " or raise TetGen/Memory limit." : "."));
  }

  void
  check_node_sizes(const std::vector<double>   &sizes,
                   const std::vector<Point<3>> &points,
                   const std::string           &what)
  {
    if (!sizes.empty() && sizes.size() != points.size())
      throw InputError(text(
        "There are ", sizes.size(), " sizes for the ", points.size(), " points of ", what, '.'));
    for (std::size_t i = 0; i < sizes.size(); ++i)
      if (!(sizes[i] > 0.) || !std::isfinite(sizes[i]))
        throw InputError(text("The wanted edge length of ",
                              what,
                              " at ",
                              to_string(points[i]),
                              " is ",
                              sizes[i],
                              "; it must be positive and finite."));
  }

  void
  check_sizing(const TetMesh &mesh, const Sizing &sizing, const std::string &what)
  {
    check_node_sizes(sizing.node_sizes, mesh.points, what);
    if (!std::isfinite(sizing.max_volume))
      throw InputError("The bound on the volume of tetrahedra must be a finite number.");
    if (!sizing.cell_volumes.empty() && sizing.cell_volumes.size() != mesh.n_cells())
      throw InputError(text("There are ",
                            sizing.cell_volumes.size(),
                            " volume bounds for the ",
                            mesh.n_cells(),
                            " cells of ",
                            what,
                            '.'));
    for (const double bound : sizing.cell_volumes)
      if (!std::isfinite(bound))
        throw InputError("A bound on the volume of a tetrahedron of " + what
                         + " is not a finite number.");
  }

} // namespace tetradapt::mesh
