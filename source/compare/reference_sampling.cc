// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/reference_sampling.h"

#include "tetradapt/compare/field_evaluator.h"
#include "tetradapt/compare/parallel.h"
#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/mechanics/energy_density.h"
#include "tetradapt/mesh/space_curve.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tetradapt::compare
{
  ReferenceSampling::ReferenceSampling(const ReferenceField         &reference,
                                       const mechanics::MaterialMap &materials,
                                       MPI_Comm                      communicator,
                                       ExcludedRegion                excluded)
    : field(reference), material_map(materials), mpi_communicator(communicator),
      region(std::move(excluded))
  {
    std::vector<double> sums(4, 0.);
    if (hexahedra() != nullptr)
      visit_hexahedra(sums);
    else
      visit_tetrahedra(sums);
    sum_over_ranks(sums, communicator);
    for (unsigned int i = 0; i < 4; ++i)
      norms[i] = std::sqrt(std::max(sums[i], 0.));
  }

  ReferenceSampling::ReferenceSampling(std::shared_ptr<const mesh::NodalField> reference,
                                       const mechanics::MaterialMap           &materials,
                                       MPI_Comm                                communicator,
                                       ExcludedRegion                          excluded)
    : ReferenceSampling(ReferenceField{std::move(reference), nullptr},
                        materials,
                        communicator,
                        std::move(excluded))
  {
  }

  void
  ReferenceSampling::visit_tetrahedra(std::vector<double> &sums)
  {
    const mesh::TetMesh  &mesh    = reference().mesh();
    const auto            box     = mesh::bounding_box(mesh);
    const unsigned int    n_cells = mesh.n_cells();
    const Slice           slice   = own_slice(n_cells, mpi_communicator);
    std::vector<Point<3>> centroids(n_cells);
    for (unsigned int cell = 0; cell < n_cells; ++cell)
      centroids[cell] = position(mesh, cell, {{.25, .25, .25, .25}});
    const auto              order    = mesh::SpaceCurve(box.first, box.second).order(centroids);
    const std::vector<bool> left_out = region.cells(mesh);
    std::copy_if(order.begin() + slice.begin,
                 order.begin() + slice.end,
                 std::back_inserter(cells),
                 [&](const unsigned int cell) { return !left_out[cell]; });

    // Exact for the gradient's square (degree 2) and the value's (degree 4); temperatures
    // are expressions.
    const bool           thermal       = material_map.has_thermal_strain();
    const TetQuadrature &for_values    = tet_quadrature(4),
                        &for_gradients = tet_quadrature(thermal ? 4 : 2);
    const FieldEvaluator evaluator(reference());
    for (const unsigned int cell : cells)
      {
        const mechanics::EnergyDensity density(material_map, mesh.regions[cell]);
        const double                   volume = mesh::cell_volume(mesh, cell);
        const double mu = laws::shear_modulus(material_map.linear_law(mesh.regions[cell]));
        for (unsigned int q = 0; q < for_values.points.size(); ++q)
          sums[0] += volume * for_values.weights[q]
                     * evaluator.value(cell, for_values.points[q]).norm_square();
        for (unsigned int q = 0; q < for_gradients.points.size(); ++q)
          {
            const double       weight = volume * for_gradients.weights[q];
            const Tensor<2, 3> G      = evaluator.gradient(cell, for_gradients.points[q]);
            const double       p      = evaluator.pressure(cell, for_gradients.points[q]);
            sums[1] += weight * G.norm_square();
            sums[3] += 2. * mu * weight * G.norm_square();
            if (thermal)
              {
                const auto point = position(mesh, cell, for_gradients.points[q]);
                sums[2]
                  += weight
                     * density(
                       G - Tensor<2, 3>(material_map.thermal_strain(mesh.regions[cell], point)), p);
              }
            else
              sums[2] += weight * density(G, p);
          }
      }
  }

  void
  ReferenceSampling::visit_hexahedra(std::vector<double> &sums) const
  {
    // Gauss' rule with a point more than the degree in each direction is exact.
    const mesh::HexahedralField &u     = *hexahedra();
    const Slice                  slice = own_slice(u.n_cells(), mpi_communicator);
    const dealii::QGauss<3>      gauss(u.degree() + 1);
    for (unsigned int cell = slice.begin; cell < slice.end; ++cell)
      {
        const auto  &law    = material_map.linear_law(u.cells()[cell].region);
        const auto  &size   = u.cells()[cell].size;
        const double volume = size[0] * size[1] * size[2];
        const double mu     = laws::shear_modulus(law);
        for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            const double weight   = volume * gauss.weight(q);
            const auto [value, G] = u.evaluate(cell, gauss.point(q));
            sums[0] += weight * value.norm_square();
            sums[1] += weight * G.norm_square();
            sums[3] += 2. * mu * weight * G.norm_square();
            auto strain = dealii::symmetrize(G);
            if (material_map.has_thermal_strain())
              {
                Point<3> x = u.cells()[cell].lower;
                for (unsigned int d = 0; d < 3; ++d)
                  x[d] += gauss.point(q)[d] * size[d];
                strain -= material_map.thermal_strain(u.cells()[cell].region, x);
              }
            sums[2] += weight * law.energy_density(strain);
          }
      }
  }

  const PointLocator &
  ReferenceSampling::locator() const
  {
    if (!point_locator)
      point_locator = std::make_unique<PointLocator>(reference().shared_mesh());
    return *point_locator;
  }
} // namespace tetradapt::compare
