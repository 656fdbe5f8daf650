// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/compare/reference_sampling.h"

#include "tetradapt/compare/field_evaluator.h"
#include "tetradapt/compare/parallel.h"
#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/mesh/space_curve.h"

#include <cmath>

namespace tetradapt::compare
{
  ReferenceSampling::ReferenceSampling(std::shared_ptr<const mesh::NodalField> reference,
                                       const mechanics::MaterialMap           &materials,
                                       MPI_Comm                                communicator)
    : field(std::move(reference)), material_map(materials), mpi_communicator(communicator)
  {
    const mesh::TetMesh  &mesh    = field->mesh();
    const auto            box     = mesh::bounding_box(mesh);
    const unsigned int    n_cells = mesh.n_cells();
    const Slice           slice   = own_slice(n_cells, communicator);
    std::vector<Point<3>> centroids(n_cells);
    for (unsigned int cell = 0; cell < n_cells; ++cell)
      centroids[cell] = position(mesh, cell, {{.25, .25, .25, .25}});
    const auto order = mesh::SpaceCurve(box.first, box.second).order(centroids);
    cells.assign(order.begin() + slice.begin, order.begin() + slice.end);

    // Exact for the gradient's square (degree 2) and the value's (degree 4).
    const TetQuadrature &for_gradients = tet_quadrature(2), &for_values = tet_quadrature(4);
    std::vector<double>  sums(3, 0.);
    const FieldEvaluator evaluator(*field);
    for (const unsigned int cell : cells)
      {
        const auto  &law    = materials.law(mesh.regions[cell]);
        const double volume = mesh::cell_volume(mesh, cell);
        for (unsigned int q = 0; q < for_values.points.size(); ++q)
          sums[0] += volume * for_values.weights[q]
                     * evaluator.value(cell, for_values.points[q]).norm_square();
        for (unsigned int q = 0; q < for_gradients.points.size(); ++q)
          {
            const double       weight = volume * for_gradients.weights[q];
            const Tensor<2, 3> G      = evaluator.gradient(cell, for_gradients.points[q]);
            sums[1] += weight * G.norm_square();
            sums[2] += weight * law.energy_density(dealii::symmetrize(G));
          }
      }
    sum_over_ranks(sums, communicator);
    for (unsigned int i = 0; i < 3; ++i)
      norms[i] = std::sqrt(std::max(sums[i], 0.));
  }

  const PointLocator &
  ReferenceSampling::locator() const
  {
    if (!point_locator)
      point_locator = std::make_unique<PointLocator>(field->shared_mesh());
    return *point_locator;
  }
} // namespace tetradapt::compare
