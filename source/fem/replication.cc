// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/fem/replication.h"

#include "tetradapt/fem/triangulation.h"

namespace tetradapt::fem
{
  namespace
  {
    /** Sums over the ranks, of which one has what is not zero. */
    void
    add_up(double *values, const std::size_t n, const dealii::Utilities::MPI::Partitioner &layout)
    {
      if (layout.n_mpi_processes() > 1)
        MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, layout.get_mpi_communicator());
    }
  } // namespace

  std::vector<dealii::Tensor<1, 3>>
  replicate(const Space &space, const Vector &vector)
  {
    static_assert(sizeof(dealii::Tensor<1, 3>) == 3 * sizeof(double));
    std::vector<dealii::Tensor<1, 3>> values(space.n_field_nodes());
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        values[space.field_node(node)][c] = vector.local_element(3 * node + c);
    add_up(values.data()->begin_raw(), 3 * values.size(), *space.vector_layout());
    return values;
  }

  std::shared_ptr<const mesh::NodalField>
  replicate(const Field &field)
  {
    const Space &space  = field.space();
    const auto   result = std::make_shared<mesh::NodalField>(space.shared_mesh(),
                                                           space.degree(),
                                                           space.shared_edges());
    result->values      = replicate(space, field.vector());
    if (field.pressure())
      {
        const PressureSpace &pressures = field.pressure()->space();
        const auto           pressure  = std::make_shared<mesh::PressureField>(pressures.nodes());
        for (unsigned int node = 0; node < pressures.n_owned_nodes(); ++node)
          pressure->values[pressures.field_node(node)]
            = field.pressure()->vector().local_element(node);
        add_up(pressure->values.data(), pressure->values.size(), *pressures.vector_layout());
        result->pressure = pressure;
      }
    return result;
  }

  Vector
  distribute(const Space &space, const std::vector<dealii::Tensor<1, 3>> &values)
  {
    Vector vector(space.vector_layout());
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        vector.local_element(3 * node + c) = values[space.field_node(node)][c];
    return vector;
  }

  std::shared_ptr<const Field>
  distribute(const mesh::NodalField &field, std::shared_ptr<const Space> space)
  {
    std::shared_ptr<const Pressure> pressure;
    if (field.pressure)
      {
        const auto pressures = std::make_shared<const PressureSpace>(space, field.pressure->nodes);
        Vector     values(pressures->vector_layout());
        for (unsigned int node = 0; node < pressures->n_owned_nodes(); ++node)
          values.local_element(node) = field.pressure->values[pressures->field_node(node)];
        pressure = std::make_shared<const Pressure>(pressures, std::move(values));
      }
    Vector values = distribute(*space, field.values);
    return std::make_shared<const Field>(std::move(space), std::move(values), std::move(pressure));
  }

  std::shared_ptr<const Field>
  distribute(const mesh::NodalField &field, const MPI_Comm communicator)
  {
    const auto body = std::make_shared<const Triangulation>(field.shared_mesh(), communicator);
    return distribute(field,
                      std::make_shared<const Space>(body, field.degree(), field.shared_edges()));
  }
} // namespace tetradapt::fem
