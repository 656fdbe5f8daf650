// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/energies.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

namespace tetradapt::solve
{
  namespace
  {
    dealii::Point<3>
    position(const mesh::TetMesh &mesh, const unsigned int cell, const mesh::Barycentric &b)
    {
      dealii::Point<3> x;
      for (unsigned int i = 0; i < 4; ++i)
        x += b[i] * dealii::Tensor<1, 3>(mesh.points[mesh.cells[cell][i]]);
      return x;
    }

    /** The derivatives of the shape functions at the points of a quadrature rule by the four
     * barycentric coordinates, as if those were independent. */
    class ShapeTable
    {
    public:
      ShapeTable(unsigned int degree, const dealii::QGaussSimplex<3> &quadrature)
      {
        // Gradients along four unit vectors, a component at a time.
        for (const auto &p : quadrature.get_points())
          {
            points.push_back({{1. - p[0] - p[1] - p[2], p[0], p[1], p[2]}});
            derivatives.emplace_back();
            for (unsigned int i = 0; i < 4; ++i)
              {
                std::array<dealii::Tensor<1, 3>, 4>  directions;
                std::array<dealii::Tensor<1, 3>, 10> gradients;
                directions[i][0] = 1.;
                mesh::shape_gradients(degree, points.back(), directions, gradients.data());
                for (unsigned int k = 0; k < 10; ++k)
                  derivatives.back()[i][k] = gradients[k][0];
              }
          }
      }

      /** The displacement gradients at the points, for a cell whose barycentric coordinates
       * have the gradients @p directions. */
      void
      compute(const mesh::NodalField                    &field,
              unsigned int                               cell,
              const std::array<dealii::Tensor<1, 3>, 4> &directions,
              std::vector<dealii::Tensor<2, 3>>         &gradients) const
      {
        const unsigned int                   n = field.n_nodes_per_cell();
        std::array<dealii::Tensor<1, 3>, 10> u;
        for (unsigned int k = 0; k < n; ++k)
          u[k] = field.values[field.node(cell, k)];
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            gradients[q] = dealii::Tensor<2, 3>();
            for (unsigned int i = 0; i < 4; ++i)
              {
                dealii::Tensor<1, 3> along;
                for (unsigned int k = 0; k < n; ++k)
                  along += derivatives[q][i][k] * u[k];
                gradients[q] += outer_product(along, directions[i]);
              }
          }
      }

      std::vector<mesh::Barycentric> points;

    private:
      std::vector<std::array<std::array<double, 10>, 4>> derivatives;
    };
  } // namespace

  Energies
  compute_energies(const mesh::NodalField       &displacement,
                   const mechanics::MaterialMap &materials,
                   MPI_Comm                      communicator)
  {
    const auto         &mesh    = displacement.mesh();
    const unsigned long n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const unsigned long rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
    // Temperatures are expressions: their strain varies in a cell whatever the degree.
    const dealii::QGaussSimplex<3> quadrature(
      materials.has_thermal_strain() ? 3 : displacement.degree());
    const unsigned int begin = mesh.n_cells() * rank / n_ranks;
    const unsigned int end   = mesh.n_cells() * (rank + 1) / n_ranks;

    const ShapeTable                  shapes(displacement.degree(), quadrature);
    std::vector<dealii::Tensor<2, 3>> gradients(quadrature.size());
    Energies                          sum;
    for (unsigned int cell = begin; cell < end; ++cell)
      {
        const int    region = mesh.regions[cell];
        const auto  &law    = materials.law(region);
        const double volume = mesh::cell_volume(mesh, cell);
        shapes.compute(displacement, cell, mesh::barycentric_gradients(mesh, cell), gradients);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const mesh::Barycentric &b = shapes.points[q];
            if (displacement.pressure)
              {
                const auto elastic = gradients[q]
                                     - dealii::Tensor<2, 3>(
                                       materials.thermal_strain(region, position(mesh, cell, b)));
                const double part
                  = 6. * volume * quadrature.weight(q)
                    * law.complementary_density(materials.pressure_form(region).stress(
                      elastic, displacement.pressure->value(cell, b)));
                sum.energy += part;
                sum.stored += 0.5 * part;
                continue;
              }
            const auto   strain  = symmetrize(gradients[q]);
            const double weight  = 6. * volume * quadrature.weight(q);
            const double density = law.energy_density(strain);
            sum.energy += weight * density;
            if (!materials.has_thermal_strain())
              {
                sum.stored += 0.5 * weight * density;
                continue;
              }
            sum.stored += 0.5 * weight
                          * law.energy_density(
                            strain - materials.thermal_strain(region, position(mesh, cell, b)));
          }
      }
    sum.energy = dealii::Utilities::MPI::sum(sum.energy, communicator);
    sum.stored = dealii::Utilities::MPI::sum(sum.stored, communicator);
    return sum;
  }
} // namespace tetradapt::solve
