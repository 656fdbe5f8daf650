// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_held_directions_h
#define tetradapt_mechanics_held_directions_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <optional>
#include <vector>

namespace tetradapt::mechanics
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  /** The directions in which supports hold one node, and the displacement in them. */
  class HeldDirections
  {
  public:
    /** What contradicts a direction that is added. */
    struct Conflict
    {
      unsigned int owner; ///< who holds the node in that direction already
      double       value; ///< the displacement in that direction by those before
      /** Of the angle between the direction and those before, where that is so small that both
       * are probably meant to be the same; 0: they are the same, and the values differ. */
      double sine;
    };

    /**
     * Holds the node also in @p direction, a unit vector, where the displacement is @p value.
     * @param owner is a number to be named by a Conflict.
     * @return a conflict if the direction depends on those before, to a thousandth, and its value
     *         differs from what follows from theirs, or if it nearly depends on them; then nothing
     *         changes.
     */
    std::optional<Conflict>
    add(const Tensor<1, 3> &direction, double value, unsigned int owner);

    unsigned int
    rank() const
    {
      return n;
    }
    /** The orthogonal projector on all of the directions. */
    SymmetricTensor<2, 3>
    projector() const;
    /** The smallest displacement that has the values in all of the directions. */
    Tensor<1, 3>
    value() const;
    /** Orthonormal directions across all of them. */
    std::vector<Tensor<1, 3>>
    others() const;
    /** Bit c is set: component c is held. Nothing if the directions are no components. */
    std::optional<unsigned char>
    components() const;

  private:
    unsigned int                n = 0;
    std::array<Tensor<1, 3>, 3> basis; ///< orthonormal
    std::array<double, 3>       values{};
    std::array<unsigned int, 3> owners{};
  };
} // namespace tetradapt::mechanics

#endif
