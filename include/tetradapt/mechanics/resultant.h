// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_resultant_h
#define tetradapt_mechanics_resultant_h

#include <deal.II/base/point.h>

#include <mpi.h>

namespace tetradapt::mechanics
{
  /** The resultant of forces: their sum, and the sum of their moments about the origin,
   * x cross f. */
  struct Resultant
  {
    dealii::Tensor<1, 3> force, moment;

    /** Adds the force @p f at @p x. */
    void
    add(const dealii::Point<3> &x, const dealii::Tensor<1, 3> &f)
    {
      force += f;
      moment += dealii::cross_product_3d(x, f);
    }
    Resultant &
    operator+=(const Resultant &other)
    {
      force += other.force;
      moment += other.moment;
      return *this;
    }
    /** The moment of the same forces about @p centre. */
    dealii::Tensor<1, 3>
    moment_about(const dealii::Point<3> &centre) const
    {
      return moment - dealii::cross_product_3d(centre, force);
    }
  };

  /** The sum of the ranks' resultants, on every rank. Collective. */
  Resultant
  sum(const Resultant &resultant, MPI_Comm communicator);
} // namespace tetradapt::mechanics

#endif
