// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/difference.h"

#include "tetradapt/compare/field_evaluator.h"
#include "tetradapt/compare/parallel.h"
#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/mechanics/energy_density.h"

#include <cmath>

namespace tetradapt::compare
{
  namespace
  {
    /** The values of the reference and its points in one of its cells, at the
     * points of a quadrature rule with known shape functions. */
    class ReferenceCell
    {
    public:
      ReferenceCell(const mesh::NodalField &field, const TetQuadrature &rule)
        : field(field), rule(rule), shape(rule.points.size())
      {
        for (unsigned int q = 0; q < rule.points.size(); ++q)
          mesh::shape_values(field.degree(), rule.points[q], shape[q].data());
      }

      void
      reinit(const unsigned int new_cell)
      {
        cell   = new_cell;
        volume = mesh::cell_volume(field.mesh(), cell);
        for (unsigned int i = 0; i < field.n_nodes_per_cell(); ++i)
          nodal[i] = field.values[field.node(cell, i)];
        if (field.degree() == 2)
          {
            gradients = vertex_gradients(field, cell);
            return;
          }
        const auto g = mesh::barycentric_gradients(field.mesh(), cell);
        gradients[0] = Tensor<2, 3>();
        for (unsigned int k = 0; k < 4; ++k)
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              gradients[0][i][j] += nodal[k][i] * g[k][j];
      }

      Tensor<1, 3>
      value(const unsigned int q) const
      {
        Tensor<1, 3> sum;
        for (unsigned int i = 0; i < field.n_nodes_per_cell(); ++i)
          sum += shape[q][i] * nodal[i];
        return sum;
      }

      Tensor<2, 3>
      gradient(const unsigned int q) const
      {
        if (field.degree() == 1)
          return gradients[0];
        Tensor<2, 3> sum;
        for (unsigned int i = 0; i < 4; ++i)
          sum += rule.points[q][i] * gradients[i];
        return sum;
      }

      double
      weight(const unsigned int q) const
      {
        return rule.weights[q] * volume;
      }

    private:
      const mesh::NodalField             &field;
      const TetQuadrature                &rule;
      std::vector<std::array<double, 10>> shape;
      unsigned int                        cell   = 0;
      double                              volume = 0.;
      std::array<Tensor<1, 3>, 10>        nodal;
      std::array<Tensor<2, 3>, 4>         gradients;
    };

    /**
     * Energies of the difference, integrated on u_h's own cells, for those that
     * hold no point of the reference's rule. Collective.
     */
    void
    integrate_unsampled(const FieldEvaluator            &u_h,
                        const ReferenceSampling         &sampling,
                        const std::vector<unsigned int> &unsampled,
                        std::vector<double>             &cell_energy)
    {
      const TetQuadrature    &rule      = tet_quadrature(2);
      const mesh::NodalField &reference = sampling.reference();
      const mesh::TetMesh    &mesh      = u_h.field().mesh();
      const Slice             slice     = own_slice(unsampled.size(), sampling.communicator());
      std::vector<Point<3>>   points;
      for (unsigned int k = slice.begin; k < slice.end; ++k)
        for (const auto &b : rule.points)
          points.push_back(position(mesh, unsampled[k], b));
      const auto          locations = sampling.locator().locate(points);
      std::vector<double> sums(unsampled.size(), 0.);
      for (std::size_t i = 0; i < points.size(); ++i)
        {
          const unsigned int k  = slice.begin + i / rule.points.size();
          const unsigned int q  = i % rule.points.size();
          const Location    &at = locations[i];
          const Tensor<2, 3> G  = reference.gradient(at.cell, at.barycentric)
                                 - u_h.gradient(unsampled[k], rule.points[q]);
          const double p
            = (reference.pressure ? reference.pressure->value(at.cell, at.barycentric) : 0.)
              - u_h.pressure(unsampled[k], rule.points[q]);
          const mechanics::EnergyDensity density(sampling.materials(),
                                                 reference.mesh().regions[at.cell]);
          sums[k] += rule.weights[q] * mesh::cell_volume(mesh, unsampled[k]) * density(G, p);
        }
      gather_slices(sums, unsampled.size(), 1, sampling.communicator());
      for (std::size_t k = 0; k < unsampled.size(); ++k)
        cell_energy[unsampled[k]] = sums[k];
    }
  } // namespace

