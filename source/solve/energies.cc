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

    Energies sum;
    for (unsigned int cell = begin; cell < end; ++cell)
      {
        const int    region = mesh.regions[cell];
        const auto  &law    = materials.law(region);
        const double volume = mesh::cell_volume(mesh, cell);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const auto             &p = quadrature.point(q);
            const mesh::Barycentric b{{1. - p[0] - p[1] - p[2], p[0], p[1], p[2]}};
            if (displacement.pressure)
              {
                const auto elastic = displacement.gradient(cell, b)
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
            const auto   strain  = symmetrize(displacement.gradient(cell, b));
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
