// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/deformation.h"

#include "tetradapt/compare/parallel.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetradapt::compare
{
  namespace
  {
    using dealii::SymmetricTensor;
    using dealii::Tensor;

    /** du_i/dx_j in the centre of the k-th of the touching cells. Node k of degree 1 or 2 enters
     * with dN_k/db_i. */
    Tensor<2, 3>
    central_gradient(const fem::Field &u, const unsigned int k)
    {
      const auto g = mesh::barycentric_gradients(u.mesh(), u.space().touching_cells()[k]);
      std::array<Tensor<1, 3>, 10> values;
      Tensor<2, 3>                 gradient;
      u.values_of_cell(k, values);
      // In the centre 4 b - 1 is zero and 4 b is one.
      if (u.degree() == 1)
        for (unsigned int i = 0; i < 4; ++i)
          gradient += outer_product(values[i], g[i]);
      else
        for (unsigned int e = 0; e < 6; ++e)
          {
            const auto &[i, j] = mesh::edge_vertices[e];
            gradient += outer_product(values[4 + e], g[i] + g[j]);
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

    /** Which of the touching cells are the rank's own. */
    std::vector<unsigned int>
    own_cells(const fem::Space &space)
    {
      std::vector<unsigned int> result;
      for (unsigned int k = 0; k < space.touching_cells().size(); ++k)
        if (space.is_own_cell(k))
          result.push_back(k);
      return result;
    }

    /** The length of a box's diagonal. */
    double
    diagonal(const Tensor<1, 3> &extent)
    {
      double square = 0., largest = 0.;
      for (unsigned int d = 0; d < 3; ++d)
        largest = std::max(largest, extent[d]);
      if (!(largest > 0.))
        return 0.;
      for (unsigned int d = 0; d < 3; ++d) // squares of very small numbers would vanish
        square += extent[d] / largest * (extent[d] / largest);
      return largest * std::sqrt(square);
    }

    /** The extent of the box of all displacements. Collective. */
    Tensor<1, 3>
    extent(const fem::Field &u)
    {
      constexpr double    huge = std::numeric_limits<double>::max();
      std::vector<double> largest(6, -huge); // of u and of -u: a rank may have no node
      for (unsigned int node = 0; node < u.space().n_owned_nodes(); ++node)
        for (unsigned int d = 0; d < 3; ++d)
          {
            largest[d]     = std::max(largest[d], u.value(node)[d]);
            largest[3 + d] = std::max(largest[3 + d], -u.value(node)[d]);
          }
      dealii::Utilities::MPI::max(largest, u.space().communicator(), largest);
      Tensor<1, 3> result;
      for (unsigned int d = 0; d < 3; ++d)
        result[d] = largest[d] + largest[3 + d];
      return result;
    }

    double
    largest_principal(const SymmetricTensor<2, 3> &strain)
    {
      const auto values = dealii::eigenvalues(strain);
      return std::max(std::abs(values[0]), std::abs(values[2]));
    }
  } // namespace

  Deformation
  deformation(const fem::Field &u_h)
  {
    const fem::Space    &space = u_h.space();
    const mesh::TetMesh &mesh  = space.tet_mesh();
    const auto           cells = own_cells(space);
    const auto           box   = mesh::bounding_box(mesh);
    Deformation          result;
    const double         body          = diagonal(box.second - box.first);
    result.displacement                = body > 0. ? diagonal(extent(u_h)) / body : 0.;
    double              largest_square = 0.;
    std::vector<double> sums(3, 0.); // strained, rotated and all of the volume
    for (const unsigned int k : cells)
      {
        const Tensor<2, 3>          G        = central_gradient(u_h, k);
        const double                volume   = mesh::cell_volume(mesh, space.touching_cells()[k]);
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
    if (result.strain > Deformation::limit)
      for (const unsigned int k : cells)
        if (largest_principal(symmetrize(central_gradient(u_h, k))) > Deformation::limit)
          sums[0] += mesh::cell_volume(mesh, space.touching_cells()[k]);
    sum_over_ranks(sums, space.communicator());
    result.strain        = max_over_ranks(result.strain, space.communicator());
    result.rotation      = max_over_ranks(result.rotation, space.communicator());
    result.strained_part = sums[0] / sums[2];
    result.rotated_part  = sums[1] / sums[2];
    return result;
  }

  Bending
  bending(const fem::Field &u_h, const std::vector<bool> &cells)
  {
    const fem::Space    &space = u_h.space();
    const mesh::TetMesh &mesh  = space.tet_mesh();
    // Volume and squared strain of all; volume, squared strain, rotation and its square of some.
    std::vector<double> sums(8, 0.);
    for (const unsigned int k : own_cells(space))
      {
        const unsigned int          cell   = space.touching_cells()[k];
        const Tensor<2, 3>          G      = central_gradient(u_h, k);
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
    sum_over_ranks(sums, space.communicator());
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
