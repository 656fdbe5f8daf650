// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/rigid_motions.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/face_table.h"
#include "tetradapt/mesh/finalize.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::mechanics
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    /** A connected part: where it is and what its supports hold. */
    struct Part
    {
      Point<3>                             lower, upper;
      std::array<std::array<double, 6>, 6> gram{};
      unsigned int                         n_prescribed = 0; ///< nodes

      Point<3>
      centre() const
      {
        return lower + 0.5 * (upper - lower);
      }
    };

    using Matrix6 = std::array<std::array<double, 6>, 6>;

    /** Makes entry (p, q) of the symmetric @p a zero by a rotation of the two
     * directions, and turns the columns of @p vectors along. */
    void
    rotate(Matrix6 &a, Matrix6 &vectors, const unsigned int p, const unsigned int q)
    {
      if (a[p][q] == 0.)
        return;
      const double theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
      // The smaller of the two angles; for a huge theta it is 1 / (2 theta).
      const double t = std::copysign(1., theta) / (std::abs(theta) + std::hypot(theta, 1.));
      const double c = 1. / std::hypot(t, 1.), s = t * c;
      for (unsigned int k = 0; k < 6; ++k)
        {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
      for (unsigned int k = 0; k < 6; ++k)
        {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
        }
      for (unsigned int k = 0; k < 6; ++k)
        {
          const double kp = vectors[k][p], kq = vectors[k][q];
          vectors[k][p] = c * kp - s * kq;
          vectors[k][q] = s * kp + c * kq;
        }
    }

    /** The smallest eigenvalue of a symmetric matrix and its unit eigenvector, by
     * Jacobi's cyclic rotations (Golub, Van Loan, Matrix Computations, section 8.5).
     * LAPACK's search in an interval, which was used before, misses an eigenvalue that
     * is zero with some implementations of BLAS: then a body that is not held passed. */
    std::pair<double, std::array<double, 6>>
    smallest_eigenpair(Matrix6 a)
    {
      Matrix6 vectors{};
      for (unsigned int i = 0; i < 6; ++i)
        vectors[i][i] = 1.;
      // Convergence is quadratic: six sweeps are enough for rounding, ten are safe.
      for (unsigned int sweep = 0; sweep < 10; ++sweep)
        for (unsigned int p = 0; p < 6; ++p)
          for (unsigned int q = p + 1; q < 6; ++q)
            rotate(a, vectors, p, q);
      unsigned int smallest = 0;
      for (unsigned int i = 1; i < 6; ++i)
        if (a[i][i] < a[smallest][smallest])
          smallest = i;
      std::array<double, 6> vector;
      for (unsigned int k = 0; k < 6; ++k)
        vector[k] = vectors[k][smallest];
      return {a[smallest][smallest], vector};
    }

    /** Smallest relative singular value that counts as held. A support of two
     * points a thousandth of the body apart passes. */
    constexpr double held = 1e-8;

    std::string
    describe(const std::array<double, 6> &motion)
    {
      Tensor<1, 3> translation, rotation;
      for (unsigned int c = 0; c < 3; ++c)
        {
          translation[c] = motion[c];
          rotation[c]    = motion[3 + c];
        }
      const bool         turns     = rotation.norm() > 1e-4 * translation.norm();
      const Tensor<1, 3> direction = turns ? rotation / rotation.norm() : translation;
      std::ostringstream text;
      text.precision(2);
      text << (turns ? "turn about the direction (" : "move along (");
      for (unsigned int c = 0; c < 3; ++c)
        text << (c > 0 ? ", " : "") << (std::abs(direction[c]) < 1e-3 ? 0. : direction[c]);
      text << ")";
      return text.str();
    }

    void
    check_part(const Part &part, unsigned int n_parts)
    {
      Matrix6 gram = part.gram;
      for (auto &row : gram)
        for (double &entry : row)
          entry /= std::max(1u, part.n_prescribed);
      const auto [value, motion] = smallest_eigenpair(gram);
      // Also false for NaN.
      if (value > held * held)
        return;
      std::ostringstream message;
      message << "The supports do not hold ";
      if (n_parts > 1)
        message << "one of the " << n_parts << " separate parts of the body, the one ";
      else
        message << "the body ";
      message << "between " << mesh::to_string(part.lower) << " and "
              << mesh::to_string(part.upper);
      if (part.n_prescribed == 0)
        message << ": none of its nodes is supported";
      else
        message << ": it can still " << describe(motion);
      message << ". Add a support, or components to one, that prevents this.";
      throw core::InputError(message.str());
    }

    /** Adds what the supports of one node hold. */
    void
    add_node(const Point<3>               &x,
             const PrescribedDisplacement &prescribed,
             unsigned int                  node,
             Part                         &part)
    {
      const double length = 0.5 * (part.upper - part.lower).norm();
      ++part.n_prescribed;
      std::array<Tensor<1, 3>, 6> motions;
      for (unsigned int k = 0; k < 6; ++k)
        motions[k] = rigid_motion(k, x, part.centre(), length);
      for (unsigned int c = 0; c < 3; ++c)
        if (prescribed.is_fixed(node, c))
          for (unsigned int i = 0; i < 6; ++i)
            for (unsigned int j = 0; j < 6; ++j)
              part.gram[i][j] += motions[i][c] * motions[j][c];
    }
  } // namespace

  Tensor<1, 3>
  rigid_motion(unsigned int k, const Point<3> &x, const Point<3> &centre, double length)
  {
    Tensor<1, 3> motion;
    if (k < 3)
      motion[k] = 1.;
    else
      {
        const Tensor<1, 3> r = (x - centre) / length;
        motion[(k + 1) % 3]  = -r[(k + 2) % 3];
        motion[(k + 2) % 3]  = r[(k + 1) % 3];
      }
    return motion;
  }

  void
  check_rigid_motions(const mesh::TetMesh &mesh, const PrescribedDisplacement &prescribed)
  {
    const std::vector<unsigned int> part_of = mesh::connected_components(mesh);
    std::vector<Part>               parts;
    // Mid-edge nodes follow their end points' supports, so vertices suffice. A point where
    // parts touch belongs to each.
    std::vector<std::pair<unsigned int, unsigned int>> supported; // part, point
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const unsigned int k = part_of[c];
        if (k >= parts.size())
          {
            parts.resize(k + 1);
            parts[k].lower = parts[k].upper = mesh.points[mesh.cells[c][0]];
          }
        for (const unsigned int p : mesh.cells[c])
          {
            for (unsigned int d = 0; d < 3; ++d)
              {
                parts[k].lower[d] = std::min(parts[k].lower[d], mesh.points[p][d]);
                parts[k].upper[d] = std::max(parts[k].upper[d], mesh.points[p][d]);
              }
            if (prescribed.fixed[p] != 0)
              supported.emplace_back(k, p);
          }
      }
    std::sort(supported.begin(), supported.end());
    supported.erase(std::unique(supported.begin(), supported.end()), supported.end());
    for (const auto &[k, p] : supported)
      add_node(mesh.points[p], prescribed, p, parts[k]);
    for (const Part &part : parts)
      check_part(part, parts.size());
  }
} // namespace tetradapt::mechanics
