// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/deformation.h"

#include "tetradapt/compare/parallel.h"

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::compare
{
  namespace
  {
    using dealii::SymmetricTensor;
    using dealii::Tensor;

    /** du_i/dx_j in the centre of a cell. Node k of degree 1 or 2 enters with dN_k/db_i. */
    Tensor<2, 3>
    central_gradient(const mesh::NodalField &u, const unsigned int cell)
    {
      const auto   g = mesh::barycentric_gradients(u.mesh(), cell);
      Tensor<2, 3> gradient;
      // In the centre 4 b - 1 is zero and 4 b is one.
      if (u.degree() == 1)
        for (unsigned int i = 0; i < 4; ++i)
          gradient += outer_product(u.values[u.node(cell, i)], g[i]);
      else
        for (unsigned int e = 0; e < 6; ++e)
          {
            const auto &[i, j] = mesh::edge_vertices[e];
            gradient += outer_product(u.values[u.node(cell, 4 + e)], g[i] + g[j]);
          }
      return gradient;
    }

    /** Half the curl. */
    Tensor<1, 3>
    rotation_of(const Tensor<2, 3> &G)
    {
      Tensor<1, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
          result[i] = 0.5 * (G[k][j] - G[j][k]);
        }
      return result;
    }

    /** Diagonal of the box of @p values, which are points or displacements. */
    template <typename Values>
    double
    diagonal(const Values &values)
    {
      double square = 0., largest = 0.;
      double extent[3];
      for (unsigned int d = 0; d < 3; ++d)
        {
          double lower = values[0][d], upper = values[0][d];
          for (const auto &value : values)
            {
              lower = std::min(lower, value[d]);
              upper = std::max(upper, value[d]);
            }
          extent[d] = upper - lower;
          largest   = std::max(largest, extent[d]);
        }
      if (!(largest > 0.))
        return 0.;
      for (const double e : extent) // squares of very small numbers would vanish
        square += e / largest * (e / largest);
      return largest * std::sqrt(square);
    }

    double
    largest_principal(const SymmetricTensor<2, 3> &strain)
    {
      const auto values = dealii::eigenvalues(strain);
      return std::max(std::abs(values[0]), std::abs(values[2]));
    }
  } // namespace

  Deformation
  deformation(const mesh::NodalField &u_h, MPI_Comm communicator)
  {
    const mesh::TetMesh &mesh  = u_h.mesh();
    const Slice          slice = own_slice(mesh.n_cells(), communicator);
    Deformation          result;
    const double         body          = diagonal(mesh.points);
    result.displacement                = body > 0. ? diagonal(u_h.values) / body : 0.;
    double              largest_square = 0.;
    std::vector<double> sums(3, 0.); // strained, rotated and all of the volume
    for (unsigned int cell = slice.begin; cell < slice.end; ++cell)
      {
        const Tensor<2, 3>          G        = central_gradient(u_h, cell);
        const double                volume   = mesh::cell_volume(mesh, cell);
        const double                rotation = rotation_of(G).norm();
        const SymmetricTensor<2, 3> strain   = symmetrize(G);
        const double                square   = strain * strain;
        result.rotation                      = std::max(result.rotation, rotation);
        sums[2] += volume;
        if (rotation > Deformation::limit)
          sums[1] += volume;
        // The largest principal strain is between |strain| / sqrt(3) and |strain|.
        if (square < largest_square / 3.)
          continue;
        const double principal = largest_principal(strain);
        largest_square         = std::max(largest_square, square);
        result.strain          = std::max(result.strain, principal);
      }
    for (unsigned int cell = slice.begin; result.strain > Deformation::limit && cell < slice.end;
         ++cell)
      if (largest_principal(symmetrize(central_gradient(u_h, cell))) > Deformation::limit)
        sums[0] += mesh::cell_volume(mesh, cell);
    sum_over_ranks(sums, communicator);
    result.strain        = max_over_ranks(result.strain, communicator);
    result.rotation      = max_over_ranks(result.rotation, communicator);
    result.strained_part = sums[0] / sums[2];
    result.rotated_part  = sums[1] / sums[2];
    return result;
  }

  Bending
  bending(const mesh::NodalField &u_h, const std::vector<bool> &cells, MPI_Comm communicator)
  {
    const mesh::TetMesh &mesh  = u_h.mesh();
    const Slice          slice = own_slice(mesh.n_cells(), communicator);
    // Volume and squared strain of all; volume, squared strain, rotation and its square of some.
    std::vector<double> sums(8, 0.);
    for (unsigned int cell = slice.begin; cell < slice.end; ++cell)
      {
        const Tensor<2, 3>          G      = central_gradient(u_h, cell);
        const double                volume = mesh::cell_volume(mesh, cell);
        const SymmetricTensor<2, 3> strain = symmetrize(G);
        const Tensor<1, 3>          w      = rotation_of(G);
        sums[0] += volume;
        sums[1] += volume * (strain * strain);
        if (!cells[cell])
          continue;
        sums[2] += volume;
        sums[3] += volume * (strain * strain);
        sums[4] += volume * w.norm_square();
        for (unsigned int d = 0; d < 3; ++d)
          sums[5 + d] += volume * w[d];
      }
    sum_over_ranks(sums, communicator);
    Bending result;
    if (!(sums[3] > 0.) || !(sums[0] > 0.))
      return result;
    result.volume      = sums[2] / sums[0];
    result.strain      = sums[3] / sums[1];
    const double mean  = (sums[5] * sums[5] + sums[6] * sums[6] + sums[7] * sums[7]) / sums[2];
    result.slenderness = std::sqrt(std::max(0., sums[4] - mean) / sums[3]);
    return result;
  }
} // namespace tetradapt::compare
