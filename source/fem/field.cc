// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/fem/field.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::fem
{
  Pressure::Pressure(std::shared_ptr<const PressureSpace> space, Vector owned)
    : pressure_space(std::move(space)), values(std::move(owned))
  {
    values.update_ghost_values();
  }

  Field::Field(std::shared_ptr<const Space> space)
    : field_space(std::move(space)), values(field_space->vector_layout())
  {
    values.set_ghost_state(true); // they are zero also
  }

  Field::Field(std::shared_ptr<const Space>    space,
               Vector                          owned,
               std::shared_ptr<const Pressure> pressure)
    : field_space(std::move(space)), values(std::move(owned)), pressure_pointer(std::move(pressure))
  {
    values.update_ghost_values();
  }

  double
  Field::largest_norm() const
  {
    // Not by squares, which vanish for very small displacements.
    double largest = 0.;
    for (unsigned int node = 0; node < field_space->n_owned_nodes(); ++node)
      {
        const dealii::Tensor<1, 3> u = value(node);
        largest                      = std::max(largest, std::hypot(u[0], u[1], u[2]));
      }
    return dealii::Utilities::MPI::max(largest, field_space->communicator());
  }
} // namespace tetradapt::fem
