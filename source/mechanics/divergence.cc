// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/divergence.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::mechanics
{
  namespace
  {
    /** The node between two local vertices, or at one. */
    constexpr std::array<std::array<unsigned int, 4>, 4> between{
      {{{0, 4, 6, 7}}, {{4, 1, 5, 8}}, {{6, 5, 2, 9}}, {{7, 8, 9, 3}}}};
  } // namespace

  Divergence::Divergence(const PressureSpace &space, const fem::FixedUnknowns &fixed_unknowns)
    : n_displacements(space.displacements().n_owned_nodes()), n_pressures(space.n_owned_nodes()),
      fixed(n_displacements)
  {
    const fem::Space &displacements = space.displacements();
    for (unsigned int node = 0; node < n_displacements; ++node)
      fixed[node] = fixed_unknowns.components(node);
    cells.reserve(displacements.touching_cells().size());
    for (const unsigned int cell : displacements.touching_cells())
      {
        Cell        data;
        const auto &mesh = displacements.tet_mesh();
        const auto  g    = mesh::barycentric_gradients(mesh, cell);
        data.volume      = mesh::cell_volume(mesh, cell);
        for (unsigned int i = 0; i < 4; ++i)
          {
            data.pressures[i] = space.cell_node(cell, i);
            for (unsigned int c = 0; c < 3; ++c)
              data.gradients[i][c] = g[i][c];
          }
        for (unsigned int j = 0; j < 10; ++j)
          data.displacements[j] = displacements.local_node(displacements.cell_node(cell, j));
        cells.push_back(data);
      }
  }

  void
  Divergence::vmult(Vector &q, const Vector &u) const
  {
    u.update_ghost_values();
    q                     = 0.;
    const double *const x = u.begin();
    double *const       y = q.begin();
    for (const Cell &cell : cells)
      {
        double values[10][3];
        for (unsigned int j = 0; j < 10; ++j)
          for (unsigned int c = 0; c < 3; ++c)
            values[j][c] = x[3 * static_cast<std::size_t>(cell.displacements[j]) + c];
        // At vertex i the shape function of vertex k has the gradient -g_k, or 3 g_i for k = i,
        // and that of the edge to k has 4 g_k.
        double divergence[4], sum = 0.;
        for (unsigned int i = 0; i < 4; ++i)
          {
            divergence[i] = 0.;
            for (unsigned int k = 0; k < 4; ++k)
              for (unsigned int c = 0; c < 3; ++c)
                divergence[i]
                  += cell.gradients[k][c] * (4. * values[between[i][k]][c] - values[k][c]);
            sum += divergence[i];
          }
        for (unsigned int i = 0; i < 4; ++i)
          if (cell.pressures[i] < n_pressures)
            y[cell.pressures[i]] -= 0.05 * cell.volume * (sum + divergence[i]);
      }
    u.zero_out_ghost_values();
  }

  template <typename Add>
  void
  Divergence::transposed_cell(const Cell &cell, const double *q, const Add &add) const
  {
    double means[4], sum = 0.;
    for (unsigned int i = 0; i < 4; ++i)
      sum += q[i];
    for (unsigned int i = 0; i < 4; ++i)
      means[i] = -0.05 * cell.volume * (sum + q[i]);
    const double all = -0.25 * cell.volume * sum; // of means
    for (unsigned int k = 0; k < 4; ++k)
      for (unsigned int i = 0; i <= k; ++i)
        {
          double force[3];
          for (unsigned int c = 0; c < 3; ++c)
            force[c] = i == k
                         ? (4. * means[k] - all) * cell.gradients[k][c]
                         : 4. * (means[i] * cell.gradients[k][c] + means[k] * cell.gradients[i][c]);
          add(cell.displacements[between[i][k]], force);
        }
  }

  void
  Divergence::add_transposed(Vector &u, const Vector &q) const
  {
    q.update_ghost_values();
    const double *const x = q.begin();
    double *const       y = u.begin();
    for (const Cell &cell : cells)
      {
        double values[4];
        for (unsigned int i = 0; i < 4; ++i)
          values[i] = x[cell.pressures[i]];
        transposed_cell(cell, values, [&](const unsigned int node, const double *force) {
          if (node < n_displacements)
            for (unsigned int c = 0; c < 3; ++c)
              if ((fixed[node] >> c & 1) == 0)
                y[3 * static_cast<std::size_t>(node) + c] += force[c];
        });
      }
    q.zero_out_ghost_values();
  }

  double
  Divergence::relative_force(const Vector &q) const
  {
    std::vector<double> sums(3 * static_cast<std::size_t>(n_displacements), 0.), scales(sums);
    q.update_ghost_values();
    for (const Cell &cell : cells)
      {
        // A vertex's shape function has a gradient of mean zero: its force is small compared
        // with the size of the gradients.
        double values[4], size = 0.;
        for (unsigned int i = 0; i < 4; ++i)
          {
            values[i] = q.begin()[cell.pressures[i]];
            for (unsigned int c = 0; c < 3; ++c)
              size = std::max(size, cell.volume * std::abs(values[i] * cell.gradients[i][c]));
          }
        transposed_cell(cell, values, [&](const unsigned int node, const double *force) {
          if (node < n_displacements)
            for (unsigned int c = 0; c < 3; ++c)
              {
                sums[3 * std::size_t(node) + c] += force[c];
                scales[3 * std::size_t(node) + c] += size;
              }
        });
      }
    q.zero_out_ghost_values();
    double largest = 0.;
    for (std::size_t i = 0; i < sums.size(); ++i)
      if ((fixed[i / 3] >> i % 3 & 1) == 0 && scales[i] > 0.)
        largest = std::max(largest, std::abs(sums[i]) / scales[i]);
    return dealii::Utilities::MPI::max(largest, q.get_mpi_communicator());
  }
} // namespace tetradapt::mechanics
