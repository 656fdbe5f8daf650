// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/enriched/space.h"

#include "cell_batches.h"

#include "tetradapt/compare/parallel.h"

namespace tetradapt::estimate
{
  struct EnrichedSpace::Batches : CellBatches
  {
    using CellBatches::CellBatches;
  };

  EnrichedSpace::EnrichedSpace(const mesh::NodalField       &field,
                               const mechanics::MaterialMap &materials,
                               MPI_Comm                      communicator)
    : mpi_communicator(communicator), hierarchical_surplus(field), n_field_nodes(field.n_nodes()),
      batches(std::make_unique<Batches>(hierarchical_surplus,
                                        n_field_nodes,
                                        materials,
                                        compare::own_slice(field.mesh().n_cells(), communicator)))
  {
  }

  EnrichedSpace::~EnrichedSpace() = default;

  EnrichedSpace::Values
  EnrichedSpace::embed(const std::vector<Tensor<1, 3>> &nodal_values) const
  {
    Values result(size());
    for (unsigned int i = 0; i < n_field_nodes; ++i)
      for (unsigned int c = 0; c < 3; ++c)
        result[3 * i + c] = nodal_values[i][c];
    return result;
  }

  void
  EnrichedSpace::multiply(const Values &x, Values &forces) const
  {
    forces.reinit(size());
    multiply_batches(*batches, x.data(), forces.data());
    compare::sum_over_ranks(forces.data(), forces.size(), mpi_communicator);
  }

  std::vector<double>
  EnrichedSpace::cell_products(const Values &x, const Values &y) const
  {
    const unsigned int  n_cells = hierarchical_surplus.mesh().n_cells();
    std::vector<double> products(n_cells, 0.);
    batch_products(*batches, x.data(), y.data(), products.data());
    compare::gather_slices(products, n_cells, 1, mpi_communicator);
    return products;
  }

  std::vector<double>
  EnrichedSpace::surplus_diagonal() const
  {
    std::vector<double> diagonal(9 * static_cast<std::size_t>(hierarchical_surplus.n_functions()),
                                 0.);
    add_surplus_diagonal(*batches, n_field_nodes, diagonal.data());
    compare::sum_over_ranks(diagonal, mpi_communicator);
    return diagonal;
  }
} // namespace tetradapt::estimate
