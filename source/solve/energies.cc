// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/energies.h"

#include "tetradapt/mechanics/energy_norm.h"
#include "tetradapt/mechanics/volume_density.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <map>

namespace tetradapt::solve
{
  namespace
  {
    /** Shear moduli by region. */
    class ShearModuli
    {
    public:
      explicit ShearModuli(const mechanics::MaterialMap &materials) : materials(materials)
      {
      }

      double
      operator()(const int region)
      {
        const auto found = moduli.emplace(region, 0.);
        if (found.second)
          found.first->second = laws::shear_modulus(materials.linear_law(region));
        return found.first->second;
      }

    private:
      const mechanics::MaterialMap &materials;
      std::map<int, double>         moduli;
    };

    /** Sums over the ranks. Collective. */
    void
    add_up(Energies &sum, MPI_Comm communicator)
    {
      for (double Energies::*part : {&Energies::energy, &Energies::stored, &Energies::scale})
        sum.*part = dealii::Utilities::MPI::sum(sum.*part, communicator);
    }

    /** The displacement gradient at a point of a cell. */
    dealii::Tensor<2, 3>
    gradient_at(const fem::Space                           &space,
                const unsigned int                          cell,
                const std::array<dealii::Tensor<1, 3>, 10> &values,
                const mesh::Barycentric                    &b)
    {
      std::array<dealii::Tensor<1, 3>, 10> gradients;
      mesh::shape_gradients(space.degree(),
                            b,
                            mesh::barycentric_gradients(space.tet_mesh(), cell),
                            gradients.data());
      dealii::Tensor<2, 3> G;
      for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
        G += outer_product(values[i], gradients[i]);
      return G;
    }

    /** Displacement gradients at the points of a quadrature rule, cell by cell: the shape
     * functions' derivatives by the four barycentric coordinates, as if those were
     * independent, are the same in every cell. */
    class GradientTable
    {
    public:
      GradientTable(unsigned int degree, const dealii::QGaussSimplex<3> &quadrature)
        : degree(degree)
      {
        for (const auto &p : quadrature.get_points())
          points.push_back({{1. - p[0] - p[1] - p[2], p[0], p[1], p[2]}});
      }

      /** At all points of @p cell, whose nodes have the displacements @p u. */
      void
      compute(const mesh::TetMesh                        &mesh,
              unsigned int                                cell,
              const std::array<dealii::Tensor<1, 3>, 10> &u,
              std::vector<dealii::Tensor<2, 3>>          &gradients) const
      {
        const auto directions = mesh::barycentric_gradients(mesh, cell);
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            const mesh::Barycentric            &b = points[q];
            std::array<dealii::Tensor<1, 3>, 4> along;
            for (unsigned int i = 0; i < 4; ++i)
              along[i] = degree == 1 ? u[i] : (4. * b[i] - 1.) * u[i];
            if (degree == 2)
              for (unsigned int e = 0; e < 6; ++e)
                {
                  const auto &[i, j] = mesh::edge_vertices[e];
                  along[i] += 4. * b[j] * u[4 + e];
                  along[j] += 4. * b[i] * u[4 + e];
                }
            gradients[q] = outer_product(along[0], directions[0]);
            for (unsigned int i = 1; i < 4; ++i)
              gradients[q] += outer_product(along[i], directions[i]);
          }
      }

      std::vector<mesh::Barycentric> points;

    private:
      unsigned int degree;
    };
  } // namespace

  Energies
  compute_energies(const fem::Field &displacement, const mechanics::MaterialMap &materials)
  {
    const fem::Space              &space    = displacement.space();
    const mesh::TetMesh           &mesh     = space.tet_mesh();
    const auto                    &pressure = displacement.pressure();
    const dealii::QGaussSimplex<3> quadrature(displacement.degree());

    std::array<dealii::Tensor<1, 3>, 10> u;
    const GradientTable                  table(displacement.degree(), quadrature);
    std::vector<dealii::Tensor<2, 3>>    gradients(quadrature.size());
    ShearModuli                          shear_moduli(materials);
    mechanics::VolumeDensity::Samples    temperatures;
    Energies                             sum;
    for (unsigned int k = 0; k < space.touching_cells().size(); ++k)
      {
        if (!space.is_own_cell(k))
          continue;
        const unsigned int cell   = space.touching_cells()[k];
        const int          region = mesh.regions[cell];
        const auto        &law    = materials.linear_law(region);
        const double       volume = mesh::cell_volume(mesh, cell);
        const double       mu     = shear_moduli(region);
        // In mixed form, of the elastic part of a gradient; else of a strain.
        const auto density_at = [&](const mesh::Barycentric &b, const dealii::Tensor<2, 3> &G) {
          return pressure ? law.complementary_density(
                   materials.pressure_form(region).stress(G, pressure->value(cell, b)))
                          : law.energy_density(symmetrize(G));
        };
        displacement.values_of_cell(k, u);
        table.compute(mesh, cell, u, gradients);
        double stored = 0.;
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const double weight = 6. * volume * quadrature.weight(q);
            sum.scale += 2. * weight * mu * gradients[q].norm_square();
            const double part = weight * density_at(table.points[q], gradients[q]);
            stored += part;
            if (!pressure)
              sum.energy += part;
          }
        if (materials.has_thermal_strain() && materials.thermal_density().acts_in(region))
          {
            // Temperatures are sampled as their loads are.
            stored = 0.;
            materials.thermal_density().sample(mesh, cell, temperatures);
            for (const auto &point : temperatures)
              stored
                += point.weight * volume
                   * density_at(point.b,
                                gradient_at(space, cell, u, point.b)
                                  - point.value[0]
                                      * dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()));
          }
        sum.stored += 0.5 * stored;
        if (pressure)
          sum.energy += stored;
      }
    add_up(sum, space.communicator());
    return sum;
  }

  Energies
  compute_energies(const mesh::HexahedralField  &displacement,
                   const mechanics::MaterialMap &materials,
                   MPI_Comm                      communicator)
  {
    const unsigned long n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const unsigned long rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
    const unsigned int  begin   = displacement.n_cells() * rank / n_ranks;
    const unsigned int  end     = displacement.n_cells() * (rank + 1) / n_ranks;
    // Gauss' rule with a point more than the degree in each direction is exact.
    const dealii::QGauss<3> gauss(displacement.degree() + 1);
    ShearModuli             shear_moduli(materials);
    Energies                sum;
    for (unsigned int cell = begin; cell < end; ++cell)
      {
        const auto  &box    = displacement.cells()[cell];
        const auto  &law    = materials.linear_law(box.region);
        const double volume = box.size[0] * box.size[1] * box.size[2];
        const double mu     = shear_moduli(box.region);
        for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            const auto       gradient = displacement.gradient(cell, gauss.point(q));
            const auto       strain   = symmetrize(gradient);
            const double     weight   = volume * gauss.weight(q);
            dealii::Point<3> x        = box.lower;
            for (unsigned int d = 0; d < 3; ++d)
              x[d] += gauss.point(q)[d] * box.size[d];
            sum.energy += weight * law.energy_density(strain);
            sum.stored += 0.5 * weight
                          * law.energy_density(strain - materials.thermal_strain(box.region, x));
            sum.scale += 2. * weight * mu * gradient.norm_square();
          }
      }
    add_up(sum, communicator);
    return sum;
  }
} // namespace tetradapt::solve
