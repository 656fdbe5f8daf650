// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/size_function.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/mesh_checks.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    constexpr unsigned int most_passes      = 6;
    constexpr double       tolerated_excess = 1.5;

    /** How fast sizes may grow away from a small size found inside a cell. */
    constexpr double growth = 0.5;

    /** The size function on one mesh. */
    struct SampledSize
    {
      std::vector<double> nodes; ///< to pass to TetGen
      std::vector<double> cells; ///< least of the samples in a cell
    };

    double
    evaluate(const core::Expression &size, const Point<3> &point)
    {
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
    }

    Point<3>
    centroid(const TetMesh &mesh, unsigned int cell)
    {
      Point<3> sum;
      for (const unsigned int v : mesh.cells[cell])
        sum += mesh.points[v];
      return sum / 4.;
    }

    SampledSize
    sample(const TetMesh &mesh, const core::Expression &size)
    {
      SampledSize result;
      result.nodes.reserve(mesh.n_points());
      for (const auto &point : mesh.points)
        result.nodes.push_back(evaluate(size, point));
      const std::vector<double> at_points = result.nodes;
      result.cells.reserve(mesh.n_cells());
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        {
          const Point<3> middle = centroid(mesh, cell);
          const double   h      = evaluate(size, middle);
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

    void
    compare(const TetMesh &mesh, const SampledSize &wanted, SizeReport &report)
    {
      double sum_of_logs     = 0.;
      report.largest_ratio   = 0.;
      report.oversized_cells = 0;
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        {
          const double obtained = std::cbrt(6. * std::sqrt(2.) * cell_volume(mesh, cell));
          const double ratio    = obtained / wanted.cells[cell];
          sum_of_logs += std::log(ratio);
          report.largest_ratio = std::max(report.largest_ratio, ratio);
          report.oversized_cells += ratio > tolerated_excess;
        }
      report.mean_ratio = std::exp(sum_of_logs / std::max(1U, mesh.n_cells()));
    }
  } // namespace

  TetMesh
  mesh_with_size(const Tetgen           &tetgen,
                 const TetMesh          &start,
                 const core::Expression &size,
                 SizeReport             *report)
  {
    const auto  begin = std::chrono::steady_clock::now();
    SizeReport  own;
    TetMesh     mesh   = start;
    SampledSize wanted = sample(mesh, size);
    compare(mesh, wanted, own);
    while (own.oversized_cells > 0 && own.passes < most_passes)
      {
        Sizing sizing;
        sizing.node_sizes = wanted.nodes;
        TetgenReport step;
        TetMesh      refined = tetgen.refine(mesh, sizing, &step);
        own.cap_reached      = own.cap_reached || step.cap_reached;
        if (!step.called || step.new_points == 0)
          break;
        ++own.passes;
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
} // namespace tetradapt::mesh
