// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/difference.h"
#include "tetradapt/compare/exact_solution.h"
#include "tetradapt/compare/field_evaluator.h"
#include "tetradapt/compare/parallel.h"
#include "tetradapt/core/failure.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::compare
{
  namespace
  {
    /** Norms, means and sums from the two distances of every node. */
    NodalRen
    summarise(const mesh::NodalField    &u_h,
              const std::vector<double> &distances, // |P-Q'|, |P0-Q'| of each node
              const double               largest_distance,
              const ExcludedRegion      &excluded)
    {
      NodalRen           result;
      const unsigned int n = u_h.n_nodes(), n_points = u_h.mesh().n_points();
      unsigned int       n_counted = 0;
      double             scale     = 0.;
      for (unsigned int node = 0; node < n; ++node)
        scale = std::max(scale, distances[2 * std::size_t(node) + 1]);
      const double zero = NodalRen::zero_distance * scale;

      result.largest_distance = largest_distance;
      result.values.assign(n, 0.);
      double sum = 0.;
      for (unsigned int node = 0; node < n; ++node)
        {
          const double error = distances[2 * std::size_t(node)];
          const double moved = distances[2 * std::size_t(node) + 1];
          if (!excluded.contains(u_h.node_position(node)))
            {
              if (error > zero && moved > zero)
                result.values[node] = error / moved;
              ++n_counted;
            }
          sum += result.values[node];
          result.max = std::max(result.max, result.values[node]);
          if (node + 1 == n_points && n_counted > 0)
            result.mean_of_points = sum / n_counted;
        }
      result.mean = n_counted > 0 ? sum / n_counted : 0.;
      result.cell_sums.assign(u_h.mesh().n_cells(), 0.);
      for (unsigned int cell = 0; cell < u_h.mesh().n_cells(); ++cell)
        for (unsigned int i = 0; i < u_h.n_nodes_per_cell(); ++i)
          result.cell_sums[cell] += result.values[u_h.node(cell, i)];
      return result;
    }
  } // namespace

  namespace
  {
    NodalRen
    ren_to_tetrahedra(const mesh::NodalField &u_h,
                      const PointLocator     &reference_locator,
                      const mesh::NodalField &reference,
                      MPI_Comm                communicator,
                      const ExcludedRegion   &excluded)
    {
      const Slice           slice = own_slice(u_h.n_nodes(), communicator);
      std::vector<Point<3>> nodes;
      nodes.reserve(slice.end - slice.begin);
      for (unsigned int node = slice.begin; node < slice.end; ++node)
        nodes.push_back(u_h.node_position(node));
      const auto          locations = reference_locator.locate(nodes);
      std::vector<double> distances(2 * std::size_t(u_h.n_nodes()), 0.);
      double              farthest = 0.;
      for (unsigned int i = 0; i < nodes.size(); ++i)
        {
          const Tensor<1, 3> u = reference.value(locations[i].cell, locations[i].barycentric);
          const std::size_t  k = 2 * std::size_t(slice.begin + i);
          distances[k]         = (u_h.values[slice.begin + i] - u).norm();
          distances[k + 1]     = u.norm();
          farthest             = std::max(farthest, locations[i].distance);
        }
      gather_slices(distances, u_h.n_nodes(), 2, communicator);
      return summarise(u_h, distances, max_over_ranks(farthest, communicator), excluded);
    }
  } // namespace

  NodalRen
  nodal_ren(const mesh::NodalField &u_h,
            const PointLocator     &reference_locator,
            const mesh::NodalField &reference,
            MPI_Comm                communicator)
  {
    return ren_to_tetrahedra(u_h, reference_locator, reference, communicator, ExcludedRegion());
  }

  NodalRen
  nodal_ren(const mesh::NodalField &u_h, const ReferenceSampling &sampling)
  {
    const MPI_Comm               communicator = sampling.communicator();
    const mesh::HexahedralField *hexahedra    = sampling.hexahedra();
    if (hexahedra == nullptr)
      return ren_to_tetrahedra(
        u_h, sampling.locator(), sampling.reference(), communicator, sampling.excluded());
    const Slice         slice = own_slice(u_h.n_nodes(), communicator);
    std::vector<double> distances(2 * std::size_t(u_h.n_nodes()), 0.);
    double              farthest = 0.;
    for (unsigned int node = slice.begin; node < slice.end; ++node)
      {
        const auto         at                = hexahedra->locate(u_h.node_position(node));
        const Tensor<1, 3> u                 = hexahedra->value(at.cell, at.unit);
        distances[2 * std::size_t(node)]     = (u_h.values[node] - u).norm();
        distances[2 * std::size_t(node) + 1] = u.norm();
        farthest                             = std::max(farthest, at.distance);
      }
    gather_slices(distances, u_h.n_nodes(), 2, communicator);
    return summarise(u_h, distances, max_over_ranks(farthest, communicator), sampling.excluded());
  }

  NodalRen
  nodal_ren(const mesh::NodalField               &u_h,
            const scene::ExactSolutionParameters &exact_solution,
            MPI_Comm                              communicator,
            const ExcludedRegion                 &excluded)
  {
    const Slice         slice = own_slice(u_h.n_nodes(), communicator);
    std::vector<double> distances(2 * std::size_t(u_h.n_nodes()), 0.);
    core::together(communicator, [&] {
      const ExactSolution exact(exact_solution);
      for (unsigned int node = slice.begin; node < slice.end; ++node)
        {
          // An exact solution need not have a value there.
          if (excluded.contains(u_h.node_position(node)))
            continue;
          const Tensor<1, 3> u                 = exact.value(u_h.node_position(node));
          distances[2 * std::size_t(node)]     = (u_h.values[node] - u).norm();
          distances[2 * std::size_t(node) + 1] = u.norm();
        }
    });
    gather_slices(distances, u_h.n_nodes(), 2, communicator);
    return summarise(u_h, distances, 0., excluded);
  }
} // namespace tetradapt::compare
