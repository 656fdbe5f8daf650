// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/interpolation.h"

#include "tetradapt/compare/root_of_squares.h"
#include "tetradapt/estimate/hierarchical_surplus.h"
#include "tetradapt/estimate/recovery/recovery.h"
#include "tetradapt/estimate/stress_difference.h"
#include "tetradapt/mesh/face_table.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    /** The derivatives of degree p + 1 of a displacement in a cell, constant there. */
    class HighestDerivatives
    {
    public:
      /** The mean over the patches of the vertices in @p use of what was recovered. */
      HighestDerivatives(const RecoveredStress     &recovered,
                         const ElasticMatrices     &matrices,
                         const unsigned int         cell,
                         const std::array<bool, 4> &use,
                         const unsigned int         degree)
        : degree(degree)
      {
        const unsigned int n            = degree == 1 ? 3 : 6;
        double             stress[6][6] = {}, patch[6][6];
        const double       weight       = 1. / std::count(use.begin(), use.end(), true);
        for (unsigned int i = 0; i < 4; ++i)
          if (use[i])
            {
              recovered.highest_derivatives(recovered.patches_of_cell(cell)[i], patch);
              for (unsigned int k = 0; k < n; ++k)
                for (unsigned int c = 0; c < 6; ++c)
                  {
                    stress[k][c] += weight * patch[k][c];
                    found = found || patch[k][c] != 0.;
                  }
            }
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int a = 0; a < 6; ++a)
            {
              strain[k][a] = 0.;
              for (unsigned int b = 0; b < 6; ++b)
                strain[k][a] += (a < 3 ? 1. : 0.5) * matrices.compliance[a][b] * stress[k][b];
            }
      }

      /** Whether any patch had points enough for its highest degree. */
      bool
      are_known() const
      {
        return found;
      }

      /**
       * The derivative of degree p + 1 of the displacement in the direction and for the
       * length of @p a. Second derivatives of a displacement follow from the first ones of
       * its strain, u_i,kl = eps_il,k + eps_ik,l - eps_kl,i; for degree 2 all of it is
       * differentiated once more.
       */
      Tensor<1, 3>
      along(const Tensor<1, 3> &a) const
      {
        double along_a[6]; // of the strain: p derivatives along a
        double by[3][6];   // p - 1 of them along a and one by x, y, z
        for (unsigned int c = 0; c < 6; ++c)
          {
            if (degree == 1)
              for (unsigned int k = 0; k < 3; ++k)
                by[k][c] = strain[k][c];
            else
              for (unsigned int k = 0; k < 3; ++k)
                {
                  // Row k for twice x_k, row 3 + k for x_k and x_(k+1).
                  const unsigned int next = (k + 1) % 3, before = (k + 2) % 3;
                  by[k][c] = strain[k][c] * a[k] + strain[3 + k][c] * a[next]
                             + strain[3 + before][c] * a[before];
                }
            along_a[c] = a[0] * by[0][c] + a[1] * by[1][c] + a[2] * by[2][c];
          }
        Tensor<1, 3> result;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int l = 0; l < 3; ++l)
            {
              result[i] += 2. * along_a[stress_index[i][l]] * a[l];
              for (unsigned int k = 0; k < 3; ++k)
                result[i] -= a[k] * a[l] * by[i][stress_index[k][l]];
            }
        return result;
      }

    private:
      unsigned int degree;
      double       strain[6][6]; ///< tensor components
      bool         found = false;
    };

    /**
     * The vertices of a cell inside the body, or all if there are none. One-sided patches
     * give derivatives that are wrong by a part of their size, on every mesh; in those of
     * the inside the errors of opposite sides cancel (measured on interpolants: index 1.00
     * instead of 1.12).
     */
    std::array<bool, 4>
    inner_vertices(const std::array<unsigned int, 4> &vertices,
                   const std::vector<char>           &on_boundary)
    {
      std::array<bool, 4> use;
      for (unsigned int i = 0; i < 4; ++i)
        use[i] = on_boundary[vertices[i]] == 0;
      if (std::find(use.begin(), use.end(), true) == use.end())
        use.fill(true);
      return use;
    }

    /** Coefficients, in the cell's hierarchical functions, of u - I_h u for a polynomial u
     * of degree p + 1. */
    void
    interpolation_surplus(const HighestDerivatives &derivatives,
                          const unsigned int        degree,
                          const Point<3>           *x,
                          Tensor<1, 3>             *coefficients)
    {
      // On an edge, t(1-t) has the second derivative -2 and t(1-t)(1-2t) the third one 12.
      const double factor = degree == 1 ? -1. / 8. : 1. / (12. * HierarchicalSurplus::odd_scale);
      for (unsigned int e = 0; e < 6; ++e)
        coefficients[e]
          = factor * derivatives.along(x[mesh::edge_vertices[e][1]] - x[mesh::edge_vertices[e][0]]);
      if (degree == 1)
        return;
      for (unsigned int f = 0; f < 4; ++f)
        {
          // In the centre of a face, where u may be taken for zero: minus its quadratic
          // interpolation from the vertices and the middles of the edges.
          const auto    &v      = mesh::face_vertices[f];
          const Point<3> center = Point<3>(
            (1. / 3.) * (Tensor<1, 3>(x[v[0]]) + Tensor<1, 3>(x[v[1]]) + Tensor<1, 3>(x[v[2]])));
          Tensor<1, 3> value;
          for (unsigned int k = 0; k < 3; ++k)
            {
              const Tensor<1, 3> a = x[v[k]] - center, b = x[v[(k + 1) % 3]] - center;
              value += (1. / 54.) * derivatives.along(a)
                       - (4. / 54.) * derivatives.along(0.5 * (a + b));
            }
          coefficients[6 + f] = value;
        }
    }

    /** Squared energy norm of a sum of hierarchical functions in a cell. */
    double
    surplus_energy(const unsigned int                 degree,
                   const std::array<Tensor<1, 3>, 4> &directions,
                   const double                       volume,
                   const ElasticMatrices             &matrices,
                   const Tensor<1, 3>                *coefficients)
    {
      const auto        &rule = compare::tet_quadrature(degree == 1 ? 2 : 4);
      const unsigned int n    = degree == 1 ? 6 : 10;
      double             sum  = 0.;
      for (unsigned int q = 0; q < rule.points.size(); ++q)
        {
          Tensor<1, 3> gradients[HierarchicalSurplus::max_per_cell];
          HierarchicalSurplus::gradients(degree, rule.points[q], directions, gradients);
          Tensor<2, 3> gradient;
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int c = 0; c < 3; ++c)
              gradient[c] += coefficients[i][c] * gradients[i];
          double strain[6], stress[6];
          engineering_strain(gradient, strain);
          matrices.stress(strain, stress);
          for (unsigned int a = 0; a < 6; ++a)
            sum += rule.weights[q] * strain[a] * stress[a];
        }
      return sum * volume;
    }

    /** Energy norm of what a cell's stress lacks of the recovered one: all there is to know on
     * meshes of a few cells. */
    double
    recovered_difference(const RecoveredStress &recovered,
                         const CellStress      &stress,
                         const mesh::TetMesh   &mesh,
                         const unsigned int     cell)
    {
      const auto better
        = [&](unsigned int of, const mesh::Barycentric &b, const Point<3> &point, double *s) {
            recovered.at(of, b, point, s);
          };
      return stress_difference_in(mesh, stress, better, compare::tet_quadrature(2), cell);
    }
  } // namespace

  EstimatorTraits
  Interpolation::traits() const
  {
    EstimatorTraits traits;
    traits.name          = "interpolation";
    traits.documentation = "Energy norm of the interpolation error, from derivatives of the "
                           "displacement that are recovered from the solution. As far as these are "
                           "right it bounds the error, since no displacement of the mesh is nearer "
                           "than the solution.";
    return traits;
  }

  Estimate
  Interpolation::estimate(const EstimateInput &input) const
  {
    const mesh::NodalField &u_h          = input.comparison.displacement();
    const mesh::TetMesh    &mesh         = u_h.mesh();
    const MPI_Comm          communicator = input.comparison.mpi_communicator();
    const unsigned int      degree       = u_h.degree();
    const CellStress        stress(u_h, input.comparison.material_map(), false);
    const RecoveredStress   recovered(u_h, stress, nullptr, communicator);
    std::vector<char>       on_boundary(mesh.n_points(), 0);
    for (const auto &face : mesh.faces)
      for (const unsigned int v : face.vertices)
        on_boundary[v] = 1;
    Estimate result;
    result.indicators.assign(mesh.n_cells(), 0.);
    const compare::Slice slice = compare::own_slice(mesh.n_cells(), communicator);
    for (unsigned int cell = slice.begin; cell < slice.end; ++cell)
      {
        Point<3> x[4];
        for (unsigned int i = 0; i < 4; ++i)
          x[i] = mesh.points[mesh.cells[cell][i]];
        const ElasticMatrices   &matrices = stress.materials()[cell];
        const HighestDerivatives derivatives(
          recovered, matrices, cell, inner_vertices(mesh.cells[cell], on_boundary), degree);
        if (!derivatives.are_known())
          {
            result.indicators[cell] = recovered_difference(recovered, stress, mesh, cell);
            continue;
          }
        Tensor<1, 3> coefficients[HierarchicalSurplus::max_per_cell];
        interpolation_surplus(derivatives, degree, x, coefficients);
        result.indicators[cell]
          = std::sqrt(std::max(0.,
                               surplus_energy(degree,
                                              mesh::barycentric_gradients(mesh, cell),
                                              mesh::cell_volume(mesh, cell),
                                              matrices,
                                              coefficients)));
      }
    compare::gather_slices(result.indicators, mesh.n_cells(), 1, communicator);
    result.global = compare::root_of_squares(result.indicators);
    return result;
  }
} // namespace tetradapt::estimate