  Difference
  difference_to_reference(const mesh::NodalField  &u_h,
                          const PointLocator      &locator,
                          const ReferenceSampling &sampling)
  {
    const TetQuadrature    &rule      = tet_quadrature(2);
    const mesh::NodalField &reference = sampling.reference();
    const mesh::TetMesh    &ref_mesh  = reference.mesh();
    const unsigned int      n_cells   = u_h.mesh().n_cells();
    const FieldEvaluator    evaluator(u_h);
    ReferenceCell           ref_cell(reference, rule);

    Difference              result;
    const std::vector<bool> left_out = sampling.excluded().cells(u_h.mesh());
    // The cells' energies, how many points each holds, then the global sums: one
    // message.
    std::vector<double> sums(2 * std::size_t(n_cells) + 2, 0.);
    double              l2 = 0., h1 = 0.;
    unsigned int        hint = dealii::numbers::invalid_unsigned_int;
    for (const unsigned int cell : sampling.own_cells())
      {
        const mechanics::EnergyDensity density(sampling.materials(), ref_mesh.regions[cell]);
        ref_cell.reinit(cell);
        for (unsigned int q = 0; q < rule.points.size(); ++q)
          {
            const Location at = locator.locate(position(ref_mesh, cell, rule.points[q]), hint);
            hint              = at.cell;
            if (left_out[at.cell])
              continue;
            const Tensor<1, 3> u = ref_cell.value(q) - evaluator.value(at.cell, at.barycentric);
            const Tensor<2, 3> G
              = ref_cell.gradient(q) - evaluator.gradient(at.cell, at.barycentric);
            const double p
              = (reference.pressure ? reference.pressure->value(cell, rule.points[q]) : 0.)
                - evaluator.pressure(at.cell, at.barycentric);
            const double weight = ref_cell.weight(q);
            l2 += weight * u.norm_square();
            h1 += weight * G.norm_square();
            sums[at.cell] += weight * density(G, p);
            sums[n_cells + at.cell] += 1.;
            result.largest_distance = std::max(result.largest_distance, at.distance);
          }
      }
    sums[2 * std::size_t(n_cells)]     = l2;
    sums[2 * std::size_t(n_cells) + 1] = h1;
    sum_over_ranks(sums, sampling.communicator());

    std::vector<unsigned int> unsampled;
    double                    energy = 0.;
    for (unsigned int cell = 0; cell < n_cells; ++cell)
      {
        energy += sums[cell];
        if (sums[n_cells + cell] == 0. && !left_out[cell])
          unsampled.push_back(cell);
      }
    result.l2                = std::sqrt(sums[2 * std::size_t(n_cells)]);
    result.h1                = std::sqrt(sums[2 * std::size_t(n_cells) + 1]);
    result.energy            = std::sqrt(std::max(energy, 0.));
    result.l2_norm           = sampling.l2_norm();
    result.h1_norm           = sampling.h1_norm();
    result.energy_norm       = sampling.energy_norm();
    result.energy_noise      = sampling.energy_noise();
    result.largest_distance  = max_over_ranks(result.largest_distance, sampling.communicator());
    result.n_unsampled_cells = unsampled.size();
    result.cell_energy.assign(sums.begin(), sums.begin() + n_cells);
    if (!unsampled.empty())
      integrate_unsampled(evaluator, sampling, unsampled, result.cell_energy);
    for (double &e : result.cell_energy)
      e = std::sqrt(std::max(e, 0.)); // rounding may leave less than nothing
    return result;
  }

  Difference
  difference_to_reference(const mesh::NodalField       &u_h,
                          const PointLocator           &locator,
                          const mesh::NodalField       &reference,
                          const mechanics::MaterialMap &materials,
                          MPI_Comm                      communicator)
  {
    // Shares nothing: the sampling does not outlive this call.
    const std::shared_ptr<const mesh::NodalField> borrowed(std::shared_ptr<void>(), &reference);
    return difference_to_reference(u_h,
                                   locator,
                                   ReferenceSampling(borrowed, materials, communicator));
  }
} // namespace tetradapt::compare
