// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/size_function.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/finalize.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    constexpr unsigned int most_passes      = 6;
    constexpr unsigned int most_small_steps = 14; ///< passes, where steps are limited
    constexpr double       tolerated_excess = 1.5;

    /** How fast sizes may grow away from a small size found inside a cell. */
    constexpr double growth = 0.5;

    /** The size function on one mesh. */
    struct SampledSize
    {
      std::vector<double> nodes; ///< to pass to TetGen
      std::vector<double> cells; ///< least of the samples in a cell
    };

    Point<3>
    centroid(const TetMesh &mesh, unsigned int cell)
    {
      Point<3> sum;
      for (const unsigned int v : mesh.cells[cell])
        sum += mesh.points[v];
      return sum / 4.;
    }

    double
    equivalent_edge(const TetMesh &mesh, unsigned int cell)
    {
      return std::cbrt(6. * std::sqrt(2.) * cell_volume(mesh, cell));
    }

    SampledSize
    sample(const TetMesh &mesh, const SizeFunction &size)
    {
      SampledSize result;
      result.nodes.reserve(mesh.n_points());
      for (const auto &point : mesh.points)
        result.nodes.push_back(size(point));
      const std::vector<double> at_points = result.nodes;
      result.cells.reserve(mesh.n_cells());
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        {
          const Point<3> middle = centroid(mesh, cell);
          const double   h      = size(middle);
          double         least  = h;
          for (const unsigned int v : mesh.cells[cell])
            {
              least = std::min(least, at_points[v]);
              result.nodes[v]
                = std::min(result.nodes[v], h + growth * middle.distance(mesh.points[v]));
            }
          result.cells.push_back(least);
        }
      return result;
    }

    /** Raises sizes to @p smallest_step times what the cells around have on average. */
    void
    limit_step(const TetMesh &mesh, double smallest_step, std::vector<double> &sizes)
    {
      std::vector<double>       logs(mesh.n_points(), 0.);
      std::vector<unsigned int> count(mesh.n_points(), 0);
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        {
          const double log = std::log(equivalent_edge(mesh, cell));
          for (const unsigned int v : mesh.cells[cell])
            {
              logs[v] += log;
              ++count[v];
            }
        }
      for (unsigned int p = 0; p < mesh.n_points(); ++p)
        if (count[p] > 0)
          sizes[p] = std::max(sizes[p], smallest_step * std::exp(logs[p] / count[p]));
    }

    void
    compare(const TetMesh &mesh, const SampledSize &wanted, SizeReport &report)
    {
      double sum_of_logs     = 0.;
      report.largest_ratio   = 0.;
      report.oversized_cells = 0;
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        {
          const double ratio = equivalent_edge(mesh, cell) / wanted.cells[cell];
          sum_of_logs += std::log(ratio);
          report.largest_ratio = std::max(report.largest_ratio, ratio);
          report.oversized_cells += ratio > tolerated_excess;
        }
      report.mean_ratio = std::exp(sum_of_logs / std::max(1U, mesh.n_cells()));
    }
  } // namespace

  TetMesh
  mesh_with_size(const Tetgen       &tetgen,
                 const TetMesh      &start,
                 const SizeFunction &size,
                 SizeReport         *report,
                 const MeshChange   &change,
                 double              smallest_step)
  {
    const auto  begin = std::chrono::steady_clock::now();
    SizeReport  own;
    TetMesh     mesh   = start;
    SampledSize wanted = sample(mesh, size);
    compare(mesh, wanted, own);
    while (own.oversized_cells > 0
           && own.passes < (smallest_step > 0. ? most_small_steps : most_passes))
      {
        Sizing sizing;
        sizing.node_sizes = wanted.nodes;
        if (smallest_step > 0.)
          limit_step(mesh, smallest_step, sizing.node_sizes);
        TetgenReport step;
        TetMesh      refined = tetgen.refine(mesh, sizing, &step);
        own.cap_reached      = own.cap_reached || step.cap_reached;
        if (!step.called || step.new_points == 0)
          break;
        ++own.passes;
        if (change)
          change(refined);
        mesh   = std::move(refined);
        wanted = sample(mesh, size);
        compare(mesh, wanted, own);
        if (step.cap_reached)
          break;
      }
    if (report != nullptr)
      {
        own.seconds
          = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        *report = own;
      }
    return mesh;
  }

  TetMesh
  mesh_with_size(const Tetgen           &tetgen,
                 const TetMesh          &start,
                 const core::Expression &size,
                 SizeReport             *report,
                 const MeshChange       &change)
  {
    const SizeFunction checked = [&size](const Point<3> &point) {
      const double h = size(point);
      if (!(h > 0.))
        {
          std::ostringstream message;
          message << "The wanted edge length '" << size.text() << "' is " << h << " at "
                  << to_string(point)
                  << "; it must be positive everywhere. Correct Size in Mesh or "
                     "Reference.";
          throw core::InputError(message.str());
        }
      return h;
    };
    return mesh_with_size(tetgen, start, checked, report, change);
  }
} // namespace tetradapt::mesh
